"""The matrices of methods: the equations that solve() solves, and their files."""
import itertools

import numpy as np
import pytest
from conftest import lattice

import plumbline
from plumbline import space

H = 1 / 8
SQUARE = ((0, 0), (1, 1))
CUBE = ((0, 0, 0), (1, 1, 1))


def problem_of(kind):
    scalar = plumbline.Kernel("linear-decay", 3 * H, diffusion=.5)
    tensor = plumbline.Kernel("bond-tensor", 3 * H, bulk_modulus=2)
    if kind == "scalar":
        return plumbline.Problem(scalar, boxes=SQUARE, h=H, solution="sin(3*x)*cos(2*y) + 2")
    if kind == "tensor":
        return plumbline.Problem(tensor, boxes=SQUARE, exclude=((.5, .5), (1, 1)), h=H,
                                 load="x, 1 - y", constraint="x*y, cos(x)")
    if kind == "squares":
        return plumbline.Problem(tensor, boxes=SQUARE, h=H, cells="squares", load="x, 1 - y",
                                 constraint="x*y, cos(x)", coefficient="1 + x^2")
    if kind == "triangles":
        return plumbline.Problem(scalar, boxes=SQUARE, h=H, cells="triangles",
                                 solution="sin(3*x)*cos(2*y)")
    nodes = lattice(8, 3)
    nodes = nodes + np.random.default_rng(0).uniform(-.3 * H, .3 * H, nodes.shape)
    return plumbline.Problem(scalar, boxes=SQUARE, h=H, nodes=nodes, solution="exp(x)*y")


def residual(made, solved):
    """Of solve()'s solution, relative to the largest product in a row."""
    u = made.with_constraint(solved.values)
    products = np.abs(made.data).max() * np.abs(u).max()
    return np.abs(made @ u - made.load).max() / products


@pytest.mark.parametrize("kind, methods", [
    ("scalar", ("FA", "LAMMPS", "QWJ", "PA-AC", "IPA-AC", "IPA-AC-R2", "Q1", "Q2", "Q3", "DGQ0", "DGQ1")),
    ("tensor", ("FA", "IPA-AC-R2", "Q1", "Q2", "DGQ1")),
    ("squares", ("FA", "IPA-AC-R2")),
    ("triangles", ("FA", "P1", "P2", "DGP0", "DGP1")),
    ("nodes", ("FA", "LAMMPS", "PA-AC", "IPA-AC-R2")),
])
def test_solutions_fulfil_the_equations(kind, methods):
    problem = problem_of(kind)
    for method in methods:
        made, solved = plumbline.matrix(problem, method), plumbline.solve(problem, method)
        np.testing.assert_array_equal(made.nodes[made.is_unknown], solved.nodes)
        assert residual(made, solved) < 1e-10, method
        assert made.shape == (made.n_components * len(solved.nodes),
                              made.n_components * len(made.nodes))
        assert made.is_exact and made.data.flags.owndata is False
        # a constant is no force: rows sum to zero
        for c in range(made.n_components):
            ones = np.tile(np.arange(made.n_components) == c, len(made.nodes))
            assert np.abs(made @ ones).max() < 1e-10 * np.abs(made.data).max(), method
        assert (made.volumes is None) == (method[0] in "DQP" and method[:2] not in ("QW", "PA"))
        assert all(np.all(np.diff(made.indices[a:b]) > 0)
                   for a, b in zip(made.indptr, made.indptr[1:]))


def dense(made):
    result = np.zeros(made.shape)
    result[np.repeat(np.arange(made.shape[0]), np.diff(made.indptr)), made.indices] = made.data
    return result


@pytest.mark.parametrize("kind, method", [("scalar", "FA"), ("tensor", "FA"), ("nodes", "FA"),
                                          ("scalar", "IPA-AC-R2"), ("scalar", "Q2"),
                                          ("triangles", "P2")])
def test_symmetric_operators_are_symmetric(kind, method):
    made = plumbline.matrix(problem_of(kind), method).reduced()
    square = dense(made)
    if made.volumes is not None and kind != "nodes":
        assert made.volumes == pytest.approx(H**2)
    if kind == "nodes":
        assert np.abs(square - square.T).max() > 1e-3  # only forces are symmetric
        square = square * np.repeat(made.volumes, made.n_components)[:, None]
    assert np.abs(square - square.T).max() < 1e-12 * np.abs(square).max()
    assert np.linalg.eigvalsh(square)[0] > 0


