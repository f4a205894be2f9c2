#!/usr/bin/env python3
"""The documentation site is built without a warning, its commands run, and what it names exists.

site.py PROGRAM FOLDER
"""
import html.parser
import math
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "docs" / "_ext"))
sys.dont_write_bytecode = True

from plumbline_reference import Program  # noqa: E402
from plumbline_scene import read_scene  # noqa: E402

# blocks that are shown without being run: how to install and build, and what takes hours
SHELL = re.compile(r"^(\./bootstrap (\w+)|cmake --build |alias plumbline=)")
# a command, as blocks of four blanks have them
INDENTED = re.compile(r"(\$ |\./|plumbline |python3? |cmake |ctest |sh |lmp )")


class Page(html.parser.HTMLParser):
    """Addresses and anchors of a page, and the cells of its tables."""

    def __init__(self, path):
        super().__init__()
        self.links, self.loads, self.anchors, self.rows, self.cell = [], [], set(), [], None
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        if "id" in values:
            self.anchors.add(values["id"])
        if tag == "a" and values.get("href"):
            self.links.append(values["href"])
        elif tag == "link" and values.get("rel") == "stylesheet":
            self.loads.append(values["href"])
        elif values.get("src"):
            self.loads.append(values["src"])
        if tag == "tr":
            self.rows.append([])
        elif tag in ("td", "th") and self.rows:
            self.cell = []

    def handle_data(self, data):
        if self.cell is not None:
            self.cell.append(data)

    def handle_endtag(self, tag):
        if tag in ("td", "th") and self.cell is not None:
            self.rows[-1].append(" ".join("".join(self.cell).split()))
            self.cell = None


def broken_addresses(folder):
    """Pages load nothing from elsewhere, and links lead somewhere."""
    pages = {path.resolve(): Page(path) for path in folder.glob("**/*.html")}
    for path, page in pages.items():
        name = path.relative_to(folder.resolve())
        for address in page.loads:
            if re.match(r"(https?:)?//", address):
                yield f"{name} loads {address}"
            elif not address.startswith("data:") and not (path.parent / address.split("?")[0]).exists():
                yield f"{name} misses {address}"
        for address in page.links:
            if re.match(r"https?:", address):
                if not re.match(r"https://(doi\.org/10\.\d{4,}/\S+|github\.com/pradyunsg/furo)$", address):
                    yield f"{name} links to {address}"
                continue
            target, _, anchor = address.partition("#")
            file = (path.parent / target).resolve() if target else path
            if not file.exists():
                yield f"{name} links to {address}, which does not exist"
            elif anchor and file in pages and anchor not in pages[file].anchors:
                yield f"{name} links to {address}, which has no such part"


def unlike_its_test(block, file):
    """Options and scripts of a command that the file which runs it does not have."""
    test = (ROOT / file).read_text(encoding="utf-8")
    for part in re.findall(r"--[a-z-]+(?: [a-z]+$)?|\w+\.sh \{nodes\} \{forces\}", block):
        if part not in test:
            yield part


def unchecked_blocks(path):
    """Each block is a directive that runs it, a command that sets up or takes hours, or, after '% run by FILE', one
    that a test runs. None is indented in place of a fence."""
    commands = (ROOT / "bootstrap").read_text(encoding="utf-8")
    text = path.read_text(encoding="utf-8")
    without_fences = re.sub(r"^```.*?^```$", "", text, flags=re.M | re.S)
    for line in re.findall(r"\n\n(?: {4,}|\t)(.*)", without_fences):
        if INDENTED.match(line):
            yield f"{path.name}: '{line}' is indented; use a directive, or a fence"
    for file, language, block in re.findall(r"^(?:% run by ([^\n]*)\n\n)?```([^\n`]*)\n(.*?)^```$", text, re.M | re.S):
        if language.startswith("{"):
            continue
        if file:
            yield from (f"{path.name}: {file} does not run '{part}'" for part in unlike_its_test(block, file))
            continue
        for line in block.strip().split("\n"):
            match = SHELL.match(line)
            if language != "sh" or not match:
                yield f"{path.name}: '{line}' is not run by any test; use a directive (docs/_ext/plumbline_docs.py)"
            elif match.group(2) and not re.search(rf"^  {match.group(2)}\)", commands, re.M):
                yield f"{path.name}: '{line}' is no command of ./bootstrap"


