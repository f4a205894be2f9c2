"""Three dimensions: the same numbers as the command, from arrays."""
import itertools
import json
import os
import subprocess

import numpy as np
import pytest

import plumbline

from plumbline import space

n, m = 5, 2
h = 1 / n


def nodes_and_bonds(rule, kernel):
    """The unit cube's nodes and those around it, with the rule's bonds of those in it."""
    family = space.weights(rule, kernel, h)
    reach = int(abs(family.offsets).max())
    k = np.arange(-reach, n + reach)
    at = np.array(list(itertools.product(k, k, k)))
    index = {tuple(one): place for place, one in enumerate(at)}
    free = [place for place, one in enumerate(at) if one.min() >= 0 and one.max() < n]
    i = np.repeat(free, len(family.w))
    j = [index[tuple(at[one] + offset)] for one in free for offset in family.offsets]
    w = np.tile(family.w, len(free))
    points = np.tile(family.points, (len(free), 1))
    return (at + .5) * h, np.full(len(at), h**3), i, np.array(j), w, points


def check(of, kernel, change=lambda w: w, **options):
    nodes, volumes, i, j, w, points = nodes_and_bonds(of, kernel)
    return space.check(nodes, volumes, i, j, change(w), kernel, boxes=((0, 0, 0), (1, 1, 1)),
                       points=points, **options)


def test_right_weights_are_recognised_and_have_their_moduli():
    kernel = space.Kernel("bond-tensor", m * h, bulk_modulus=1)
    found = check("IPA-AC-R2", kernel)
    assert found["is_ac"] and found["rule"] == "IPA-AC-R2" and not found["causes"]
    assert found["elastic"]["C1111"] == pytest.approx([1.8] * 3)
    assert found["elastic"]["nu"] == pytest.approx([.25] * 3)
    assert not check("FA", kernel)["is_ac"]


def test_wrong_weights_are_named():
    kernel = space.Kernel("linear-decay", m * h, diffusion=.5)
    doubled = check("IPA-AC-R2", kernel, lambda w: 2 * w)
    assert [one["name"] for one in doubled["causes"]] == ["factor 2"] and not doubled.passed
    assert "twice too large" in str(doubled) and str(doubled).endswith("NOT as required")

    def one_off(w):
        w = w.copy()
        w[17] *= 1.5
        return w
    found = check("IPA-AC-R2", kernel, one_off)
    assert len(found["outliers"]) == 1 and found["outliers"][0]["index"] == 17
    assert "(index 17 of the bonds)" in found["complaints"][0] and "line" not in str(found)
    for name in "rule", "meant":
        assert "partial volumes of LAMMPS" in check("FA", kernel, **{name: ["LAMMPS"]})["causes"][0]["text"]


def test_a_kernel_in_the_weights_is_told_with_its_argument():
    kernel = space.Kernel("linear-decay", 3 * h, diffusion=.5)
    family = space.weights("FA", kernel, h)
    reach, k = 3, np.arange(-3, n + 3)
    at = np.array(list(itertools.product(k, k, k)))
    index = {tuple(one): place for place, one in enumerate(at)}
    free = [place for place, one in enumerate(at) if one.min() >= 0 and one.max() < n]
    offsets = family.offsets[np.sum(family.offsets**2, axis=1) < reach**2]
    j = [index[tuple(at[one] + offset)] for one in free for offset in offsets]
    given = dict(nodes=(at + .5) * h, volumes=np.full(len(at), h**3), i=np.repeat(free, len(offsets)), j=j,
                 w=np.tile(kernel(offsets * h) * h**3, len(free)), kernel=kernel, boxes=((0, 0, 0), (1, 1, 1)))
    found = space.check(**given)
    assert found["causes"][0]["name"] == "kernel in the weights"
    assert 'bonds_are="stiffness"' in found["causes"][0]["text"]
    assert space.check(**given, bonds_are="stiffness")["rule"] == "FA"
    with pytest.raises(ValueError, match="'free' is available in plumbline.check.*'constrained' or 'periodic'"):
        space.check(**given, boundary="free")


def test_old_and_new_names_of_boxes_are_not_given_at_once():
    with pytest.raises(TypeError, match="box"):
        check("FA", space.Kernel("linear-decay", m * h, diffusion=.5), box=((0, 0, 0), (1, 1, 1)))


