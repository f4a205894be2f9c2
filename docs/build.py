#!/usr/bin/env python3
"""Build the documentation site: docs/build.py PROGRAM FOLDER [-W]. Pages are in FOLDER/html.

PROGRAM is plumbline's executable, which is run for all that the pages show. -W makes warnings errors.
"""
import os
import pathlib
import shutil
import subprocess
import sys

DOCS = pathlib.Path(__file__).resolve().parent
ROOT = DOCS.parent
sys.path.insert(0, str(DOCS / "_ext"))
sys.dont_write_bytecode = True

import plumbline_certified  # noqa: E402
import plumbline_cpp  # noqa: E402
import plumbline_gallery  # noqa: E402
import plumbline_python  # noqa: E402
import plumbline_reference as reference  # noqa: E402
import plumbline_scaling  # noqa: E402

MATHJAX = pathlib.Path("/usr/share/javascript/mathjax")  # Debian's libjs-mathjax


def copy_mathjax(target):
    """Only what formulas as SVG need."""
    for part in ("MathJax.js", "config/TeX-AMS_SVG.js", "extensions", "jax/element", "jax/input/TeX",
                 "jax/output/SVG/autoload", "jax/output/SVG/jax.js", "jax/output/SVG/config.js",
                 "jax/output/SVG/fonts/TeX"):
        source = MATHJAX / part
        if source.is_dir():
            shutil.copytree(source, target / part)
        elif source.exists():
            (target / part).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source, target / part)


def prepare(program, folder):
    """Sources with their generated pages, and a working folder for commands."""
    shutil.rmtree(folder, ignore_errors=True)
    source, work = folder / "source", folder / "work"
    shutil.copytree(DOCS, source, ignore=shutil.ignore_patterns("__pycache__"))
    work.mkdir()
    (work / "scenes").symlink_to(ROOT / "scenes")
    copy_mathjax(source / "_static" / "mathjax")

    tell = reference.Program(program)
    pages = {"reference/commands.md": reference.commands_page(tell), "reference/keys.md": reference.keys_page(tell),
             "reference/methods.md": reference.methods_page(tell), "reference/results.md": reference.results_page(ROOT),
             "reference/python_api.md": plumbline_python.page(program),
             "gallery.md": plumbline_gallery.page(ROOT, program, work, source / "_static" / "gallery")}
    pages["certified.md"] = plumbline_certified.page(ROOT, program, tell, work, source / "_static" / "gallery")
    pages["guides/ranks.md"] = plumbline_scaling.page(ROOT, program, work, source / "_static" / "gallery")
    for name, text in pages.items():
        path = source / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, encoding="utf-8")
    plumbline_cpp.write_pages(ROOT, source, folder / "declarations")
    python = ROOT / "python" / "README.md"
    if python.exists():  # the package describes itself
        text = reference.without_links(python.read_text(encoding="utf-8"))
        (source / "reference" / "python.md").write_text(text, encoding="utf-8")
    return source, work


def main():
    program, folder = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    source, work = prepare(program, folder)
    environment = {**os.environ, "PLUMBLINE_PROGRAM": str(program), "PLUMBLINE_FOLDER": str(work),
                   "PLUMBLINE_ROOT": str(ROOT)}
    done = subprocess.run(["sphinx-build", "-q", "-b", "html", "-d", str(folder / "doctrees"),
                           *sys.argv[3:], "--keep-going", str(source), str(folder / "html")],
                          env=environment, check=False)
    return done.returncode


if __name__ == "__main__":
    sys.exit(main())
