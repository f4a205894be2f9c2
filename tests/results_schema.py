#!/usr/bin/env python3
"""Results of every analysis that returns records are as lib/io/results.schema.json says, and those of check and sample
as the schemas in lib/report say.

usage: results_schema.py PLUMBLINE SOURCE
"""
import copy
import json
import pathlib
import subprocess
import sys
import tempfile

import jsonschema

command, source = sys.argv[1], pathlib.Path(sys.argv[2])
schema = json.loads((source / "lib/io/results.schema.json").read_text())
jsonschema.Draft202012Validator.check_schema(schema)
validator = jsonschema.Draft202012Validator(schema)

runs = [
    ["run", "ipa_ac/scalar_delta_convergence.prm", "--levels", "2"],
    ["run", "lps/crack_mode_2.prm", "--levels", "1"],
    ["stability", "failures/too_few_neighbours.prm", "--levels", "3"],
    ["stability", "dynamics/strained.prm", "--levels", "1", "--methods", "FA"],
    ["dispersion", "waves/diffusion.prm", "--methods", "Q1,FA"],
    ["crack", "griffith/speed.prm", "--levels", "1"],
    ["grow", "fracture/plate.prm", "--set", "Fracture/least reaction=0.9"],
    ["strip", "fracture/strip.prm", "--methods", "DGQ0,PA-AC", "--levels", "3"],
    ["run", "dynamics/schemes.prm", "--set", "Time/schemes=velocity Verlet"],
]
files = {"run": "results"}
seen = {"scalars": 0, "curves": 0, "fields": 0}
for analysis, scene, *options in runs:
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([command, analysis, str(source / "scenes" / scene), *options, "--quiet",
                        "-o", folder], check=True)
        written = "dynamics" if scene.startswith("dynamics/schemes") else files.get(analysis, analysis)
        results = json.loads(pathlib.Path(folder, written + ".json").read_text())
    for error in validator.iter_errors(results):
        sys.exit(f"{analysis} {scene}: {error.json_path}: {error.message}")
    for record in results["records"]:
        for part in seen:
            seen[part] += len(record[part])
    for key in results:  # what is missing is found
        broken = copy.deepcopy(results)
        del broken[key]
        if validator.is_valid(broken):
            sys.exit(f"{analysis} {scene}: valid without '{key}'")

# of commands whose files have a format of their own, or are printed alone
check = source / "scenes" / "check"
with tempfile.TemporaryDirectory() as folder:
    for words, name in (
            (["sample", str(source / "scenes/random/smooth.prm"), "--levels", "1", "--set", "Sampling/counts=1,3",
              "--quiet", "-o", folder], "sample"),
            (["check", str(check / "nodes.csv"), str(check / "bonds.csv"), "--scene", str(check / "check.prm"),
              "--quiet", "-o", folder], "check"),
            (["check", str(check / "nodes.csv"), str(check / "bonds.csv"), "--scene", str(check / "check.prm"),
              "--crack", "0.4, 0.5 : 0.6, 0.5", "--json"], "check"),  # exit code 1: bonds cross it
            (["moduli", "--rules", "FA", "--json"], "results")):
        ran = subprocess.run([command, *words], check=False, capture_output=True, text=True)
        if ran.returncode != (1 if "--crack" in words else 0):
            sys.exit(f"{words}: exit code {ran.returncode}: {ran.stderr}")
        written = json.loads(ran.stdout or pathlib.Path(folder, name + ".json").read_text())
        own = next(source.glob(f"lib/*/{name}.schema.json"))
        jsonschema.validate(written, json.loads(own.read_text()), jsonschema.Draft202012Validator)

for part, n in seen.items():
    if n == 0:
        sys.exit(f"no results have {part}: nothing was tested of them")
