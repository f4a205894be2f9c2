"""Reference of the C++ library: a page for each folder, from the declarations and comments that Doxygen reads.

Each header is a part of the page of its folder: its classes with their public members, and its functions.
"""
import pathlib
import re
import shutil
import subprocess
import xml.etree.ElementTree as ET

FOLDERS = ["lib", "reference", "meshfree", "check", "driver"]
SETTINGS = {"GENERATE_HTML": "NO", "GENERATE_LATEX": "NO", "GENERATE_XML": "YES", "XML_PROGRAMLISTING": "NO",
            "XML_NS_MEMB_FILE_SCOPE": "YES", "RECURSIVE": "YES", "FILE_PATTERNS": "*.h", "QUIET": "YES",
            "JAVADOC_AUTOBRIEF": "NO", "EXTRACT_ALL": "YES", "WARNINGS": "NO", "WARN_IF_UNDOCUMENTED": "NO",
            "WARN_IF_DOC_ERROR": "NO", "WARN_IF_INCOMPLETE_DOC": "NO", "WARN_NO_PARAMDOC": "NO", "MACRO_EXPANSION": "YES", "BUILTIN_STL_SUPPORT": "YES",
            "HIDE_UNDOC_RELATIONS": "YES"}
TITLES = {"param": "Parameters", "return": "Returns", "throws": "Throws", "exception": "Throws"}


def read_declarations(root, folder):
    """Doxygen's XML of all headers."""
    if not shutil.which("doxygen"):
        raise SystemExit("docs needs doxygen: apt-get install doxygen")
    folder.mkdir(parents=True)
    values = {**SETTINGS, "INPUT": " ".join(FOLDERS), "OUTPUT_DIRECTORY": str(folder),
              "STRIP_FROM_PATH": str(root)}
    text = "".join(f"{key} = {value}\n" for key, value in values.items())
    subprocess.run(["doxygen", "-"], input=text, text=True, cwd=root, check=True, stdout=subprocess.DEVNULL)
    return folder / "xml"


def escaped(text):
    return re.sub(r"([\\`*_{}\[\]<>#$|~^])", r"\\\1", text)


def inline(node):
    """Text of a node with its children, as Markdown."""
    parts = [escaped(node.text or "")]
    for child in node:
        if child.tag == "computeroutput":
            parts.append(f"`{''.join(child.itertext())}`")
        elif child.tag in ("simplesect", "parameterlist", "itemizedlist", "orderedlist", "verbatim", "programlisting"):
            pass  # blocks, see words()
        elif child.tag == "linebreak":
            parts.append(" ")
        else:
            parts.append(inline(child))
        parts.append(escaped(child.tail or ""))
    return re.sub(r"\s+", " ", "".join(parts))


def block(child):
    if child.tag == "parameterlist":
        rows = []
        for item in child.iter("parameteritem"):
            names = ", ".join(f"`{''.join(name.itertext())}`" for name in item.iter("parametername"))
            text = " ".join(inline(para).strip() for para in item.findall("parameterdescription/para"))
            rows.append(f"{names}: {text}" if names != "``" else text)
        return f"*{TITLES.get(child.get('kind'), child.get('kind'))}:* " + "; ".join(rows)
    if child.tag == "simplesect":
        kind = child.get("kind")
        text = " ".join(inline(para).strip() for para in child.findall("para"))
        return f"*{TITLES.get(kind, kind.capitalize())}:* {text}"
    if child.tag in ("itemizedlist", "orderedlist"):
        return "\n".join("- " + " ".join(inline(para).strip() for para in item.findall("para"))
                         for item in child.findall("listitem"))
    return "```text\n" + "".join(child.itertext()).rstrip() + "\n```"


def words(node):
    """Brief and detailed description, a paragraph for each."""
    paragraphs = []
    for part in ("briefdescription", "detaileddescription", "inbodydescription"):
        for para in node.findall(f"{part}/para"):
            text = inline(para).strip()
            if text:
                paragraphs.append(text)
            paragraphs += [block(child) for child in para
                           if child.tag in ("parameterlist", "simplesect", "itemizedlist", "orderedlist", "verbatim",
                                            "programlisting")]
    return paragraphs


def plain(node):
    return re.sub(r"\s+", " ", "".join(node.itertext())).strip() if node is not None else ""


