"""Directives that run the program while the site is built, so that nothing shown can differ from it.

    {file} NAME             a file that the reader writes; written to the working folder, and shown
    {command} COMMAND       a command; run in the working folder, and shown with its output
        :exit: N            the exit code that it must have (0)
        :head: N, :tail: N  lines of the output that are shown; all unless given
        :lines: REGEX       only lines that contain it; one must
        :silent:            only the command is shown
    {fragment} SCENE        keys to add to a scene; run with that scene's other keys, and shown
        :command: OPTIONS   command and options with which it is run

    {source} FILE           a file of the source tree, which a test compiles
        :from: TEXT         from this text on
    {results} FILE          tables of a Markdown or CSV file that a command before has written
        :columns: NAMES     only these columns, separated by ';'

'python3 FILE' is a command, too. The working folder has the folder scenes of the source tree.
"""
import csv
import re
import shlex
import subprocess

from docutils import nodes
from docutils.parsers.rst import Directive, directives
from docutils.statemachine import StringList
from pygments.lexer import RegexLexer, bygroups
from pygments.token import Comment, Keyword, Name, Operator, Text

from plumbline_run import CommandFailed, run
from plumbline_scene import read_scene

WIDTH = 88  # characters of a shown line


class SceneLexer(RegexLexer):
    """Parameter files of deal.II."""
    name = "scene"
    aliases = ["scene"]
    tokens = {"root": [
        (r"#.*", Comment),
        (r"(subsection)([^\n#]*)", bygroups(Keyword, Name.Class)),
        (r"(set)([^=\n]*)(=)", bygroups(Keyword, Name.Attribute, Operator)),
        (r"(end|include)\b", Keyword),
        (r"[^#\n]+?(?=#|\n)", Text),
        (r"\n", Text),
    ]}


def fold(line, mark=""):
    """A long line in parts that fit into the page, but for rows of tables; commands break before an option."""
    is_row = not mark and "  " in line.strip() and len(re.split(r" {2,}", line)[-1]) < WIDTH // 2
    if len(line) <= WIDTH or is_row:
        return [line]
    places = [match.start() for match in re.finditer(r" (?=--)" if mark else r" (?=[^\s%])", line)]
    indent = "    " if mark else " " * (len(re.match(r"\s*(\S+ {2,})?", line).group()) % 40)
    place = max((place for place in places if len(indent) < place <= WIDTH - len(mark)), default=None)
    if place is None:
        return [line]
    return [line[:place] + mark] + fold(indent + line[place + 1:], mark)


def paragraphs(lines):
    """Prose that the program has broken at 120 characters, in one line again."""
    result, last = [], ""
    for line in lines:
        indent = " {2}" if result and result[-1].startswith("- ") else ""
        first = re.match(indent + r"(\S+)", line)
        if first and "  " not in last.strip() and len(last) <= 120 < len(last) + 1 + len(first.group(1)):
            result[-1] += " " + line.strip()
        else:
            result.append(line)
        last = line
    return result


class Base(Directive):
    has_content = True
    required_arguments = 1
    final_argument_whitespace = True

    def place(self):
        env = self.state.document.settings.env
        return env.config.plumbline_folder, env.config.plumbline_program

    def run(self):
        try:
            return self.show()
        except (CommandFailed, OSError, subprocess.TimeoutExpired) as error:
            return [self.state.document.reporter.warning(str(error), line=self.lineno)]

    def block(self, text, language, caption=""):
        literal = nodes.literal_block(text, text, language=language)
        if not caption:
            return [literal]
        frame = nodes.container("", literal_block=True, classes=["literal-block-wrapper"])
        frame += nodes.caption(caption, "", nodes.literal(caption, caption))
        frame += literal
        return [frame]


class File(Base):
    option_spec = {}

    def show(self):
        folder, _ = self.place()
        text = "\n".join(self.content) + "\n"
        name = self.arguments[0]
        (folder / name).write_text(text, encoding="utf-8")
        languages = {"prm": "scene", "py": "python", "geo": "c"}
        return self.block(text, languages.get(name.rsplit(".", 1)[-1], "text"), name)


