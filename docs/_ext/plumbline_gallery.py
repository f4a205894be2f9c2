"""The gallery: a drawing of the problem of each shipped scene, and results of some."""
import html
import math
import re
import shlex
import shutil
import subprocess
from concurrent.futures import ThreadPoolExecutor

from plumbline_run import CommandFailed, run
from plumbline_scene import boxes, number, numbers, read_scene

# results that are shown: command, scene, options that make it short, the picture of its folder, caption
RESULTS = [
    ("run", "ipa_ac/scalar_delta_convergence", "--levels 3 --methods FA,IPA-AC,IPA-AC-R2,Q1 --set Study/m=3",
     "*error-maps*.svg", "Error maps of four methods on one lattice"),
    ("run", "ipa_ac/gaussian", "--levels 4", "*convergence*wave*.svg",
     "Convergence at a fixed ratio m: which methods stall?"),
    ("dispersion", "waves/diffusion", "", "*phase*waves-at-0*.svg", "Phase speeds of all methods along an axis"),
    ("grow", "fracture/plate", "--set Study/h=0.05", "*moments*.svg",
     "A crack that grows bond by bond: damage at six stages"),
    ("crack", "griffith/branching", "--set Study/h=0.01 --check", "*moments*.svg",
     "A crack that branches at four times the threshold"),
    ("strip", "fracture/strip", "--levels 2 --methods DGQ1,PA-AC,IPA-AC", "*tip-energy*.svg",
     "Energy of the crack tip by three methods"),
    ("sample", "random/smooth", "--levels 1", "*mean-samples*.svg", "Error of the mean over the number of samples"),
    ("run", "dynamics/schemes", "", "*orders*.svg", "Orders of time-stepping schemes"),
]

COLOURS = {"omega": "#dbe7f3", "collar": "#f3efe2", "grips": "#c9c9c9", "crack": "#c0392b", "ball": "#d9822b"}


class Drawing:
    def __init__(self, lower, upper):
        self.lower, self.upper = lower, upper
        self.scale = 240 / max(upper[0] - lower[0], upper[1] - lower[1], 1e-12)
        self.parts = []

    def x(self, value):
        return f"{(value - self.lower[0]) * self.scale + 4:.1f}"

    def y(self, value):
        return f"{(self.upper[1] - value) * self.scale + 4:.1f}"

    def box(self, lower, upper, style):
        self.parts.append(f'<rect x="{self.x(lower[0])}" y="{self.y(upper[1])}" '
                          f'width="{(upper[0] - lower[0]) * self.scale:.1f}" '
                          f'height="{(upper[1] - lower[1]) * self.scale:.1f}" {style}/>')

    def line(self, points, style):
        text = " ".join(f"{self.x(p[0])},{self.y(p[1])}" for p in points)
        self.parts.append(f'<polyline points="{text}" fill="none" {style}/>')

    def polygon(self, points, style):
        text = " ".join(f"{self.x(p[0])},{self.y(p[1])}" for p in points)
        self.parts.append(f'<polygon points="{text}" {style}/>')

    def dots(self, points, style):
        text = "".join(f"M{self.x(p[0])} {self.y(p[1])}h0" for p in points)
        self.parts.append(f'<path d="{text}" stroke-linecap="round" {style}/>')

    def circle(self, centre, radius, style):
        self.parts.append(f'<circle cx="{self.x(centre[0])}" cy="{self.y(centre[1])}" '
                          f'r="{radius * self.scale:.1f}" {style}/>')

    def text(self):
        width = (self.upper[0] - self.lower[0]) * self.scale + 8
        height = (self.upper[1] - self.lower[1]) * self.scale + 8
        return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {height:.0f}" '
                f'width="{width:.0f}" height="{height:.0f}">' + "".join(self.parts) + "</svg>\n")


def first(values, key, default):
    return numbers(values.get(key, default))[0]