def test_periodic_boxes():
    n, h = 8, 1 / 8
    kernel = space.Kernel("linear-decay", 2 * h, diffusion=.5)
    family = space.weights("IPA-AC-R2", kernel, h)
    at = np.array(list(itertools.product(range(n), repeat=3)))
    to = (at[:, None] + family.offsets) % n
    given = dict(i=np.repeat(np.arange(n**3), len(family.w)), j=(to @ [n * n, n, 1]).ravel(),
                 w=np.tile(family.w, n**3), points=np.tile(family.points, (n**3, 1)))
    box = dict(kernel=kernel, box=((0, 0, 0), (1, 1, 1)), boundary="periodic")
    found = space.check(at * h, np.full(n**3, h**3), **given, **box)
    assert found["is_ac"] and found["rule"] == "IPA-AC-R2" and not found["causes"]
    assert found["n_unpaired"] == 0 and found["imbalance"] < 1e-12
    assert "is_ac" in found and found.get("n_unpaired") == 0  # keys of former versions
    assert "wrong" not in found and found.get("wrong", 3) == 3
    with pytest.raises(plumbline.InputError, match="outside of the periodic box"):
        space.check(at * h - h, np.full(n**3, h**3), **given, **box)


def test_solutions_are_those_of_the_command(root, tmp_path):
    kernel = space.Kernel("linear-decay", 3 / 8, diffusion=.5)
    u = "x^3*y^2 + z^4 + x*y*z^2"
    problem = space.Problem(kernel, box=((0, 0, 0), (1, 1, 1)), h=1 / 8, solution=u)
    ended = subprocess.run([os.environ["PLUMBLINE_COMMAND"], "run", "--json", "--levels", "1",
                            "scenes/three_d/scalar_delta_convergence.prm", "-o", str(tmp_path / "o")],
                           cwd=root, capture_output=True, text=True)
    records = {one["key"]["method"]: one for one in json.loads(ended.stdout)["records"]}
    for method in ("FA", "IPA-AC-R2", "Q1"):
        solved = space.solve(problem, method)
        x, y, z = solved.nodes.T
        error = abs(solved.values - (x**3 * y**2 + z**4 + x * y * z**2)).max()
        assert error == pytest.approx(records[method]["scalars"]["nodal Linf | exact"]["value"],
                                      rel=1e-12)
        assert solved.averages.shape == (512,) and solved.cells.shape == (512, 3)


def test_functions_are_taken_as_expressions_are():
    kernel = space.Kernel("bond-tensor", .5, bulk_modulus=2)
    box = ((0, 0, 0), (1, 1, 1))
    by_text = space.Problem(kernel, box=box, h=.25, load="0, 0, -1", constraint="0, x*z, 0")
    by_function = space.Problem(kernel, box=box, h=.25, load=lambda x, y, z: (0, 0, -1),
                                constraint=lambda x, y, z: (0 * x, x * z, 0 * x))
    one, other = (space.solve(problem, "IPA-AC-R2") for problem in (by_text, by_function))
    assert one.values.shape == (64, 3)
    np.testing.assert_allclose(one.values, other.values, rtol=0, atol=1e-14)


def test_domain_is_union_of_boxes_minus_holes():
    kernel = space.Kernel("linear-decay", 2 / 8, diffusion=.5)
    boxes = [((0, 0, 0), (1, .5, .5)), ((0, 0, 0), (.5, 1, .5))]
    u = "x^2 - y*z"
    by_union = space.Problem(kernel, box=boxes, h=1 / 8, solution=u)
    by_hole = space.Problem(kernel, box=((0, 0, 0), (1, 1, .5)), exclude=((.5, .5, 0), (1, 1, .5)),
                            h=1 / 8, solution=u)
    for problem in (by_union, by_hole):
        solved = space.solve(problem, "Q1")
        assert solved.cells.shape == (192, 3) and solved.averages.shape == (192,)
        assert not ((solved.cells[:, 0] > .5) & (solved.cells[:, 1] > .5)).any()
        x, y, z = solved.nodes.T
        np.testing.assert_allclose(solved.values, x**2 - y * z, rtol=0, atol=1e-12)


def test_state_based_solids_have_their_constants():
    u = "x^2 + y*z, 2*x*z - y^2, z^2 + x*y"
    influence = space.Kernel("1/r", 3 / 8, diffusion=1)  # profile and horizon count
    def error(lame, load):
        problem = space.Problem(influence, box=((0, 0, 0), (1, 1, 1)), h=1 / 8, constraint=u,
                                load=load, lame=lame)
        solved = space.solve(problem, "IPA-AC-R2")
        x, y, z = solved.nodes.T
        exact = np.stack([x**2 + y * z, 2 * x * z - y**2, z**2 + x * y], axis=1)
        return abs(solved.values - exact).max()
    # laplacian (2, -2, 2), div u = 2 x - 2 y + 2 z
    for lam, mu in ((3, 1), (1, 1), (-.5, 1)):
        load = ", ".join(str(-s * (2 * mu + 2 * (lam + mu))) for s in (1, -1, 1))
        assert error((lam, mu), load) < 1e-10
    assert error((3, 1), "-4, 4, -4") > 1e-3


