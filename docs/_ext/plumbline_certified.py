"""The page of certified problems: formula, picture and values of each, from the certificates."""
import csv
import html
import json
import math
import pathlib
import re
from concurrent.futures import ThreadPoolExecutor

from plumbline_gallery import Drawing, breakable, physical_cells
from plumbline_run import CommandFailed, run
from plumbline_scene import boxes, number, read_scene

N = 32  # places of a picture along the longest side
# from small to large, as colour-blind readers can tell apart (a few colours of viridis)
COLOURS = [(68, 1, 84), (59, 82, 139), (33, 145, 140), (94, 201, 98), (253, 231, 37)]
MODELS = {
    "scalar": r"-\int_{B_\delta(x)} C(\xi)\,(u(x+\xi) - u(x))\,d\xi = b(x)",
    "coefficient": r"-\int_{B_\delta(x)} a(x, x+\xi)\,C(\xi)\,(u(x+\xi) - u(x))\,d\xi = b(x)",
    "tensor": r"-\int_{B_\delta(x)} C(\xi)\,(u(x+\xi) - u(x))\,d\xi = b(x),\quad C = c\,\rho(|\xi|/\delta)\,"
              r"\frac{\xi\otimes\xi}{|\xi|^2}",
}


def colour(t):
    """Of t in [0, 1]."""
    place = min(max(t, 0), 1) * (len(COLOURS) - 1)
    k = min(int(place), len(COLOURS) - 2)
    return "#%02x%02x%02x" % tuple(round(a + (place - k) * (b - a)) for a, b in zip(COLOURS[k], COLOURS[k + 1]))


def is_in_space(values):
    return values.get("Domain/dimension") == "3"


def is_on_line(values):
    return values.get("Domain/dimension") == "1"


def mapped(values, point):
    """A corner of a box, where a map of the mesh takes it."""
    if "Domain/map" not in values:
        return point
    names = {"__builtins__": {}, "abs": abs, "x": point[0], "y": point[1]}
    return tuple(eval(one.replace("^", "**"), names) for one in values["Domain/map"].split(","))


def triangles(values, certificate, folder):
    """Of a domain that gmsh meshes, smaller than those of the solution; none: it is of boxes."""
    mesh = values.get("Domain/mesh", "")
    if not mesh.endswith(".geo"):
        return []
    return [corners for name, corners in physical_cells(folder / mesh, .12, certificate["horizon"], 2) if name == "omega"]