def lengths(values):
    """Coarsest mesh size and its horizon; a level is h, m or the horizon, as the regime says."""
    regime = values.get("Study/regime", "delta")
    h, m = first(values, "Study/h", "0.1"), first(values, "Study/m", "3")
    if regime in ("m", "horizon") and "Study/horizon" in values:
        return h, first(values, "Study/horizon", "0.3")
    return h, m * h


EDGES = {4: [(a, b) for a in range(4) for b in range(a)],
         8: [(k + j, (k + 1) % 4 + j) for k in range(4) for j in (0, 4)] + [(k, k + 4) for k in range(4)]}


def middle_section(cells):
    """What the plane across z in their middle cuts out of tetrahedra and hexahedra: polygons."""
    z = [point[2] for _, corners in cells for point in corners]
    middle_height = (min(z) + max(z)) / 2
    parts = []
    for name, corners in cells:
        heights = [point[2] - middle_height + 1e-9 for point in corners]  # no corner lies in the plane
        cut = []
        for a, b in EDGES[len(corners)]:
            if heights[a] * heights[b] < 0:
                s = heights[a] / (heights[a] - heights[b])
                cut.append([(1 - s) * corners[a][i] + s * corners[b][i] for i in (0, 1)])
        if cut:
            middle = [sum(p[i] for p in cut) / len(cut) for i in (0, 1)]
            parts.append((name, sorted(cut, key=lambda p: math.atan2(p[1] - middle[1], p[0] - middle[0]))))
    return parts


def physical_cells(file, h, horizon, dimension):
    """Cells of a .geo file with the name of their physical surface; in three dimensions their section across z."""
    text = subprocess.run(["gmsh", f"-{dimension}", "-v", "0", "-setnumber", "h", str(h), "-setnumber", "delta", str(horizon),
                           "-format", "msh2", "-o", "/dev/stdout", str(file)], capture_output=True, text=True,
                          check=True).stdout
    names, points, cells, section = {}, {}, [], ""
    for line in text.splitlines():
        words = line.split()
        if line.startswith("$"):
            section = line
        elif section == "$PhysicalNames" and len(words) == 3:
            names[words[1]] = words[2].strip('"')
        elif section == "$Nodes" and len(words) == 4:
            points[words[0]] = tuple(float(x) for x in words[1:dimension + 1])
        elif section == "$Elements" and len(words) > 5 and words[1] in (("2", "3") if dimension == 2 else ("4", "5")):
            cells.append((names.get(words[3], "omega"), [points[w] for w in words[3 + int(words[2]):]]))
    return cells if dimension == 2 else middle_section(cells)


