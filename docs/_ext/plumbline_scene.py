"""Reads scene files as the documentation needs them: values of keys, without their meaning."""
import ast
import math
import operator
import re


def read_scene(path):
    """Purpose, opening comment and the given keys of a .prm file: {'Section/key': text}."""
    values, comments, sections, pending = {}, [], [], ""
    for line in path.read_text(encoding="utf-8").splitlines():
        if not values and not sections and line.startswith("#"):
            comments.append(line[1:].strip())
        line = pending + re.sub(r"(^|\s)#.*", "", line).strip()
        if line.endswith("\\"):
            pending = line[:-1].rstrip() + " "
            continue
        pending = ""
        if line.startswith("subsection "):
            sections.append(line.split(None, 1)[1])
        elif line == "end":
            sections.pop()
        elif line.startswith("set "):
            key, value = line[4:].split("=", 1)
            values["/".join(sections + [key.strip()])] = value.strip()
        elif line.startswith("include "):
            included = read_scene(path.parent / line.split(None, 1)[1])
            values = {**included["values"], **values}
    return {"comments": comments, "values": values}


_OPERATORS = {ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv,
              ast.Pow: operator.pow}


def number(text):
    """A number such as 0.5, 3*pi/8 or -1e-3."""
    def value(node):
        if isinstance(node, ast.Expression):
            return value(node.body)
        if isinstance(node, ast.Constant):
            return float(node.value)
        if isinstance(node, ast.Name) and node.id in ("pi", "_pi"):
            return math.pi
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
            return -value(node.operand)
        if isinstance(node, ast.BinOp):
            return _OPERATORS[type(node.op)](value(node.left), value(node.right))
        raise ValueError(f"no number: {text}")
    return value(ast.parse(text.strip().replace("^", "**"), mode="eval"))


def numbers(text):
    return [number(part) for part in text.split(",") if part.strip()]


def boxes(text):
    """'x0, y0 : x1, y1; ...' as lists of points."""
    return [[tuple(numbers(point)) for point in box.split(":")] for box in text.split(";") if box.strip()]
