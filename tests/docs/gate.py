"""The gate for continuous integration passes right weights and goes red on wrong ones.

Called as: gate.py PROGRAM."""

import os
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[2]
CHECK = ROOT / "scenes" / "check"


def gate(program, junit, bonds, *options):
    words = ["sh", str(ROOT / "docs" / "ci" / "gate.sh"), str(junit), str(CHECK / "nodes.csv"), str(bonds)]
    ran = subprocess.run([*words, "--scene", str(CHECK / "check.prm"), *options], capture_output=True, text=True,
                         cwd=junit.parent, env={**os.environ, "PLUMBLINE": program}, check=False)
    return ran.returncode, ran.stderr


def mismatches(program, folder):
    """Exit code, and the element of the JUnit file, for right, wrong, unrequired and missing weights."""
    cases = (("bonds.csv", (), 0, "system-out", "as required"),
             ("bonds_wrong.csv", (), 1, "failure", "node 77"),
             ("bonds.csv", ("--require", "<nonsense>"), 2, "error", "<nonsense>"),
             ("missing.csv", (), 2, "error", "missing.csv"))
    for bonds, options, expected, element, text in cases:
        junit = folder / "plumbline.xml"
        code, message = gate(program, junit, CHECK / bonds, *options)
        suite = ElementTree.parse(junit).getroot()
        found = suite.find(f"testcase/{element}")
        counts = (int(suite.get("failures")), int(suite.get("errors")))
        if code != expected or message or counts != (expected == 1, expected > 1):
            yield f"{bonds} {options}: exit code {code}, counts {counts} {message}"
        if found is None or text not in found.text:
            yield f"{bonds} {options}: no '{text}' in <{element}>"


def main():
    with tempfile.TemporaryDirectory() as folder:
        wrong = list(mismatches(sys.argv[1], pathlib.Path(folder)))
    print("\n".join(wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
