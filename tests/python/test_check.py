"""The check of weights from arrays names what is wrong with them."""
import csv
import json
import os
import subprocess

import numpy as np
import pytest
from conftest import lattice

import plumbline

H = 1 / 16
KERNEL = plumbline.Kernel("linear-decay", horizon=3 * H, diffusion=.5)
NODES = lattice(16, 3)
VOLUMES = np.full(len(NODES), H * H)


def made(square, rule="IPA-AC-R2"):
    return plumbline.weights(rule, KERNEL, nodes=NODES, boxes=square)


def check(w, square, **given):
    points = None if np.array_equal(w.points, w.xi) else w.points
    return plumbline.check(NODES, given.pop("volumes", VOLUMES), w.i, w.j, w.w, KERNEL,
                           boxes=square, points=points, **given)


def test_right_weights_pass(square):
    found = check(made(square), square)
    assert found.passed and found["complaints"] == [] and found["rule"] == "IPA-AC-R2"
    assert found["n_free"] == 256 and found["weights"]["n_bonds"] == len(made(square).w)
    assert found["moments"]["exact_degree"] >= 2
    assert np.max(found["moments"]["degrees"][1]["defects"]) < 1e-12
    assert np.array_equal(np.sort(found["moments"]["nodes"]), np.unique(made(square).i))


def test_stiffnesses_are_made_into_weights(square):
    w = made(square)
    w.w[:] = w.w * KERNEL(w.points)
    found = check(w, square, bonds_are="stiffness")
    assert found.passed and found["rule"] == "IPA-AC-R2"
    assert not check(w, square).passed
    w.w[:] *= H * H
    assert check(w, square, bonds_are="force constants").passed
    with pytest.raises(plumbline.InputError, match="bonds_are = 'springs' is not known"):
        check(w, square, bonds_are="springs")