def declaration(member):
    kind, name = member.get("kind"), member.findtext("name")
    if kind == "enum":
        values = ", ".join(value.findtext("name") for value in member.findall("enumvalue"))
        return f"enum {name} {{ {values} }}"
    template = ", ".join(plain(param) for param in member.findall("templateparamlist/param"))
    text = f"template <{template}>\n" if template else ""
    type_ = plain(member.find("type"))
    start = {"typedef": "using " if not type_.startswith("using") else ""}.get(kind, "")
    if kind == "typedef":
        return f"{text}{start}{name} = {type_}"
    text += (type_ + " " if type_ else "") + name
    if kind in ("function", "friend"):
        text += member.findtext("argsstring") or ("()" if kind == "function" else "")
    elif kind == "variable" and member.findtext("initializer"):
        text += " " + plain(member.find("initializer"))
    return re.sub(r"< ", "<", re.sub(r" >", ">", text))


def members_of(compound):
    for section in compound.findall("sectiondef"):
        if section.get("kind", "").startswith("private"):
            continue
        for member in section.findall("memberdef"):
            if member.get("prot", "public") != "private" and member.findtext("name"):
                yield member


def described(members):
    """Declarations with the same description share a block; that of a variable is a comment beside it."""
    lines, last = [], None
    for member in members:
        text, line = words(member), declaration(member)
        line += "" if line.endswith("}") and member.get("kind") == "enum" else ";"
        if member.get("kind") == "variable" and text:
            line += "  // " + " ".join(plain(member.find(part)) for part in ("briefdescription", "detaileddescription")
                                       if plain(member.find(part)))
            text = []
        if lines and text != last:
            yield lines, last
            lines = []
        lines.append(line)
        last = text
    if lines:
        yield lines, last


def entries(members):
    parts = []
    for lines, text in described(members):
        parts += ["```cpp\n" + "\n".join(lines) + "\n```", *text]
    return parts


class Reference:
    def __init__(self, xml):
        self.xml = xml
        self.headers = {}
        for entry in ET.parse(xml / "index.xml").getroot().findall("compound"):
            if entry.get("kind") == "file":
                compound = self.compound(entry.get("refid"))
                self.headers[compound.find("location").get("file")] = compound

    def compound(self, name):
        text = (self.xml / f"{name}.xml").read_text(encoding="utf-8")
        # Doxygen takes "--" for a dash, and "> 0" at the beginning for a quotation
        text = re.sub(r"<blockquote><para>(<zwj/>)?", "&gt; ", text.replace("<ndash/>", "--"))
        return ET.fromstring(re.sub(r"</para>\s*</blockquote>", "", text)).find("compounddef")

    def header(self, path, compound):
        """A part of a page: the declarations of one header."""
        parts = [f"## {pathlib.PurePath(path).name}", f"`{path}`", *words(compound)]
        for inner in compound.findall("innerclass"):
            file = self.xml / f"{inner.get('refid')}.xml"
            name = "".join(inner.itertext()).split("plumbline::")[-1]
            if inner.get("prot") == "private" or not file.exists() or "detail::" in name:
                continue
            this = self.compound(inner.get("refid"))
            parts += [f"### {this.get('kind')} {escaped(name)}", *words(this), *entries(members_of(this))]
        functions = entries(member for member in members_of(compound) if member.get("kind") != "define")
        if functions and any(part.startswith("### ") for part in parts):
            parts.append("### Functions")
        return parts + functions

    def pages(self):
        """Name and text of each page."""
        folders = {}
        for path in sorted(self.headers):
            folders.setdefault(str(pathlib.PurePath(path).parent), []).append(path)
        for folder, paths in sorted(folders.items()):
            name = folder.replace("/", "_")
            parts = [f"# {folder}"]
            for path in paths:
                parts += self.header(path, self.headers[path])
            yield name, folder, len(paths), "\n\n".join(parts) + "\n"


def write_pages(root, source, work):
    """reference/cpp/FOLDER.md for each folder, and their index."""
    target = source / "reference" / "cpp"
    target.mkdir(parents=True)
    rows = []
    for name, folder, n, text in Reference(read_declarations(root, work)).pages():
        (target / f"{name}.md").write_text(text, encoding="utf-8")
        rows.append((name, folder, n))
    lines = ["# Classes and functions", "",
             "All public declarations of the library with their comments, folder by folder. They state shapes, units, "
             "accuracy, sources and limits.", "", "| folder | headers |", "|---|---|",
             *(f"| [{folder}]({name}.md) | {n} |" for name, folder, n in rows), "", "```{toctree}", ":hidden:", "",
             *(name for name, _, _ in rows), "```", ""]
    (target / "index.md").write_text("\n".join(lines), encoding="utf-8")