def sketch(values, folder):
    """The problem: domain, interaction domain, grips, cracks, nodes of the coarsest level, and one ball."""
    h, horizon = lengths(values)
    mesh = values.get("Domain/mesh", "lattice")
    if "Strip/height" in values:
        height, length, crack = (number(values["Strip/" + key]) for key in ("height", "length", "crack"))
        values = {**values, "Domain/boxes": f"0, {-height / 2} : {length}, {height / 2}",
                  "Domain/cracks": f"0, 0 : {crack}, 0", "Domain/boundary": "free"}
    domain = boxes(values.get("Domain/boxes", "0, 0 : 1, 1"))
    if values.get("Domain/dimension") == "3":  # its section across z
        domain = [[corner[:2] for corner in box] for box in domain]
    if values.get("Domain/dimension") == "1":
        domain = [[(a[0], 0), (b[0], h)] for a, b in domain]
    boundary = values.get("Domain/boundary", "constrained")
    is_strip = "Crack/notch" in values
    layer = 0 if boundary in ("free", "periodic") else horizon
    up = 0 if values.get("Domain/dimension") == "1" else layer

    holes = boxes(values.get("Domain/holes", ""))
    cells = []
    if mesh.endswith(".geo"):
        cells = physical_cells(folder / mesh, h, horizon, 3 if values.get("Domain/dimension") == "3" else 2)
        corners = [point for _, cell in cells for point in cell]
    else:
        corners = [(p[0] + s * layer, p[1] + s * up) for box in domain for p, s in zip(box, (-1, 1))]
    lower = tuple(min(p[i] for p in corners) for i in (0, 1))
    upper = tuple(max(p[i] for p in corners) for i in (0, 1))
    drawing = Drawing(lower, upper)
    edge = 'stroke="#7a8ca0" stroke-width="0.6"'

    if cells:
        for name, cell in cells:
            colour = COLOURS["collar" if name.startswith("collar") else "omega"]
            drawing.polygon(cell, f'fill="{colour}" {edge}')
    else:
        if layer and not is_strip:
            for a, b in domain:
                drawing.box((a[0] - layer, a[1] - up), (b[0] + layer, b[1] + up), f'fill="{COLOURS["collar"]}"')
        if is_strip:
            for a, b in domain:
                drawing.box((a[0], a[1] - layer), (b[0], b[1] + layer), f'fill="{COLOURS["grips"]}"')
        for a, b in domain:
            drawing.box(a, b, f'fill="{COLOURS["omega"]}"')
        for a, b in holes:
            drawing.box(a, b, f'fill="{COLOURS["collar"] if layer else "#ffffff"}"')
    for a, b in (boxes(values["Domain/fixed"]) if values.get("Domain/fixed", "none") != "none" else []):
        drawing.box(a, b, f'fill="{COLOURS["grips"]}" fill-opacity="0.8"')

    a, b = domain[0] if not cells else (lower, upper)
    n = [round((b[i] - a[i]) / h) for i in (0, 1)]
    if not cells and 0 < n[0] * n[1] <= 2500:
        shift = 0 if values.get("Methods/nodes") == "vertices" else 0.5
        nodes = [(p[0] + (i + shift) * h, p[1] + (j + shift) * h) for p, q in domain
                 for i in range(round((q[0] - p[0]) / h)) for j in range(max(1, round((q[1] - p[1]) / h)))]
        nodes = [p for p in nodes if not any(a[0] < p[0] < b[0] and a[1] < p[1] < b[1] for a, b in holes)]
        drawing.dots(nodes, 'stroke="#34495e" stroke-width="1.6"')
    centre = [a[i] + (math.floor(n[i] / 2) + 0.5) * h if n[i] > 0 else (a[i] + b[i]) / 2 for i in (0, 1)]
    drawing.circle(centre, horizon, f'fill="{COLOURS["ball"]}" fill-opacity="0.18" stroke="{COLOURS["ball"]}"')
    cracks = boxes(values.get("Domain/cracks", ""))
    if is_strip:
        middle = (domain[0][0][1] + domain[0][1][1]) / 2
        cracks.append([(domain[0][0][0], middle), (domain[0][0][0] + number(values["Crack/notch"]), middle)])
    for crack in cracks:
        drawing.line(crack, f'stroke="{COLOURS["crack"]}" stroke-width="2.5"')
    return drawing.text()


def command_of(values):
    for section, command in (("Crack", "crack"), ("Fracture", "grow"), ("Strip", "strip"), ("Sampling", "sample")):
        if any(key.startswith(section + "/") for key in values):
            return command
    return "run"


def result_picture(entry, root, program, work, pictures):
    command, scene, options, pattern, caption = entry
    folder = work / "gallery" / scene.replace("/", "_")
    words = ["plumbline", command, f"scenes/{scene}.prm", *shlex.split(options)]
    run(words + ["--quiet", "-o", str(folder)], work, program)
    found = sorted(folder.glob("**/" + pattern))
    if not found:
        written = ", ".join(path.name for path in sorted(folder.glob("**/*.svg"))) or "none"
        raise CommandFailed(f"{shlex.join(words)} writes no picture {pattern}; its pictures: {written}")
    name = "result_" + scene.replace("/", "_") + ".svg"
    shutil.copy(found[0], pictures / name)
    shown = breakable(shlex.join(words))
    return (f'<figure class="result"><a href="_static/gallery/{name}"><img src="_static/gallery/{name}" '
            f'alt="{html.escape(caption)}" loading="lazy"></a>'
            f"<figcaption>{html.escape(caption)}<br><code>{shown}</code></figcaption></figure>")


