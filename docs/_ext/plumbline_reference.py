"""Pages of reference, from what the program says of itself and from the schemas in the source tree."""
import json
import re
import subprocess
from concurrent.futures import ThreadPoolExecutor


class Program:
    def __init__(self, path):
        self.path = path

    def __call__(self, *words):
        done = subprocess.run([str(self.path), *words], capture_output=True, text=True, timeout=60, check=False)
        if done.returncode != 0:
            raise RuntimeError(f"plumbline {' '.join(words)}: {done.stderr}")
        return done.stdout

    def commands(self):
        """Names and one line of help, in the order of the program."""
        part = self("--help").split("Subcommands:")[1]
        return re.findall(r"^  ([a-z-]+) {2,}(.*(?:\n {20,}\S.*)*)", part, re.M)

    def sections(self):
        """Sections of scenes, in the order of the program's template."""
        return re.findall(r"^subsection (.*)$", self("template", "scalar"), re.M)

    def keys(self, section):
        """Keys of a section: name, help, default, allowed values."""
        blocks = re.split(r"\n(?=\S)", self("describe", section).rstrip("\n"))
        found = []
        for block in blocks:
            lines = block.split("\n")
            if lines[0] != section and not lines[0].startswith(section + "/"):
                continue
            texts = [line.strip() for line in lines[1:]]
            marked = {word: " ".join(text[len(word) + 2:] for text in texts if text.startswith(word + ": "))
                      for word in ("default", "allowed")}
            helps = [text for text in texts if not re.match(r"(default|allowed): ", text)]
            found.append((lines[0].strip(), " ".join(helps), marked["default"], marked["allowed"]))
        return found


def escape(text):
    return re.sub(r"([\\`*_{}\[\]<>|$#])", r"\\\1", text)


def commands_page(program):
    parts = ["# Commands", "", "Generated from `plumbline --help`.", "", "| command | purpose |", "|---|---|"]
    commands = program.commands()
    parts += [f"| [{name}](#{name}) | {escape(' '.join(text.split()))} |" for name, text in commands]
    for name, _ in commands:
        help_text = re.sub(r"^Usage: \S+ ", "Usage: plumbline ", program(name, "--help").strip(), flags=re.M)
        parts += ["", f"## {name}", "", "```text", wrap(help_text), "```"]
    return "\n".join(parts) + "\n"


def wrap(text, width=88):
    """Long lines of help, broken with their indent."""
    result = []
    for line in text.split("\n"):
        match = re.match(r"(  \S.{20,}? {2,}|\s*)(?=\S)", line)
        indent = " " * (len(match.group(1)) if match else 0)
        while len(line) > width:
            cut = line.rfind(" ", len(indent) + 1, width)
            if cut < 0:
                break
            result.append(line[:cut])
            line = indent + line[cut + 1:]
        result.append(line)
    return "\n".join(result)


def keys_page(program):
    parts = ["# Keys of scenes", "",
             "Generated from `plumbline describe`. A scene gives only the keys whose default does not fit; "
             "`plumbline template scalar` prints a scene with all of them."]
    sections = ["Purpose"] + program.sections()  # a key of its own
    with ThreadPoolExecutor(2) as pool:
        keys = list(pool.map(program.keys, sections))
    for section, some in zip(sections, keys):
        parts += ["", f"## {section}"]
        for name, text, default, allowed in some:
            anchor = re.sub(r"[^a-z0-9]+", "-", name.lower()).strip("-")
            parts += ["", f"({'key-' + anchor})=", f"### {name}", "", escape(text), "",
                      f"Default: {code(default)}. Allowed: {escape(allowed) or 'any text'}."]
    return "\n".join(parts) + "\n"


def code(text):
    return "empty" if text in ("", "(empty)") else f"`{text}`"


def table(header, rows):
    return ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)] + \
           ["| " + " | ".join(row) + " |" for row in rows]


