#!/usr/bin/env python3
"""README: at most 8 kB, its examples run and print what it shows, its links and its picture exist.

readme.py PROGRAM FOLDER
A block is a file, whose name is in the paragraph before it. In blocks 'console', '$ ' begins a command, '# exit code N'
after it is what it returns, and the other lines are its output, with '...' for anything.
"""
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "docs" / "_ext"))
sys.dont_write_bytecode = True

from plumbline_run import CommandFailed, run  # noqa: E402

MOST_BYTES, MOST_LINES = 8192, 15


def shown(line, output):
    """The first line of output that is as shown, or None."""
    pattern = ".*".join(re.escape(part) for part in line.split("..."))
    return next((i for i, text in enumerate(output) if re.fullmatch(pattern, text)), None)


def faults_of_console(block, folder, program):
    output = []
    for line in block.strip().split("\n"):
        if line.startswith("$ "):
            command, _, note = line[2:].partition("    # exit code ")
            output = run(shlex.split(command), folder, program, int(note or 0)).split("\n")
            continue
        place = shown(line, output)
        if place is None:
            yield f"'{line}' is not printed, or not after the lines before; left:\n" + "\n".join(output)
        else:
            output = output[place + 1:]


def faults_of_blocks(text, folder, program):
    bootstrap = (ROOT / "bootstrap").read_text(encoding="utf-8")
    for before, language, block in re.findall(r"([^\n]*(?:\n[^\n]+)*)\n\n```([a-z]*)\n(.*?)^```$", text, re.M | re.S):
        name = re.search(r"`(\w+\.(?:prm|py|json))`", before)
        if language == "console":
            yield from faults_of_console(block, folder, program)
        elif language == "sh":
            for line in block.strip().split("\n"):
                words = shlex.split(line, comments=True)
                if words[0] != "./bootstrap" or f"\n  {words[1]})" not in bootstrap:
                    yield f"'{line}' is not a command of ./bootstrap"
                if any(word.endswith(".prm") and not (ROOT / word).exists() for word in words):
                    yield f"'{line}': there is no such scene"
        elif name:
            if len(block.strip().split("\n")) > MOST_LINES:
                yield f"{name.group(1)} has more than {MOST_LINES} lines"
            (folder / name.group(1)).write_text(block, encoding="utf-8")
        else:
            yield f"a block is neither run nor written: {block}"


def faults_of_picture():
    """It is the text that its script writes."""
    made = subprocess.run([sys.executable, str(ROOT / "docs" / "problem.py")], capture_output=True, text=True,
                          check=True).stdout
    if made != (ROOT / "docs/_static/problem.svg").read_text(encoding="utf-8"):
        yield "docs/_static/problem.svg is not what docs/problem.py writes"


def main():
    program, folder = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    faults = list(faults_of_picture())
    if len(text.encode()) > MOST_BYTES:
        faults.append(f"README.md has {len(text.encode())} bytes, more than {MOST_BYTES}")
    for target in re.findall(r"\]\(([^)#]+)\)", text):
        if not (ROOT / target).exists():
            faults.append(f"README.md links to {target}, which does not exist")
    known = set(re.findall(r"^  (\w+) {2,}", run(["plumbline", "--help"], folder, program), re.M))
    table = text[text.index("## Commands"):text.index("## Documentation")]
    named = set(re.findall(r"`([a-z]+)`", " ".join(line.split("|")[1] for line in table.split("\n") if "`" in line)))
    if known != named:
        faults.append(f"commands: README.md and the program differ in {sorted(known ^ named)}")
    try:
        faults += faults_of_blocks(text, folder, program)
    except CommandFailed as error:
        faults.append(str(error))
    print("\n".join(faults) or "README.md is right")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