def grid(values, certificate):
    """Places of a picture in the domain, the step between them; in space those of a plane z = const."""
    domain, holes = ([[mapped(values, corner) for corner in box] for box in boxes(text)]
                     for text in (values.get("Domain/boxes", "0, 0 : 1, 1"), values.get("Domain/holes", "")))
    dim = 3 if is_in_space(values) else 1 if is_on_line(values) else 2
    lower = [min(box[0][i] for box in domain) for i in range(dim)]
    upper = [max(box[1][i] for box in domain) for i in range(dim)]
    if dim == 1:
        step = (upper[0] - lower[0]) / (8 * N)
        middles = [lower[0] + (i + .5) * step for i in range(8 * N)]
        return [(x,) for x in middles if any(box[0][0] < x < box[1][0] for box in domain)], step, 0
    step = max(upper[i] - lower[i] for i in (0, 1)) / N
    heights = sorted({point["x"][2] for point in certificate["points"]}) if dim == 3 else [0]
    height = heights[len(heights) // 2]

    def has(box, x):
        return all(box[0][i] < x[i] < box[1][i] for i in range(dim))
    places = []
    for j in range(round((upper[1] - lower[1]) / step)):
        for i in range(round((upper[0] - lower[0]) / step)):
            x = (lower[0] + (i + .5) * step, lower[1] + (j + .5) * step, height)[:dim]
            if any(has(box, x) for box in domain) and not any(has(box, x) for box in holes):
                places.append(x)
    return places, step, height


def field(name, certificate, places, work, program):
    """u at the places of the picture, by the method of the certificate on the coarsest mesh of the scene."""
    folder = work / "certified" / name
    folder.mkdir(parents=True)
    points = folder / "places.csv"
    axes = ["x", "y", "z"][:len(places[0])]
    points.write_text(",".join(axes) + "\n" + "".join(",".join(f"{x:.12g}" for x in p) + "\n" for p in places),
                      encoding="utf-8")
    run(["plumbline", "run", f"scenes/certified/{name}.prm", "--levels", "1", "--methods",
         certificate["galerkin"]["method"], "--set", "Reference/estimate=none", "--set", f"Output/points={points}",
         "--quiet", "-o", str(folder / "run")], work, program)
    found = sorted(file for file in (folder / "run" / "points").glob("*_level1.csv")
                   if not file.name.endswith("_reference_level1.csv"))
    if len(found) != 1:
        raise CommandFailed(f"{name}: {len(found)} files of values at points")
    with found[0].open(encoding="utf-8") as lines:
        rows = list(csv.DictReader(lines))
    n = certificate["n_components"]
    names = ["u"] if n == 1 else [f"u{c + 1}" for c in range(n)]
    return [math.hypot(*(float(row[one]) for one in names)) if n > 1 else float(row["u"]) for row in rows]


def curve(certificate, places, step, u):
    """u over x, a piece for each interval, with the certified points."""
    lower, upper = places[0][0] - step / 2, places[-1][0] + step / 2
    low, high = min([0, *u]), max(u)
    scale = .5 * (upper - lower) / (high - low)

    def at(x, value):
        return x, (value - low) * scale
    drawing = Drawing((lower, 0), (upper + .3 * (upper - lower), .5 * (upper - lower)))
    drawing.line([at(lower, 0), at(upper, 0)], 'stroke="#7a8ca0" stroke-width="0.8"')
    pieces = [[]]
    for (x,), value in zip(places, u):
        if pieces[-1] and x - pieces[-1][-1][0] > 1.5 * step:
            pieces.append([])
        pieces[-1].append(at(x, value))
    for piece in pieces:
        drawing.line(piece, f'stroke="{colour(.25)}" stroke-width="1.6"')
    drawing.dots([at(point["x"][0], point["value"][0]) for point in certificate["points"]],
                 'stroke="#000000" stroke-width="4"')
    for value in (0, high):
        x, y = at(upper + .03 * (upper - lower), value)
        drawing.parts.append(f'<text x="{drawing.x(x)}" y="{drawing.y(y - .04 * (upper - lower) * (value > 0))}" '
                             f'font-size="11" font-family="sans-serif">u = {value:.3g}</text>')
    return drawing.text(), f"u for x from {lower:g} to {upper:g}; dots: certified points"


def picture(name, values, certificate, folder, work, program):
    """@param folder  of the scene"""
    cells = triangles(values, certificate, folder)
    if cells:
        places, step, height = [tuple(sum(p[i] for p in cell) / 3 for i in (0, 1)) for cell in cells], 0, 0
    else:
        places, step, height = grid(values, certificate)
    u = field(name, certificate, places, work, program)
    if is_on_line(values):
        return curve(certificate, places, step, u)
    low, high = min(u), max(u)
    corners = [p for cell in cells for p in cell] or places
    lower = [min(p[i] for p in corners) - step / 2 for i in (0, 1)]
    upper = [max(p[i] for p in corners) + step / 2 for i in (0, 1)]
    drawing = Drawing(lower, (upper[0] + .3 * (upper[0] - lower[0]), upper[1]))
    tones = [colour((value - low) / (high - low) if high > low else .5) for value in u]
    for cell, tone in zip(cells, tones):
        drawing.polygon(cell, f'fill="{tone}" stroke="{tone}" stroke-width="0.5"')
    for p, tone in zip(places if not cells else [], tones):
        drawing.box((p[0] - step / 2, p[1] - step / 2), (p[0] + step / 2, p[1] + step / 2),
                    f'fill="{tone}" stroke="{tone}" stroke-width="0.5"')
    dots = [point["x"] for point in certificate["points"] if len(point["x"]) == 2 or point["x"][2] == height]
    drawing.dots(dots, 'stroke="#ffffff" stroke-width="4"')
    drawing.dots(dots, 'stroke="#000000" stroke-width="2.4"')
    left = upper[0] + .04 * (upper[0] - lower[0])
    n_tones = 24
    tall = (upper[1] - lower[1]) / n_tones
    for k in range(n_tones):
        drawing.box((left, lower[1] + k * tall), (left + .05 * (upper[0] - lower[0]), lower[1] + (k + 1) * tall),
                    f'fill="{colour((k + .5) / n_tones)}" stroke="{colour((k + .5) / n_tones)}" stroke-width="0.5"')
    for y, value in ((lower[1], low), (upper[1] - .05 * (upper[1] - lower[1]), high)):
        drawing.parts.append(f'<text x="{drawing.x(left + .07 * (upper[0] - lower[0]))}" y="{drawing.y(y)}" '
                             f'font-size="11" font-family="sans-serif">{value:.3g}</text>')
    shown = "u" if certificate["n_components"] == 1 else "|u|"
    where = f" at z = {height:g}" if is_in_space(values) else ""
    return drawing.text(), f"{shown}{where}; dots: certified points"


def equation(values):
    kind = values.get("Kernel/type", "linear-decay")
    if values.get("Material/model", "bond-based") != "bond-based":
        return ""
    if kind.startswith("bond-tensor"):
        return MODELS["tensor"]
    return MODELS["coefficient" if "Kernel/coefficient" in values else "scalar"]


def statement(values, certificate, kernels):
    """The rows that state a problem."""
    solution, load = values.get("Problem/solution", ""), values.get("Problem/load", "manufactured")
    model = values.get("Material/model", "bond-based")
    constants = ", ".join(f"{key} = {values['Material/' + key]}" for key in ("E", "nu", "k", "l")
                          if "Material/" + key in values)
    rows = [("domain", pathlib.Path(values["Domain/mesh"]).name if values.get("Domain/mesh", "").endswith(".geo")
             else values.get("Domain/boxes", "0, 0 : 1, 1")
             + (f" without {values['Domain/holes']}" if "Domain/holes" in values else "")
             + (f", mapped by {values['Domain/map']}" if "Domain/map" in values else "")),
            ("horizon δ", f"{certificate['horizon']:g}"),
            ("model", model + (f", {constants}" if constants else "")),
            ("kernel, or influence function", kernels[values.get("Kernel/type", "linear-decay")]
             + "".join(f"; {key}: {values['Kernel/' + key]}" for key in
                       ("coefficients", "singularity", "width", "table file", "coefficient", "symmetrisation", "bulk modulus")
                       if "Kernel/" + key in values)),
            ("normalisation", f"Kernel/limit = {values.get('Kernel/limit', '-1/2 Laplace')}"),
            ("load b", re.sub(r"^\w+: ", "", load) if load != "manufactured" else "manufactured from the solution"),
            ("u around the domain", values.get("Problem/constraint", "the solution"))]
    if solution:
        rows.append(("solution", re.sub(r"^\w+: ", "", solution)))
    return rows


def rounded(value, bound):
    """A value with the digits that its bound leaves, and one more."""
    decimals = max(0, 1 - math.floor(math.log10(bound))) if bound > 0 else 15
    return f"{value:.{min(decimals, 16)}f}"


def value_rows(certificate):
    for point in certificate["points"] + ([certificate["mean"]] if certificate["mean"] else []):
        place = ", ".join(f"{x:g}" for x in point["x"]) or "mean over the domain"
        yield place, ", ".join(rounded(u, point["bound"]) for u in point["value"]), f"{point['bound']:.1e}", \
            str(point["digits"])


def table(head, rows, is_text=False):
    cell = html.escape
    lines = ["<table>", "<tr>" + "".join(f"<th>{cell(one)}</th>" for one in head) + "</tr>" if head else ""]
    for row in rows:
        first = f"<th>{cell(row[0])}</th>" if is_text else f"<td>{cell(row[0])}</td>"
        lines.append("<tr>" + first + "".join(f"<td>{cell(one)}</td>" for one in row[1:]) + "</tr>")
    return [line for line in lines if line] + ["</table>"]


def section(path, work, program, pictures, kernels):
    name = path.stem
    certificate = json.loads(path.with_suffix(".certificate.json").read_text(encoding="utf-8"))
    scene = read_scene(path)
    values, title = scene["values"], name.replace("_", "-")
    drawing, caption = picture(name, values, certificate, path.parent, work, program)
    file = f"certified_{name}.svg"
    (pictures / file).write_text(drawing, encoding="utf-8")
    digits = min(point["digits"] for point in certificate["points"])
    command, = [one[len("Run: "):] for one in scene["comments"] if one.startswith("Run: plumbline certify ")]
    formula = equation(values)
    rules = [(rule["method"], f"{rule['h'][-1]:g}", f"{rule['rms'][-1]:.1e}", str(rule["digits"][-1]))
             for rule in certificate["rules"]]
    parts = [f"## {title}", "", certificate["purpose"].removeprefix(f"{title}: ") + f". {digits} digits at all "
             f"{len(certificate['points'])} points, by {certificate['galerkin']['method']}; confirmed by "
             f"{certificate['meshfree']['method']}.", ""]
    parts += [f"$${formula}$$" if formula else "The equations are those of [state-based solids]"
              "(theory/state_based.md).", ""]
    parts += ["```{raw} html", '<div class="certified">',
              f'<figure><img src="_static/gallery/{file}" alt="{caption}" loading="lazy">'
              f"<figcaption>{html.escape(caption)}</figcaption></figure>",
              *table([], statement(values, certificate, kernels), True), "</div>",
              "<details><summary>Certified values and error bounds</summary>",
              *table(["point", "u", "bound", "digits"], value_rows(certificate)), "</details>",
              "<details><summary>Errors of meshfree rules</summary>",
              *table(["rule", "h", "rms error, relative", "digits"], rules), "</details>",
              f"<p>Grade: <code>plumbline grade mine.csv --problem {title}</code><br>"
              f"Certify again: <code>{breakable(command)}</code></p>", "```", ""]
    return parts, (title, certificate, digits)


def kernel_formulas(tell):
    """Formulas by the names of kernels, as `plumbline list kernels` prints them."""
    found = {}
    for line in tell("list", "kernels").splitlines():
        name, formula = re.match(r"(\S+(?: (?!c )\S+)?) +(c.*?) {3}\(", line).groups()
        found[name] = formula
    return found


def page(root, program, tell, work, pictures):
    """@param tell  runs the program and returns what it prints"""
    kernels = kernel_formulas(tell)
    paths = sorted((root / "scenes" / "certified").glob("*.prm"))
    with ThreadPoolExecutor(2) as pool:
        found = list(pool.map(lambda path: section(path, work, program, pictures, kernels), paths))
    parts = ["# Certified problems", "",
             f"{len(paths)} problems with certified values at given points. A Galerkin method gives the values with "
             "error bounds; a meshfree rule that shares no quadrature with it confirms them "
             "([how](guides/certify.md)). Bounds hold in practice and are not proven. Digits are relative to the root "
             "mean square of the values.", "",
             "To grade your code, print the points (`plumbline grade --points --problem NLB-01`) and the scene "
             "(`--scene`), write the values of your code to a CSV file (`x,y,u`), and run `plumbline grade mine.csv "
             '--problem NLB-01`; in Python `plumbline.grade("mine.csv", problem="NLB-01")`.', "",
             "| problem | statement | points | digits | confirmed to (relative) |", "|---|---|---|---|---|"]
    for _, (title, certificate, digits) in found:
        relative = max(max([p["other_bound"]] + [abs(a - b) for a, b in zip(p["value"], p["other"])])
                       for p in certificate["points"]) / certificate["size"]
        purpose = certificate["purpose"].removeprefix(f"{title}: ")
        parts.append(f"| [{title}](#{title.lower()}) | {purpose} | {len(certificate['points'])} | {digits} | "
                     f"{relative:.0e} |")
    parts.append("")
    for section_parts, _ in found:
        parts += section_parts
    return "\n".join(parts) + "\n"