def test_the_reduced_system_has_the_solution():
    for kind, method in (("scalar", "IPA-AC-R2"), ("tensor", "Q2"), ("nodes", "PA-AC")):
        problem = problem_of(kind)
        made = plumbline.matrix(problem, method).reduced()
        assert made.shape[0] == made.shape[1] == len(made.nodes) * made.n_components
        u = np.linalg.solve(dense(made), made.load)
        values = plumbline.solve(problem, method).values
        assert u.reshape(values.shape) == pytest.approx(values, rel=1e-9, abs=1e-9)


def test_entries_are_those_of_the_weights():
    problem = problem_of("nodes")
    kernel = plumbline.Kernel("linear-decay", 3 * H, diffusion=.5)
    made = plumbline.matrix(problem, "IPA-AC-R2")
    given = lattice(8, 3)
    given = given + np.random.default_rng(0).uniform(-.3 * H, .3 * H, given.shape)
    w = plumbline.weights("IPA-AC-R2", kernel, nodes=given, boxes=SQUARE)
    place = {tuple(x): k for k, x in enumerate(made.nodes)}
    number = np.array([place.get(tuple(x), -1) for x in given])
    expected = np.zeros(made.shape)
    stiffness = kernel(w.points).ravel() * w.w
    np.add.at(expected, (number[w.i], number[w.j]), -stiffness)
    np.add.at(expected, (number[w.i], number[w.i]), stiffness)
    assert dense(made) == pytest.approx(expected, abs=1e-10 * np.abs(expected).max())


def test_other_h():
    problem, kernel = problem_of("scalar"), plumbline.Kernel("linear-decay", 3 * H, diffusion=.5)
    finer = plumbline.Problem(kernel, boxes=SQUARE, h=H / 2, solution="sin(3*x)*cos(2*y) + 2")
    made, expected = plumbline.matrix(problem, "PA-AC", H / 2), plumbline.matrix(finer, "PA-AC")
    np.testing.assert_array_equal(made.data, expected.data)
    np.testing.assert_array_equal(made.indices, expected.indices)
    np.testing.assert_array_equal(made.load, expected.load)


def problem_in_space(kind):
    scalar = space.Kernel("linear-decay", .5, diffusion=.5)
    tensor = space.Kernel("bond-tensor", .5, bulk_modulus=2)
    if kind == "scalar":
        return space.Problem(scalar, box=CUBE, h=.25, solution="sin(3*x)*cos(2*y) + z^2")
    if kind == "tensor":
        return space.Problem(tensor, box=CUBE, exclude=((.5, .5, .5), (1, 1, 1)), h=.25,
                             load="x, y, z - 1", constraint="x*y, cos(x), z")
    if kind == "solid":
        return space.Problem(scalar, box=CUBE, h=.25, load="x, y, z - 1",
                             constraint="x*y, cos(x), z", lame=(3, 1))
    k = np.arange(-4, 8)
    at = np.array(list(itertools.product(k, k, k))) + .5
    nodes = (at + np.random.default_rng(1).uniform(-.2, .2, at.shape)) / 4
    return space.Problem(scalar, box=CUBE, h=.25, nodes=nodes, solution="x^2 - y*z")


@pytest.mark.parametrize("kind, methods", [
    ("scalar", ("FA", "LAMMPS", "PA-AC", "IPA-AC-R2", "Q1", "Q2", "DGQ0", "DGQ1")), ("tensor", ("FA", "IPA-AC-R2", "Q1", "Q2", "DGQ0")),
    ("solid", ("FA", "IPA-AC-R2", "Q1")), ("nodes", ("FA", "IPA-AC-R2"))])
def test_solutions_in_space_fulfil_the_equations(kind, methods):
    problem = problem_in_space(kind)
    for method in methods:
        made, solved = space.matrix(problem, method), space.solve(problem, method)
        np.testing.assert_array_equal(made.nodes[made.is_unknown], solved.nodes)
        assert made.nodes.shape[1] == 3 and residual(made, solved) < 1e-10, method
        for c in range(made.n_components):
            ones = np.tile(np.arange(made.n_components) == c, len(made.nodes))
            assert np.abs(made @ ones).max() < 1e-10 * np.abs(made.data).max(), method
        if kind != "nodes":
            assert made.volumes is None or made.volumes == pytest.approx(.25**3)
            square = dense(made.reduced())
            assert np.abs(square - square.T).max() < 1e-12 * np.abs(square).max()


def read_matrix_market(path):
    lines = path.read_text().split("\n")
    assert lines[0].startswith("%%MatrixMarket matrix ")
    size, body = [int(one) for one in lines[1].split()], lines[2:-1]
    if "array" in lines[0]:
        return np.array(body, float).reshape(size[::-1]).T
    result = np.zeros(size[:2])
    for line in body:
        i, j, value = line.split()
        result[int(i) - 1, int(j) - 1] = float(value)
    assert len(body) == size[2]
    return result


