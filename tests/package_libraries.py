"""Each shared library that a file of the package is linked with is in a package that it depends on.

package_libraries.py DEPENDS FILE...    DEPENDS is the field of the package
"""
import os
import re
import subprocess
import sys


def out(*command):
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout


def libraries(file):
    """The names that it is linked with, and the files that they lead to."""
    places = dict(re.findall(r"(\S+) => (/\S+)", out("ldd", file)))
    for name in re.findall(r"NEEDED\s+(\S+)", out("objdump", "--private-headers", file)):
        if not name.startswith("ld-linux"):
            yield name, os.path.realpath(places.get(name, name))


def owners(paths):
    """Packages by files."""
    found = {}
    for line in out("dpkg-query", "--search", *{"*/" + os.path.basename(path) for path in paths}).splitlines():
        packages, _, file = line.rpartition(": ")
        found.setdefault(os.path.realpath(file), set()).update(one.split(":")[0] for one in packages.split(", "))
    return found


def main(field, files):
    depends = set(re.findall(r"(?:^|[,|])\s*([a-z0-9][a-z0-9.+-]*)", field))
    needed = {name: path for file in files for name, path in libraries(file)}
    packages = owners(needed.values())
    wrong = [name for name, path in needed.items() if not depends & packages.get(path, set())]
    if wrong or not needed:
        sys.exit(f"the package depends on no package with {', '.join(wrong) or 'libraries'}")


main(sys.argv[1], sys.argv[2:])
