#!/usr/bin/env python3
"""Functions of the C++ sources with their lines, as universal-ctags finds them.

Run as a program (ctest `house/functions`), it reports each function with more than `most_lines` lines.
"""
import pathlib
import subprocess
import sys
from typing import NamedTuple

folders = ["lib", "reference", "meshfree", "check", "driver", "app", "python", "benchmarks"]
most_lines = 80
# functions that may be longer: the most lines of each, and the reason
exceptions = {
    "scene::DomainSection::declare": (90, "a list of keys"),
}


class Definition(NamedTuple):
    """A function, or a variable outside of functions."""
    name: str  # with namespaces and classes
    is_function: bool
    file: str
    first: int  # the line of the name, from 1
    last: int

    def is_called(self, name):
        return ("::" + self.name).endswith("::" + name)


def list_definitions(root):
    """@return  definitions file by file, in the order of lines"""
    listed = subprocess.run(
        ["ctags", "--languages=C++", "--langmap=C++:.cc.h", "--kinds-C++=fv", "--sort=no",
         "-x", "--_xformat=%K\t%s::%N\t%F\t%n\t%{end}", "-R", *folders],
        cwd=root, check=True, stdout=subprocess.PIPE, text=True).stdout
    result = []
    for line in listed.splitlines():
        kind, name, file, first, last = line.split("\t")
        parts = name.replace(" ", "").split("::")
        if not parts[-1].startswith("__anon"):  # lambda expressions belong to their functions
            name = "::".join(part for part in parts if part and not part.startswith("__anon"))
            result.append(Definition(name, kind == "function", file, int(first), int(last or first)))
    return sorted(result, key=lambda one: (one.file, one.first))


def main():
    root = pathlib.Path(__file__).parents[1]
    definitions = [one for one in list_definitions(root) if one.is_function]
    if len(definitions) < 2000:
        sys.exit(f"only {len(definitions)} functions seen: ctags does not find the sources")
    n_long = 0
    for one in definitions:
        n_lines = one.last - one.first + 1
        most = max([most_lines] + [limit for name, (limit, _) in exceptions.items()
                                   if one.is_called(name)])
        if n_lines > most:
            n_long += 1
            print(f"{one.file}:{one.first}: {one.name} has {n_lines} lines, more than {most}: "
                  "move the parts that have names of their own into functions")
    for name in exceptions:
        if not any(one.is_called(name) for one in definitions):
            n_long += 1
            print(f"tests/functions.py: the exception {name} is no function")
    sys.exit(n_long > 0)


if __name__ == "__main__":
    main()