@pytest.mark.parametrize("kind, method", [("tensor", "IPA-AC-R2"), ("triangles", "P2")])
def test_files_return_the_numbers(kind, method, tmp_path):
    made = plumbline.matrix(problem_of(kind), method)
    made.save(tmp_path / "a.npz")
    again = plumbline.load_matrix(tmp_path / "a.npz")
    for name in ("data", "indices", "indptr", "load", "nodes", "constraint", "volumes"):
        np.testing.assert_array_equal(getattr(again, name), getattr(made, name))
    assert (again.method, again.n_components, again.n_unknown_nodes, again.is_exact) == (
        made.method, made.n_components, made.n_unknown_nodes, made.is_exact)
    assert repr(again) == repr(made)
    made.save(tmp_path / "a.mtx")
    np.testing.assert_array_equal(read_matrix_market(tmp_path / "a.mtx"), dense(made))
    np.testing.assert_array_equal(read_matrix_market(tmp_path / "a_nodes.mtx"), made.nodes)
    for name in ("load", "constraint"):
        np.testing.assert_array_equal(read_matrix_market(tmp_path / f"a_{name}.mtx")[:, 0],
                                      getattr(made, name))


def test_scipy_takes_the_arrays(tmp_path):
    io = pytest.importorskip("scipy.io")
    made = plumbline.matrix(problem_of("scalar"), "Q2")
    np.testing.assert_array_equal(made.to_scipy().toarray(), dense(made))
    made.save(tmp_path / "a.mtx")
    np.testing.assert_array_equal(io.mmread(tmp_path / "a.mtx").toarray(), dense(made))


def rule_of_python():
    return plumbline.Rule("plain", lambda xi, area: area)


def test_rules_of_python_have_matrices():
    problem = problem_of("scalar")
    made = plumbline.matrix(problem, rule_of_python())
    assert dense(made) == pytest.approx(dense(plumbline.matrix(problem, "FA")))


def test_solids_of_scenes_have_matrices(root):
    for scene, methods in (("scenes/lps/homogeneous.prm", ("FA", "IPA-AC-R2", "Q1")),
                           ("scenes/lps/smooth.prm", ("IPA-AC-R2",))):
        problem = plumbline.Problem.of_scene(str(root / scene))
        for method in methods:
            made, solved = plumbline.matrix(problem, method), plumbline.solve(problem, method)
            assert residual(made, solved) < 1e-10


def test_entries_by_quadrature_are_marked():
    problem = problem_of("squares")
    made, solved = plumbline.matrix(problem, "Q1"), plumbline.solve(problem, "Q1")
    assert not made.is_exact
    assert residual(made, solved) < 1e-10  # refined as solve() refines the quadrature


@pytest.mark.parametrize("scene, set, words", [
    ("scenes/state_based/bar.prm", {}, "free boundary are solved matrix-free"),
    ("scenes/lps/smooth.prm", {"Solver/dilatation": "mixed"}, "write condensed"),
    ("scenes/dynamics/double_well.prm", {}, "periodic"),
])
def test_problems_without_a_matrix_are_refused(root, scene, set, words):
    problem = plumbline.Problem.of_scene(str(root / scene), set)
    with pytest.raises(plumbline.InputError, match=words):
        plumbline.matrix(problem, "IPA-AC-R2")


@pytest.mark.parametrize("call, words", [
    (lambda p: plumbline.matrix(p, "P1"), "cannot solve this problem"),
    (lambda p: plumbline.matrix(p, "no such"), "no such"),
    (lambda p: plumbline.matrix(p, "FA", -1), "length above 0"),
    (lambda p: plumbline.matrix(p, "FA", .3), "h"),
    (lambda p: plumbline.matrix(p, "FA", 1e-6), "the matrix at h = 1e-06.*choose a larger h"),
    (lambda p: space.matrix(problem_in_space("scalar"), "FA", 2.**-12), "choose a larger h"),
    (lambda p: plumbline.matrix(problem_of("triangles"), "LOCAL"), "LOCAL.* has no sparse matrix"),
    (lambda p: plumbline.matrix(problem_of("scalar"), "FA") @ [1, 2], "give the values at all nodes"),
    (lambda p: plumbline.matrix(problem_of("scalar"), "FA").with_constraint([1]), "are unknown"),
    (lambda p: plumbline.matrix(problem_of("scalar"), "FA").save("a.txt"), r"\.npz .*\.mtx"),
    (lambda p: space.matrix(problem_in_space("scalar"), "Q3"), "for two dimensions only"),
    (lambda p: space.matrix(problem_in_space("nodes"), "FA", .5), "omit h"),
])
def test_bad_input_is_refused(call, words):
    with pytest.raises(plumbline.InputError, match=words):
        call(problem_of("scalar"))