def test_kernels_have_their_moments():
    kernel = space.Kernel("linear-decay", .3, diffusion=.5)
    assert kernel.moment((2, 0, 0)) == pytest.approx(1)
    assert kernel.moment((2, 2, 0)) == pytest.approx(3 * .09 / 28)
    assert kernel.limit == pytest.approx({"diffusion": .5})
    assert kernel(np.array([[.1, .1, .1], [.3, .3, 0]]))[1] == 0


@pytest.mark.parametrize("call, words", [
    (lambda k: space.Problem(k, box=((0, 0), (1, 1)), h=.5, solution="x"), "shape"),
    (lambda k: space.Problem(k, box=((0, 0, 0), (1, 1, 1)), h=.3, solution="x"), "whole cells"),
    (lambda k: space.Problem(k, box=((0, 0, 0), (1, 1, 1)), exclude=((2, 0, 0), (3, 1, 1)), h=.5,
                             solution="x"), "outside"),
    (lambda k: space.Problem(k, box=((0, 0, 0), (1, 1, 1)), h=.5), "neither a load nor a solution"),
    (lambda k: space.Problem(k, box=((0, 0, 0), (1, 1, 1)), h=.5, solution="x, y"), "components"),
    (lambda k: space.Problem(k, box=((0, 0, 0), (1, 1, 1)), h=.5, solution="x, y, z", lame=(1, -1)),
     "mu > 0"),
    (lambda k: space.Problem(k, box=((0, 0, 0), (1, 1, 1)), h=.5, solution="x, y, z", lame=3),
     "two numbers"),
    (lambda k: space.weights("FB", k, .5), "FB"),
    (lambda k: space.weights("FA", k, 0), "above 0"),
    (lambda k: space.solve(space.Problem(k, box=((0, 0, 0), (1, 1, 1)), h=.25, solution="x"), "Q3"),
     "for two dimensions only"),
    (lambda k: space.check(np.zeros((4, 2)), np.ones(4), [0], [1], [1.], k,
                           box=((0, 0, 0), (1, 1, 1))), "shape"),
])
def test_bad_input_is_refused(call, words):
    with pytest.raises(ValueError, match=words):
        call(space.Kernel("linear-decay", .5))


def moved_nodes():
    """Centres of the unit cube's cubes and of those around it, moved by up to .3 h."""
    k = np.arange(-3, n + 3)
    at = np.array(list(itertools.product(k, k, k))) + .5
    return (at + np.random.default_rng(1).uniform(-.3, .3, at.shape)) * h


def test_weights_of_scattered_nodes_have_their_moments_and_pass_the_check():
    kernel = space.Kernel("linear-decay", m * h, diffusion=.5)
    nodes, box = moved_nodes(), ((0, 0, 0), (1, 1, 1))
    made = space.weights("IPA-AC-R2", kernel, h, nodes=nodes, box=box)
    assert len(np.unique(made.i)) == n**3
    assert made.xi == pytest.approx(nodes[made.j] - nodes[made.i])
    for a in range(3):
        moments = np.bincount(made.i, kernel(made.points) * made.w * made.xi[:, a]**2)
        assert moments[np.unique(made.i)] == pytest.approx(1)  # twice the diffusion
    found = space.check(nodes, np.full(len(nodes), h**3), made.i, made.j, made.w, kernel, box=box,
                        points=made.points)
    assert found["is_ac"]
    with pytest.raises(ValueError, match="volumes.0. = -3"):
        space.weights("FA", kernel, h, nodes=nodes, box=box, volumes=np.arange(len(nodes)) - 3.)
    plain = space.weights("FA", kernel, h, nodes=nodes, box=box, volumes=np.full(len(nodes), h**3))
    assert plain.w == pytest.approx(np.full(len(plain.w), h**3))


