"""Reference of the Python package: signatures and docstrings, as help() shows them."""
import json
import os
import pathlib
import subprocess

# run by the python3 that the package is built for
LIST = r"""
import inspect, json, re, plumbline

def signature(name, thing):
    try:
        return name + str(inspect.signature(thing))
    except (TypeError, ValueError):
        return name

def entry(name, thing):
    text = inspect.getdoc(thing) or ""
    first, _, rest = text.partition("\n")
    if re.match(re.escape(name.split(".")[-1]) + r"\(.*\)( -> .*)?$", first):  # written by pybind11
        return {"name": name, "signature": re.sub(r"plumbline\._core\.", "", first), "text": rest.strip("\n")}
    of_class = inspect.isclass(thing)
    return {"name": name, "signature": name if of_class else signature(name, thing), "text": text}

def members(name, thing):
    own = [(one, getattr(thing, one)) for one in vars(thing) if not one.startswith("_")]
    return [entry(name + "." + one, value) for one, value in own if inspect.getdoc(value)]

def all_of(module, prefix=""):
    found = []
    for name in sorted(dir(module), key=str.lower):
        thing = getattr(module, name)
        if name.startswith("_") or (inspect.ismodule(thing) and (prefix or "plumbline" not in thing.__name__)):
            continue
        if inspect.ismodule(thing):
            found.append({"name": name, "signature": "plumbline." + name, "text": inspect.getdoc(thing) or "",
                          "members": all_of(thing, name + ".")})
        elif "plumbline" in (getattr(thing, "__module__", "") or ""):
            one = entry(prefix + name, thing)
            one["members"] = members(prefix + name, thing) if inspect.isclass(thing) else []
            found.append(one)
    return found

print(json.dumps(all_of(plumbline)))
"""


def part(one, level):
    lines = ["", "#" * level + f" {one['name']}", "", "```python", one["signature"], "```"]
    if one["text"]:
        lines += ["", "```text", one["text"], "```"]
    for member in one.get("members", []):
        lines += part(member, level + 1)
    return lines


def page(program):
    """@param program  the executable, beside whose folder the package is built"""
    package = pathlib.Path(program).parent.parent / "python"
    lines = ["# Functions and classes", ""]
    if not (package / "plumbline").is_dir():
        return "\n".join(lines + ["The Python package was not built together with this site."]) + "\n"
    done = subprocess.run(["/usr/bin/python3", "-c", LIST], env={**os.environ, "PYTHONPATH": str(package)},
                          capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise SystemExit(f"the Python package in {package} cannot be imported:\n{done.stderr}")
    found = json.loads(done.stdout)
    if not found:
        raise SystemExit(f"the Python package in {package} is not whole; build the target plumbline_python")
    lines += ["The whole package, as `help()` shows it. [Python](python.md) has an overview and examples."]
    for one in found:
        lines += part(one, 2)
    return "\n".join(lines) + "\n"