def breakable(command):
    """Lines may break after a slash or an underscore."""
    return re.sub(r"([/_])", r"\1<wbr>", html.escape(command))


def card(path, root, pictures):
    scene = read_scene(path)
    values = scene["values"]
    name = f"{path.parent.name}_{path.stem}.svg"
    (pictures / name).write_text(sketch(values, path.parent), encoding="utf-8")
    purpose = values.get("Purpose", "") or " ".join(scene["comments"][:1])
    refused = any(comment.startswith("Refused:") for comment in scene["comments"])
    certified = [comment for comment in scene["comments"] if comment.startswith("Run: plumbline certify ")]
    command = breakable(certified[0][len("Run: "):] if certified else
                        f"plumbline {command_of(values)} scenes/{path.parent.name}/{path.name}")
    note = "<br><em>Refused, on purpose.</em>" if refused else ""
    title = path.stem.replace("_", "_<wbr>")
    return (f'<figure><img src="_static/gallery/{name}" alt="domain, nodes and one ball" loading="lazy">'
            f"<figcaption><strong>{title}</strong><br>{html.escape(purpose)}{note}<br><code>{command}</code>"
            "</figcaption></figure>")


TITLES = {
    "ipa_ac": "Rules on lattices (Yang & Yin)", "lps": "State-based solids, cracks and free surfaces (Fan et al. 2022)",
    "line": "One dimension", "meshes": "Meshes, scattered nodes and references", "state_based": "Variational state-based bars",
    "dynamics": "Transient analysis", "waves": "Dispersion", "griffith": "Dynamic fracture",
    "fracture": "Quasi-static fracture and stationary cracks", "random": "Random fields and uncertainty quantification",
    "glass_ceramics": "Toughness of microstructures", "three_d": "Three dimensions", "certified": "Certified benchmarks",
    "check": "Weights of another code",
    "failures": "Cases where a method must fail, or a scene must be refused"}


def page(root, program, work, pictures):
    pictures.mkdir(parents=True)
    folders = sorted({path.parent.name for path in (root / "scenes").glob("*/*.prm")})
    if set(folders) != set(TITLES):
        raise ValueError(f"TITLES and the folders of scenes differ in {sorted(set(folders) ^ set(TITLES))}")
    order = list(TITLES)
    with ThreadPoolExecutor(2) as pool:
        results = list(pool.map(lambda entry: result_picture(entry, root, program, work, pictures), RESULTS))
        cards = {name: list(pool.map(lambda path: card(path, root, pictures),
                                     sorted((root / "scenes" / name).glob("*.prm")))) for name in order}
    n_scenes = sum(len(some) for some in cards.values())
    parts = ["# Gallery", "",
             f"All {n_scenes} shipped scenes. The build of this site makes the pictures. Each scene states what it "
             "expects, and a test checks it.", "", "## Results", "",
             "The build runs these commands.", "", "```{raw} html", '<div class="gallery results">', *results, "</div>",
             "```", "", "## Scenes", "",
             "Each drawing shows the domain Ω (blue), the interaction domain (beige), grips (grey), cracks and notches "
             "(red), the nodes or the mesh of the coarsest level, and the ball of one horizon (orange)."]
    for name in order:
        parts += ["", f"### {TITLES[name]}", "", "```{raw} html", '<div class="gallery">', *cards[name],
                  "</div>", "```"]
    return re.sub(r"\n{3,}", "\n\n", "\n".join(parts)) + "\n"