def unknown_names(path, keys, options):
    """Keys, options, scenes, folders and files in inline code exist."""
    sections = {key.split("/")[0] for key in keys}
    for code in re.findall(r"(?<!`)`([^`\n]+)`(?!`)", path.read_text(encoding="utf-8")):
        match = re.match(r"([A-Z][a-z]+)/([A-Za-z -]+?)( = .*|: .*|=.*)?$", code)
        if match and match.group(1) in sections and f"{match.group(1)}/{match.group(2)}" not in keys:
            yield f"{path.name}: {code} is no key of scenes"
        for file in re.findall(r"\b(?:scenes|tests|benchmarks|lib)/[\w./-]+", code):
            if "build/" not in code and not (ROOT / file).exists():
                yield f"{path.name}: {file} does not exist"
        for option in re.findall(r"(?<!\S)--[a-z-]+", code):
            if option not in options and not code.startswith("cmake"):
                yield f"{path.name}: {option} is no option of any command"


def numbers(text):
    """Decimals as they are written, without those in names of files, references and equations."""
    return re.findall(r"(?<![\w.(])-?(?:\d*\.\d+(?:e-?\d+)?|\d+e-\d+)(?![\w.]*\w)", text)


def rounds_to(value, shown):
    digits = len(re.sub(r"e.*", "", shown).lstrip("-0.").replace(".", "")) or 1
    return abs(value - float(shown)) <= .5000001 * 10 ** (math.floor(math.log10(abs(float(shown)))) - digits + 1)


def unasserted_numbers(path):
    """After '% asserted by FILE...' each decimal of the next block is there, or is the rate of numbers there."""
    for files, block in re.findall(r"^% asserted by (.*)\n\n((?:.+\n)+)", path.read_text(encoding="utf-8"), re.M):
        values = []
        for file in files.split():
            text = (ROOT / file).read_text(encoding="utf-8")
            found = [abs(float(number)) for number in re.findall(r"(?<![\w.])\d*\.?\d+(?:e-?\d+)?", text)]
            values += found + [math.log2(a / b) for a, b in zip(found, found[1:]) if a > 0 and b > 0]
        for shown in numbers(re.sub(r"`[^`]*`|\$[^$]*\$", "", block)):
            if not any(rounds_to(value, shown) for value in values):
                yield f"{path.name}: {shown} is not in {files}"


def missing_capabilities(program, folder):
    """The tables of what methods, models and analyses can do are the program's, cell by cell."""
    rows = [row for row in Page(folder / "reference" / "methods.html").rows if row]
    for words in (("list", "methods", "--matrix"), ("list", "models"), ("list", "analyses")):
        for line in program(*words).strip().split("\n"):
            row = [cell.strip() for cell in line.strip("|").split("|")]
            if not set("".join(row)) <= set("-:") and row not in rows:
                yield f"reference/methods.html has no row {row}"


def main():
    program, folder = Program(sys.argv[1]), pathlib.Path(sys.argv[2])
    if subprocess.run([sys.executable, str(ROOT / "docs" / "build.py"), sys.argv[1], str(folder), "-W"],
                      check=False).returncode != 0:
        return 1
    source = folder / "source" / "reference"  # generated from the program
    keys = set(re.findall(r"^### (.+)$", (source / "keys.md").read_text(encoding="utf-8"), re.M))
    options = set(re.findall(r"--[a-z-]+", (source / "commands.md").read_text(encoding="utf-8")))
    pages = sorted((ROOT / "docs").glob("**/*.md")) + [ROOT / "README.md"]
    template = folder / "work" / "template.prm"
    template.write_text(program("template", "scalar"), encoding="utf-8")
    faults = [f"reference/keys.md has no {key}" for key in sorted(set(read_scene(template)["values"]) - keys)]
    faults += [*broken_addresses(folder / "html"), *missing_capabilities(program, folder / "html")]
    for path in pages:
        faults += [*unknown_names(path, keys, options), *unasserted_numbers(path)]
        if path.name != "README.md":  # tests/docs/readme.py runs its blocks
            faults += unchecked_blocks(path)
    print("\n".join(faults) or f"{len(pages)} pages are right")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
