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

'python3 FILE' is a command, too. Each page has a working folder, with the folder scenes of the source tree; the tutorial
has one for all of its pages. Commands of a page run in order, two pages at a time, while Sphinx reads
the pages (Ahead).
"""
import csv
import pathlib
import re
import shlex
import subprocess
from concurrent.futures import Future, ThreadPoolExecutor

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


def write_page_file(folder, _, name, __, content):
    (folder / name).write_text("\n".join(content) + "\n", encoding="utf-8")


def run_command(folder, program, command, options, _):
    return run(shlex.split(command), folder, program, int(options.get("exit", 0)))


def run_fragment(folder, program, scene, options, content):
    part = folder / "fragment.prm"
    part.write_text("\n".join(content) + "\n", encoding="utf-8")
    words = ["plumbline"] + shlex.split(options["command"])
    words.insert(2, scene)
    for key, value in read_scene(part)["values"].items():
        words += ["--set", f"{key}={value}"]
    run(words + ["-o", "fragment"], folder, program)


def read_results(folder, _, name, __, ___):
    return (folder / name).read_text(encoding="utf-8")


# what a directive does, apart from what it shows
ACTIONS = {"file": write_page_file, "command": run_command, "fragment": run_fragment, "results": read_results}
BLOCK = re.compile(r"^```\{(" + "|".join(ACTIONS) + r")\} ([^\n]*)\n((?::[a-z]+:[^\n]*\n)*)(.*?)^```$", re.M | re.S)


class Ahead:
    """Carries out the actions of all pages before Sphinx comes to them."""

    def __init__(self, app):
        self.work, self.program = app.config.plumbline_folder, app.config.plumbline_program
        self.pool = ThreadPoolExecutor(2)
        self.actions = {}  # of each page, in order: what is done, and its outcome
        groups = {}
        for name in sorted(app.env.found_docs):
            text = pathlib.Path(app.env.doc2path(name)).read_text(encoding="utf-8")
            blocks = [(kind, argument.strip(), dict(re.findall(r":([a-z]+): *(.*)", options)),
                       content.strip("\n").split("\n") if content.strip() else [])
                      for kind, argument, options, content in BLOCK.findall(text)]
            if blocks:
                self.actions[name] = [(block, Future()) for block in blocks]
                group = name.split("/")[0] if name.startswith("tutorial/") else name.replace("/", "_")
                groups.setdefault(group, []).extend(self.actions[name])
        for group, actions in groups.items():
            folder = self.work / "pages" / group
            folder.mkdir(parents=True)
            (folder / "scenes").symlink_to(app.config.plumbline_root / "scenes")
            self.pool.submit(self.carry_out, folder, actions)

    def carry_out(self, folder, actions):
        for (kind, argument, options, content), outcome in actions:
            try:
                outcome.set_result(ACTIONS[kind](folder, self.program, argument, options, content))
            except Exception as error:  # pylint: disable=broad-except  # the directive reports it
                outcome.set_exception(error)

    def outcome(self, page, kind, argument, content):
        """The outcome of the next action of a page, which must be the directive that Sphinx has just read."""
        (kind_found, argument_found, _, content_found), outcome = self.actions[page].pop(0)
        if (kind, argument) != (kind_found, argument_found) or (content and list(content) != content_found):
            raise CommandFailed(f"'{kind} {argument}' is read as '{kind_found} {argument_found}' by Ahead")
        return outcome.result()


class Base(Directive):
    has_content = True
    required_arguments = 1
    final_argument_whitespace = True

    def outcome(self):
        """What the action of this directive returns."""
        env = self.state.document.settings.env
        return env.app.plumbline_ahead.outcome(env.docname, self.name, self.arguments[0], self.content)

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
        self.outcome()
        text = "\n".join(self.content) + "\n"
        name = self.arguments[0]
        languages = {"prm": "scene", "py": "python", "geo": "c"}
        return self.block(text, languages.get(name.rsplit(".", 1)[-1], "text"), name)


class Command(Base):
    option_spec = {"exit": directives.nonnegative_int, "head": directives.nonnegative_int,
                   "tail": directives.nonnegative_int, "lines": directives.unchanged, "silent": directives.flag}

    def show(self):
        command = self.arguments[0]
        output = self.outcome().rstrip("\n")
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
        self.outcome()
        return self.block("\n".join(self.content) + "\n", "scene")


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
        lines = self.outcome().splitlines()
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


def begin(app):
    app.plumbline_ahead = Ahead(app)


def end(app, _):
    ahead = getattr(app, "plumbline_ahead", None)  # none where Sphinx has failed before it read
    if ahead:
        ahead.pool.shutdown(cancel_futures=True)


def setup(app):
    app.connect("env-before-read-docs", lambda app, env, names: begin(app))
    app.connect("build-finished", end)
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