class Command(Base):
    option_spec = {"exit": directives.nonnegative_int, "head": directives.nonnegative_int,
                   "tail": directives.nonnegative_int, "lines": directives.unchanged, "silent": directives.flag}

    def show(self):
        folder, program = self.place()
        command = self.arguments[0]
        output = run(shlex.split(command), folder, program, self.options.get("exit", 0)).rstrip("\n")
        shown = paragraphs(output.split("\n"))
        if "lines" in self.options:
            shown = [line for line in shown if re.search(self.options["lines"], line)]
            if not shown:
                raise CommandFailed(f"no line of '{command}' contains {self.options['lines']}:\n{output}")
        n_lines = len(shown)
        head, tail = self.options.get("head"), self.options.get("tail")
        if head is not None and n_lines > head:
            shown = shown[:head] + ["..."]
        elif tail is not None and n_lines > tail:
            shown = ["..."] + shown[-tail:]
        if "silent" in self.options:
            shown = []
        lines = fold("$ " + command, " \\") + [part for line in shown for part in fold(line)]
        return self.block("\n".join(lines), "console")


class Fragment(Base):
    option_spec = {"command": directives.unchanged_required}

    def show(self):
        folder, program = self.place()
        scene = self.arguments[0]
        text = "\n".join(self.content) + "\n"
        part = folder / "fragment.prm"
        part.write_text(text, encoding="utf-8")
        words = ["plumbline"] + shlex.split(self.options["command"])
        words.insert(2, scene)
        for key, value in read_scene(part)["values"].items():
            words += ["--set", f"{key}={value}"]
        run(words + ["-o", "fragment"], folder, program)
        return self.block(text, "scene")


class Source(Base):
    option_spec = {"from": directives.unchanged_required}

    def show(self):
        root = self.state.document.settings.env.config.plumbline_root
        text = (root / self.arguments[0]).read_text(encoding="utf-8")
        if "from" in self.options:
            text = text[text.index(self.options["from"]):]
        return self.block(text, "cmake" if self.arguments[0].endswith("CMakeLists.txt") else "cpp", self.arguments[0])


def in_short(cell):
    """A number of many digits, rounded to four."""
    return f"{float(cell):.4g}" if re.fullmatch(r"-?[0-9]*\.[0-9]{5,}(e-?[0-9]+)?", cell) else cell


class ResultTable(Base):
    option_spec = {"columns": directives.unchanged_required}

    def show(self):
        folder, _ = self.place()
        lines = (folder / self.arguments[0]).read_text(encoding="utf-8").splitlines()
        if self.arguments[0].endswith(".csv"):
            rows = [[in_short(cell) for cell in row] for row in csv.reader(lines)]
            rows.insert(1, ["---"] * len(rows[0]))
        else:
            rows = [[cell.strip() for cell in line.strip("| ").split("|")] for line in lines if line.startswith("|")]
        if "columns" in self.options:
            wanted = [name.strip() for name in self.options["columns"].split(";")]
            if not set(wanted) <= set(rows[0]):
                raise CommandFailed(f"{self.arguments[0]} has the columns {', '.join(rows[0])}")
            places = [rows[0].index(name) for name in wanted]
            rows = [[row[i] for i in places] for row in rows]
        text = StringList(["| " + " | ".join(row) + " |" for row in rows])
        node = nodes.Element()
        self.state.nested_parse(text, self.content_offset, node)
        return node.children


def setup(app):
    app.add_config_value("plumbline_program", None, "")
    app.add_config_value("plumbline_folder", None, "")
    app.add_lexer("scene", SceneLexer)
    app.add_config_value("plumbline_root", None, "")
    app.add_directive("file", File)
    app.add_directive("source", Source)
    app.add_directive("command", Command)
    app.add_directive("fragment", Fragment)
    app.add_directive("results", ResultTable)
    return {"parallel_read_safe": False}
