#!/usr/bin/env python3
"""Execute a notebook, whose assertions fail where a result is wrong: notebooks.py NAME.ipynb

It must be clean, too: no outputs, no counts of executions, no metadata of the computer it was written on.
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile


def faults(text):
    """Sentences about what does not belong into a notebook in the repository."""
    notebook = json.loads(text)
    found = []
    if notebook["metadata"]:
        found.append(f"metadata of the notebook: {notebook['metadata']}; write {{}}")
    for k, cell in enumerate(notebook["cells"]):
        if cell["metadata"]:
            found.append(f"metadata of cell {k}: {cell['metadata']}; write {{}}")
        if cell.get("outputs") or cell.get("execution_count"):
            found.append(f"cell {k} has outputs; clear them")
    if not any("assert " in "".join(cell["source"]) for cell in notebook["cells"]
               if cell["cell_type"] == "code"):
        found.append("no cell has an assertion")
    return found


def main():
    name = pathlib.Path(sys.argv[1])
    found = faults(name.read_text(encoding="utf-8"))
    for fault in found:
        print(f"{name}: {fault}", file=sys.stderr)
    if found:
        return 1
    with tempfile.TemporaryDirectory() as folder:
        environment = {**os.environ, "MPLBACKEND": "agg", "MPLCONFIGDIR": folder,
                       "IPYTHONDIR": folder, "JUPYTER_RUNTIME_DIR": folder}
        done = subprocess.run([sys.executable, "-m", "nbconvert", "--to", "notebook", "--execute",
                               "--ExecutePreprocessor.kernel_name=python3", "--output-dir", folder,
                               str(name)], env=environment, check=False)
    return done.returncode


if __name__ == "__main__":
    sys.exit(main())
