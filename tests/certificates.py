#!/usr/bin/env python3
"""Every scene in scenes/certified has a certificate beside it that is as lib/io/certificate.schema.json says, whose hash
is that of its text; the named ones come out again, to 1e-10 of their size.

usage: certificates.py PLUMBLINE SOURCE NAME ...
       certificates.py PLUMBLINE SOURCE --write [NAME ...]     makes these certificates anew, or all
"""
import copy
import hashlib
import json
import pathlib
import shlex
import subprocess
import sys
import tempfile

import jsonschema

command, source, names = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3:]
folder = source / "scenes" / "certified"
schema = json.loads((source / "lib/io/certificate.schema.json").read_text())
jsonschema.Draft202012Validator.check_schema(schema)
validator = jsonschema.Draft202012Validator(schema)


def certify(name):
    """By the command that the scene states."""
    scene = folder / f"{name}.prm"
    line, = [line for line in scene.read_text().split("\n") if line.startswith("# Run: plumbline ")]
    words = shlex.split(line)[3:]
    if words[:2] != ["certify", f"scenes/certified/{name}.prm"]:
        sys.exit(f"{scene}: '{line}' does not certify it")
    with tempfile.TemporaryDirectory() as output:
        subprocess.run([command, *words, "--quiet", "-o", output], check=True, cwd=source)
        return pathlib.Path(output, "certificate.json").read_text()


def differences(before, now):
    """Of two certificates of one problem."""
    for key in ("name", "n_components", "horizon", "scene_text", "sha256"):
        if before[key] != now[key]:
            yield f"{key} differs"
    for k, (a, b) in enumerate(zip(before["points"] + [before["mean"]], now["points"] + [now["mean"]], strict=True)):
        for part in ("x", "value", "other"):
            for u, v in zip(a[part], b[part], strict=True):
                if not abs(u - v) <= 1e-10 * before["size"]:
                    yield f"value {k}, {part}: {u} and {v}"
        if not abs(a["bound"] - b["bound"]) <= 1e-4 * a["bound"]:
            yield f"value {k}, bound: {a['bound']} and {b['bound']}"


if names[:1] == ["--write"]:
    for path in sorted(folder.glob("*.prm")):
        if names[1:] and path.stem not in names[1:]:
            continue
        path.with_suffix(".certificate.json").write_text(certify(path.stem))
    sys.exit()

found = sorted(folder.glob("*.prm"))
if len(found) < 24:
    sys.exit(f"{folder}: {len(found)} scenes")
for path in found:
    certificate = json.loads(path.with_suffix(".certificate.json").read_text())
    for error in validator.iter_errors(certificate):
        sys.exit(f"{path.stem}: {error.json_path}: {error.message}")
    if hashlib.sha256(certificate["scene_text"].encode()).hexdigest() != certificate["sha256"]:
        sys.exit(f"{path.stem}: sha256 is not that of scene_text")
    for key in certificate:  # what is missing is found
        broken = copy.deepcopy(certificate)
        del broken[key]
        if validator.is_valid(broken):
            sys.exit(f"{path.stem}: valid without '{key}'")
for name in names:
    stored = json.loads((folder / f"{name}.certificate.json").read_text())
    for one in differences(stored, json.loads(certify(name))):
        sys.exit(f"{name} does not come out again: {one}")