def test_problems_on_scattered_nodes_are_solved_exactly_where_moments_are_exact():
    kernel = space.Kernel("bond-tensor", 3 * h, bulk_modulus=1)
    k = np.arange(-4, n + 4)
    at = np.array(list(itertools.product(k, k, k))) + .5
    nodes = (at + np.random.default_rng(1).uniform(-.3, .3, at.shape)) * h
    problem = space.Problem(kernel, box=((0, 0, 0), (1, 1, 1)), h=h, nodes=nodes,
                            solution="x^2 - y*z, x*y + z, z^2 - x")
    solved = space.solve(problem, "IPA-AC-R2")
    x, y, z = solved.nodes.T
    assert solved.values == pytest.approx(np.column_stack([x**2 - y*z, x*y + z, z**2 - x]))
    assert space.solve(problem, "FA").values != pytest.approx(solved.values, rel=1e-3)
    with pytest.raises(ValueError, match="nodes end at x"):
        space.Problem(kernel, box=((0, 0, 0), (1, 1, 1)), h=h, nodes=nodes[nodes[:, 0] > -.1],
                      solution="x, y, z")


def test_solutions_have_values_and_gradients_at_points():
    kernel = space.Kernel("linear-decay", 3 / 8, diffusion=.5)
    problem = space.Problem(kernel, box=((0, 0, 0), (1, 1, 1)), h=1 / 8,
                            solution="x + 2*y - z + x*y*z")
    points = np.array([[.31, .72, .2], [.5, .5, .5], [1, 1, 0]])
    x, y, z = points.T
    solved = space.solve(problem, "Q1")
    assert solved(points) == pytest.approx(x + 2 * y - z + x * y * z, abs=1e-10)
    assert solved.gradient(points) == pytest.approx(
        np.stack([1 + y * z, 2 + x * z, x * y - 1], axis=1), abs=1e-9)
    rule = space.solve(problem, "FA")
    assert rule(rule.nodes) == pytest.approx(rule.values)
    with pytest.raises(ValueError, match="has no gradient"):
        rule.gradient(points)
    with pytest.raises(ValueError, match="points.0. = .*outside"):
        solved([[2, 0, 0]])
    tensor = space.Problem(space.Kernel("bond-tensor", 3 / 8, bulk_modulus=1), h=1 / 8,
                           box=((0, 0, 0), (1, 1, 1)), solution="x - z, 2*y, x + 3*z")
    assert space.solve(tensor, "Q1").gradient(points) == pytest.approx(
        np.tile([[1, 0, -1], [0, 2, 0], [1, 0, 3]], (3, 1, 1)), abs=1e-9)


BALL = """
SetFactory("OpenCASCADE");
DefineConstant[ h = 0.5, delta = 0.5 ];
Sphere(1) = {0, 0, 0, 1};
Sphere(2) = {0, 0, 0, 1 + delta + h / 4};
BooleanFragments{ Volume{2}; Delete; }{ Volume{1}; Delete; }
Physical Volume("omega") = {1};
Physical Volume("collar") = {2};
Mesh.MeshSizeMin = h;
Mesh.MeshSizeMax = h;
Mesh.OptimizeThreshold = 0.7;
"""


def test_problems_on_tetrahedra_of_gmsh_are_exact_for_linear_fields(tmp_path):
    file = tmp_path / "ball.geo"
    file.write_text(BALL)
    kernel = space.Kernel("constant", .6, diffusion=.5)
    problem = space.Problem(kernel, mesh=str(file), h=.6, solution="x + 2*y - z")
    for method in ("P1", "IPA-AC-R2"):
        solved = space.solve(problem, method)
        assert solved.values == pytest.approx(solved.nodes @ [1, 2, -1], abs=1e-9)
    points = np.array([[.1, .2, -.3], [0, -.5, .5]])
    p1 = space.solve(problem, "P1")
    assert p1(points) == pytest.approx(points @ [1, 2, -1])
    assert p1.gradient(points) == pytest.approx(np.array([[1, 2, -1]] * 2))
    assert space.matrix(problem, "P1").nodes.shape[1] == 3
    with pytest.raises(ValueError, match="points.0. = .*outside"):
        p1([[0, 0, 1.1]])
    with pytest.raises(ValueError, match="is for lattices of cubes"):
        space.solve(problem, "Q1")
    with pytest.raises(ValueError, match="either by box .* or by mesh"):
        space.Problem(kernel, mesh=str(file), box=((0, 0, 0), (1, 1, 1)), h=.5, solution="x")
    (tmp_path / "thin.geo").write_text(BALL.replace("1 + delta + h / 4", "1 + delta / 2"))
    with pytest.raises(ValueError, match="thin.geo': the interaction domain is"):
        space.Problem(kernel, mesh=str(tmp_path / "thin.geo"), h=.6, solution="x")