def test_a_doubled_weight_is_named(square):
    w = made(square)
    wrong = int(np.flatnonzero(w.i == NODES.shape[0] // 2 + 3)[5])
    w.w[wrong] *= 2
    found = check(w, square)
    assert not found.passed
    assert [one["index"] for one in found["outliers"]] == [wrong]
    outlier = found["outliers"][0]
    assert (outlier["node"], outlier["neighbour"]) == (w.i[wrong], w.j[wrong])
    assert outlier["found"] == pytest.approx(2 * outlier["expected"])
    place = f"(index {wrong} of the bonds)"
    assert place in outlier["text"] and place in str(found)


def test_a_missing_bond_is_named(square):
    w = made(square)
    keep = np.arange(len(w.w)) != 1000
    found = plumbline.check(NODES, VOLUMES, w.i[keep], w.j[keep], w.w[keep], KERNEL, boxes=square,
                            points=w.points[keep])
    assert "missing" in found["outliers"][0]["text"]
    assert (found["outliers"][0]["node"], found["outliers"][0]["neighbour"]) == (w.i[1000],
                                                                                 w.j[1000])


def test_a_common_factor_is_a_cause(square):
    w = made(square)
    w.w[:] *= 1.1
    found = check(w, square)
    assert not found.passed and found["causes"][0]["factor"] == pytest.approx(1.1, rel=1e-3)


def test_a_wrong_volume_is_named(square):
    volumes = VOLUMES.copy()
    volumes[250] *= 3
    found = check(made(square), square, volumes=volumes)
    assert "volume of node 250" in found["outliers"][0]["text"]


def test_what_is_required_decides(square):
    w = made(square, "FA")
    assert check(w, square)["passed"] is False
    loose = check(w, square, require="moments=0.9")
    assert not any(one.startswith("required") for one in loose["complaints"])
    assert check(w, square)["rule"] == "FA"


@pytest.mark.parametrize("change, words", [
    (lambda a: a.update(i=a["i"] + 10**6), "no node of 'nodes'"),
    (lambda a: a["j"].__setitem__(7, a["i"][7]), "'bonds', index 7: a bond of node"),
    (lambda a: a["w"].__setitem__(3, np.inf), "w[3] = inf"),
    (lambda a: a.update(w=a["w"][:-1]), "i has the shape"),
    (lambda a: a["volumes"].__setitem__(2, -1), "volumes[2] = -1"),
    (lambda a: a["nodes"].__setitem__((4, 0), 9), "node 4 at (9,"),
    (lambda a: a.update(require=["perfect"]), "'perfect' is not known"),
    (lambda a: a.update(points=np.zeros((len(a["w"]), 2))), "points[0] is 0"),
])
def test_wrong_arrays_are_told(square, change, words):
    w = made(square)
    given = {"nodes": NODES.copy(), "volumes": VOLUMES.copy(), "i": w.i, "j": w.j, "w": w.w}
    change(given)
    with pytest.raises(ValueError) as caught:
        plumbline.check(kernel=KERNEL, boxes=square, **given)
    assert words in str(caught.value)


def test_the_command_finds_the_same_of_the_shipped_bonds(root, square):
    def columns(file, *names):
        with open(root / "scenes/check" / file) as opened:
            rows = list(csv.DictReader(opened))
        return [np.array([float(row[name] or "nan") for row in rows]) for name in names]
    ids, x, y, volumes = columns("nodes.csv", "id", "x", "y", "volume")
    i, j, w, qx, qy = columns("bonds_wrong.csv", "i", "j", "weight", "qx", "qy")
    i, j = (i - 1).astype(int), (j - 1).astype(int)
    nodes, points = np.stack([x, y], axis=1), np.stack([qx, qy], axis=1)
    points = np.where(np.isnan(points), nodes[j] - nodes[i], points)  # empty: at the neighbour
    found = plumbline.check(nodes, volumes, i, j, w,
                            plumbline.Kernel("linear-decay", .375, diffusion=.5), boxes=square,
                            points=points, h=.125)
    text = subprocess.run(
        [os.environ["PLUMBLINE_COMMAND"], "check", "scenes/check/nodes.csv",
         "scenes/check/bonds_wrong.csv", "--scene", "scenes/check/check.prm", "--json"],
        cwd=root, capture_output=True, text=True).stdout
    said = json.loads(text)
    assert np.array_equal(ids, np.arange(1, len(ids) + 1))
    for ours, theirs in zip(found["moments"]["degrees"], said["moments"]):
        # files are read relative to the scene's origin, which moves the last bits
        assert ours["worst"]["value"] == pytest.approx(theirs["worst"]["value"], rel=1e-9, abs=1e-14)
        assert ours["median"] == pytest.approx(theirs["median"], rel=1e-9, abs=1e-14)
    assert [(one["node"] + 1, one["neighbour"] + 1) for one in found["outliers"]] == \
        [(one["node"], one["neighbour"]) for one in said["outliers"]] == [(77, 79)]
    assert found["rule"] == said["rule"]["name"]


def body(square):
    """Nodes of the square alone, and the weights of a rule without bonds to other nodes."""
    w = made(square)
    inside = np.all((NODES > 0) & (NODES < 1), axis=1)
    index = np.cumsum(inside) - 1
    keep = inside[w.j]
    return NODES[inside], index[w.i[keep]], index[w.j[keep]], w.w[keep], w.points[keep]


def test_a_body_with_free_surfaces_and_a_crack(square):
    nodes, i, j, w, points = body(square)
    volumes = np.full(len(nodes), H * H)
    given = dict(boxes=square, boundary="free")
    found = plumbline.check(nodes, volumes, i, j, w, KERNEL, points=points, **given)
    assert found.passed, found
    assert found["n_free"] == 256 and found["body"]["n_families"] == 256
    cuts = {one["cut"]: one for one in found["body"]["families"]}
    assert cuts["none"]["n"] == 100 and cuts["surface"]["n"] == 156
    assert found["body"]["correction"]["name"] == "none"
    assert check(made(square), square)["body"] is None

    crack = [[(.3, .5), (.7, .5)]]
    found = plumbline.check(nodes, volumes, i, j, w, KERNEL, points=points, cracks=crack, **given)
    low, high = nodes[i][:, 1] - .5, nodes[j][:, 1] - .5
    at = nodes[i][:, 0] + (nodes[j] - nodes[i])[:, 0] * low / np.where(low == high, 1, low - high)
    crosses = (low * high < 0) & (at > .3) & (at < .7)
    pairs = {tuple(sorted(pair)) for pair in zip(i[crosses], j[crosses])}
    assert not found.passed and {tuple(one) for one in found["body"]["crossing"]} == pairs
    assert f"{len(pairs)} pairs of nodes have bonds across a crack" in found["complaints"][0]
    keep = ~crosses
    found = plumbline.check(nodes, volumes, i[keep], j[keep], w[keep], KERNEL, points=points[keep],
                            cracks=crack, **given)
    assert found.passed and found["body"]["crossing"] == [], found

    volume = np.bincount(i, w)
    bulk = volume[136]  # a node in the middle
    scaled = w * 2 * bulk / (volume[i] + volume[j])
    found = plumbline.check(nodes, volumes, i, j, scaled, KERNEL, points=points, **given)
    assert found.passed and found["body"]["correction"]["name"] == "volume"
    assert "volume correction" in str(found)
    with pytest.raises(plumbline.InputError, match="boundary = 'open' is not known"):
        plumbline.check(nodes, volumes, i, j, w, KERNEL, boxes=square, boundary="open")
    with pytest.raises(plumbline.InputError, match="cracks: crack 0 has its points 0 and 1"):
        plumbline.check(nodes, volumes, i, j, w, KERNEL, cracks=[[(.3, .5), (.3, .5)]], **given)


def test_another_horizon_is_asked_about_before_causes():
    nodes = lattice(10, 3)
    r = np.linalg.norm(nodes[:, None] - nodes, axis=2)
    i, j = np.nonzero((r > 0) & (r < .3015) & np.all((nodes > 0) & (nodes < 1), axis=1)[:, None])
    found = plumbline.check(nodes, np.full(len(nodes), .01), i, j, np.full(len(i), .01),
                            plumbline.Kernel("linear-decay", .5), boxes=((0, 0), (1, 1)))
    question = found["complaints"][0]
    assert question.startswith("do h and horizon belong to these bonds? the longest bond is 0.3, but the horizon is 0.5")
    assert "Study" not in question
    assert not any(one.startswith("cause: ") for one in found["complaints"])


def test_scattered_nodes_in_a_periodic_box(square):
    # weights in a larger box, of nodes and their images: no cell is cut at the sides of the square
    rng = np.random.default_rng(3)
    grid = np.stack(np.meshgrid(np.arange(16) + .5, np.arange(16) + .5), -1).reshape(-1, 2)
    nodes = (grid + rng.uniform(-.2, .2, grid.shape)) * H
    shifts = np.array([(0, 0)] + [(a, b) for a in (-1, 0, 1) for b in (-1, 0, 1) if a or b])
    everywhere = (nodes + shifts[:, None]).reshape(-1, 2)
    original = np.tile(np.arange(256), 9)
    near = np.all(np.abs(everywhere - .5) < .5 + 7 * H, axis=1)
    everywhere, original = everywhere[near], original[near]
    w = plumbline.weights("IPA-AC-R2", KERNEL, nodes=everywhere, h=H,
                          boxes=((-4 * H, -4 * H), (1 + 4 * H, 1 + 4 * H)))
    rows = w.i < 256  # nodes come before their images
    i, j, weights, points = w.i[rows], original[w.j[rows]], w.w[rows], w.points[rows]
    crossing = j != w.j[rows]
    assert np.count_nonzero(crossing) > 500

    def found(keep=slice(None), **given):
        return plumbline.check(nodes, np.full(256, H * H), i[keep], j[keep], weights[keep], KERNEL,
                               **(dict(boxes=square, points=points[keep], boundary="periodic", h=H)
                                  | given))
    right = found()
    pairs = set(zip(i.tolist(), j.tolist()))  # a ball may cut a cell whose ball does not cut its own
    assert right["n_free"] == 256
    assert right["symmetry"]["n_unpaired"] == sum((b, a) not in pairs for a, b in pairs) > 0
    assert right["moments"]["degrees"][1]["worst"]["value"] < 1e-10
    assert "the periodic box in x and y" in found(~crossing)["complaints"][0]
    with pytest.raises(plumbline.InputError, match="boundary = 'torus' is not known"):
        found(boundary="torus")


def test_nodes_on_the_sides_of_a_periodic_box(square):
    n = 46  # images at a horizon from the box stand outside of its collar by rounding
    h = 1 / n
    at = np.stack(np.meshgrid(np.arange(n), np.arange(n), indexing="ij"), -1).reshape(-1, 2)
    offsets = np.array([(a, b) for a in range(-3, 4) for b in range(-3, 4) if 0 < a*a + b*b <= 9])
    j = ((at[:, None] + offsets) % n) @ [n, 1]
    i = np.repeat(np.arange(n * n), len(offsets))
    found = plumbline.check(at * h, np.full(n * n, h * h), i, j.ravel(), np.full(len(i), h * h),
                            plumbline.Kernel("linear-decay", horizon=3 * h, diffusion=.5),
                            boxes=square, h=h, boundary="periodic", require="moments=0.1")
    assert found.passed and found["rule"] == "FA"


@pytest.mark.parametrize("thickness", [.1, 1 / H**2])
def test_volumes_of_a_plate_are_told_before_all_else(square, thickness):
    found = check(made(square), square, volumes=VOLUMES * thickness)
    assert not found.passed and "volumes" in found["causes"][0]["text"]
    assert found["volume_factor"] == pytest.approx(thickness)