def methods_page(program):
    words = re.compile(r"^(\S+?)\s*(meshfree|reference|local)\s+(.*)$")
    methods = [words.match(line).groups() for line in program("list", "methods").strip().split("\n")]
    kinds = {"meshfree": "meshfree rule", "reference": "Galerkin method", "local": "local model"}
    parts = ["# Methods, models and kernels", "",
             "Generated from `plumbline list`. [Rules](../theory/rules.md) and "
             "[Galerkin methods](../theory/galerkin.md) have their formulas.", "", "## Methods", ""]
    parts += table(["name", "kind", "description"],
                   [[f"`{name}`", kinds[kind], escape(text)] for name, kind, text in methods])
    for title, words, text in (
            ("Capabilities of methods", ("list", "methods", "--matrix"),
             "A method that lacks a capability that the scene needs is refused, and the message names methods that "
             "have it. Column names are words of the program: *floating* is a body without constraints, which has "
             "rigid-body modes; *collar* is the interaction domain; *mixed dilatation* keeps the dilatation as an "
             "unknown."),
            ("Capabilities of models", ("list", "models"), "`Material/model` selects a model."),
            ("Capabilities of analyses", ("list", "analyses"), "*motion* is transient analysis, *growth* is "
             "quasi-static fracture, *crack* is dynamic fracture, *strip* is the stationary crack.")):
        parts += ["", f"## {title}", "", text, "", program(*words).strip()]
    kernels = [re.match(r"^(.*?)\s+(c(?: .*?)?)   \((.*)\)$", line).groups()
               for line in program("list", "kernels").strip().split("\n")]
    parts += ["", "## Kernels", "", "`Kernel/type` selects a kernel; *c* follows from `Kernel/limit`, "
              "see [the model problem](../theory/model.md).", ""]
    parts += table(["Kernel/type", "C(ξ), r = &#124;ξ&#124;", "source"],
                   [[f"`{a}`", escape(b), escape(c)] for a, b, c in kernels])
    return "\n".join(parts) + "\n"


def schema_rows(properties, required, prefix=""):
    for name, value in properties.items():
        kind = value.get("type", "")
        if "$ref" in value:
            kind = value["$ref"].rsplit("/", 1)[-1]
        if "const" in value:
            kind = f"the number {value['const']}"
        items = value.get("items", {})
        if "$ref" in items:
            kind = f"array of {items['$ref'].rsplit('/', 1)[-1]}"
        if isinstance(kind, list):
            kind = " or ".join(kind)
        yield [f"`{prefix}{name}`", escape(str(kind)), "" if name in required else "optional",
               escape(value.get("description", ""))]


def without_links(text):
    """Links between files of the source tree are no links of the site."""
    return re.sub(r"\[([^\]]*)\]\((?!https?:)[^)]*\)", r"\1", text)


def results_page(root):
    """JSON files: schemas of the source tree, wherever in lib they are."""
    parts = ["# JSON results", "",
             "Each command writes all of its numbers as JSON. Numbers are the shortest decimals that read back to the "
             "same double."]
    for path in sorted((root / "lib").glob("**/*.schema.json")):
        schema = json.loads(path.read_text(encoding="utf-8"))
        parts += ["", f"## {schema['title']}", "", escape(schema.get("description", "")), "",
                  f"The schema is `{path.relative_to(root)}` of the source tree (JSON Schema).", ""]
        parts += table(["key", "type", "", "meaning"],
                       schema_rows(schema["properties"], schema.get("required", [])))
        for name, part in schema.get("$defs", {}).items():
            if "properties" in part:
                parts += ["", f"### {name}", "", escape(part.get("description", "")), ""]
                parts += table(["key", "type", "", "meaning"],
                               schema_rows(part["properties"], part.get("required", [])))
    for path in sorted((root / "lib").glob("**/schema.md")):
        text = without_links(path.read_text(encoding="utf-8").replace("\\|", "&#124;"))
        parts += ["", re.sub(r"^#", "##", text, flags=re.M)]
    return "\n".join(parts) + "\n"
