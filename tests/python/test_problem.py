"""Problems from arrays, expressions and functions, and their solutions."""
import threading
import time

import numpy as np
import pytest
from conftest import lattice

import plumbline

H = 1 / 16
KERNEL = plumbline.Kernel("linear-decay", horizon=3 * H, diffusion=.5)


def quadratic(x, y):
    return x * (1 - x) / 2 + y * (1 - y) / 2


def square_problem(square, **given):
    return plumbline.Problem(KERNEL, boxes=square, h=H, **given)


def test_consistent_weights_solve_a_quadratic_exactly(square):
    # L u = -1/2 Laplace u = 1 for every quadratic, the second moments being exact
    u = plumbline.solve(square_problem(square, load=1, constraint=quadratic), "IPA-AC-R2")
    assert u.nodes.shape == (256, 2) and u.values.shape == (256,)
    assert u.values == pytest.approx(quadratic(*u.nodes.T), abs=1e-11)
    wrong = plumbline.solve(square_problem(square, load=1, constraint=quadratic), "FA")
    assert np.max(np.abs(wrong.values - quadratic(*wrong.nodes.T))) > 1e-3


def test_functions_and_expressions_are_the_same_field(square):
    by_text = plumbline.solve(square_problem(square, load="cos(x*y)", constraint="x^2"), "PA-AC")
    by_function = plumbline.solve(
        square_problem(square, load=lambda x, y: np.cos(x * y), constraint=lambda x, y: x**2),
        "PA-AC")
    assert by_function.values == pytest.approx(by_text.values, rel=1e-12)


def test_functions_are_called_with_all_nodes_at_once(square):
    sizes = []

    def load(x, y):
        sizes.append(x.size)
        return np.ones_like(x)
    problem = square_problem(square, load=load)
    sizes_before = len(sizes)
    plumbline.solve(problem, "FA")
    assert max(sizes) >= 256
    assert len(sizes) == sizes_before  # what the solve asks for is known by then


def test_galerkin_converges_to_the_given_solution(square):
    errors = []
    for h in (1 / 8, 1 / 16):
        kernel = plumbline.Kernel("linear-decay", horizon=3 / 16)
        problem = plumbline.Problem(kernel, boxes=square, h=h, solution="sin(3*x)*cos(2*y)")
        u = plumbline.solve(problem, "Q1")
        points = np.random.default_rng(0).uniform(0, 1, (200, 2))
        errors.append(np.sqrt(np.mean((u(points) - np.sin(3 * points[:, 0])
                                       * np.cos(2 * points[:, 1]))**2)))
    assert errors[1] < .3 * errors[0] < .01  # order 2


def test_reference_is_as_right_as_it_says(square):
    problem = square_problem(square, solution="sin(3*x)*cos(2*y)")
    u = plumbline.reference(problem)
    assert u.method == "Q2" and u.averages.shape == (256,)
    # averages of the exact solution over the cells
    low, high = u.cells - H / 2, u.cells + H / 2
    exact = ((np.cos(3 * low[:, 0]) - np.cos(3 * high[:, 0])) / 3
             * (np.sin(2 * high[:, 1]) - np.sin(2 * low[:, 1])) / 2) / H**2
    error = np.sqrt(np.mean((u.averages - exact)**2))
    assert 0 < error <= u.estimate["averages"] < 1e-4
    assert u.estimate["certified_digits"] >= 4


def test_scattered_nodes_keep_the_order_of_their_solution(square):
    nodes = lattice(16, 3)
    nodes += np.random.default_rng(3).uniform(-.2, .2, nodes.shape) * H
    problem = square_problem(square, nodes=nodes, load=1, constraint=quadratic)
    u = plumbline.solve(problem, "IPA-AC-R2")
    assert u.values == pytest.approx(quadratic(*u.nodes.T), abs=1e-10)
    assert u(u.nodes) == pytest.approx(u.values)
    assert u.nodes == pytest.approx(nodes[np.all((nodes > 0) & (nodes < 1), axis=1)], abs=1e-15)


def test_two_components(square):
    kernel = plumbline.Kernel("bond-tensor", 3 * H, bulk_modulus=1)
    problem = plumbline.Problem(kernel, boxes=square, h=H, load="0, 0",
                                constraint=lambda x, y: (x + 2 * y, 3 * x))
    u = plumbline.solve(problem, "FA")
    x, y = u.nodes.T
    assert u.values.shape == (256, 2)  # a linear field has no force on a symmetric family
    assert u.values == pytest.approx(np.stack([x + 2 * y, 3 * x], axis=1), abs=1e-11)


def test_coefficient_by_a_function(square):
    def solve(a):
        problem = plumbline.Problem(KERNEL, boxes=square, h=H, cells="squares", load=1,
                                    coefficient=a)
        return plumbline.solve(problem, "IPA-AC").values
    one = solve(lambda x, y: np.ones_like(x))
    assert solve(2.) == pytest.approx(one / 2, rel=1e-9)
    assert solve("2 + x") == pytest.approx(solve(lambda x, y: 2 + x), rel=1e-9)


def test_gmsh_file(tmp_path):
    file = tmp_path / "square.geo"
    file.write_text("""DefineConstant[ h = .1, delta = .3 ];
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 1, 1};
Rectangle(2) = {-1.01*delta, -1.01*delta, 0, 1 + 2.02*delta, 1 + 2.02*delta};
BooleanFragments{ Surface{2}; Delete; }{ Surface{1}; Delete; }
omega() = Surface In BoundingBox{-1e-3, -1e-3, -1, 1 + 1e-3, 1 + 1e-3, 1};
Physical Surface("omega") = omega();
all() = Surface "*"; all() -= omega();
Physical Surface("collar") = all();
Mesh.MeshSizeMin = h; Mesh.MeshSizeMax = h;
""")
    problem = plumbline.Problem(plumbline.Kernel("linear-decay", .3), mesh=str(file), h=.1,
                                solution="x^2 - y^2")
    u = plumbline.solve(problem, "P1")
    points = np.random.default_rng(0).uniform(0, 1, (100, 2))
    assert u(points) == pytest.approx(points[:, 0]**2 - points[:, 1]**2, abs=.01)


@pytest.mark.parametrize("n_vertices, method", [(4, "Q1"), (3, "P1"), (4, "IPA-AC")])
def test_a_mesh_in_arrays_is_the_mesh_of_boxes(square, n_vertices, method):
    n, around = 8, 4  # cells of the square, layers around it
    kernel = plumbline.Kernel("linear-decay", 3 / 8)
    x = np.arange(-around, n + around + 1) / n
    vertices = np.stack([a.ravel() for a in np.meshgrid(x, x)], axis=-1)
    j, i = [a.ravel() for a in np.mgrid[:n + 2 * around, :n + 2 * around]]
    corner, row = j * len(x) + i, len(x)
    cells = np.stack([corner, corner + 1, corner + row + 1, corner + row], axis=1)
    inside = (i >= around) & (i < n + around) & (j >= around) & (j < n + around)
    if n_vertices == 3:
        cells = np.concatenate([cells[:, [0, 1, 2]], cells[:, [0, 2, 3]]])
        inside = np.tile(inside, 2)
    cells[::3] = cells[::3, ::-1]  # clockwise ones are turned around
    exact = dict(solution="x^2 - y^2")
    u = plumbline.solve(plumbline.Problem(kernel, mesh=(vertices, cells, inside), **exact), method)
    same = plumbline.solve(plumbline.Problem(
        kernel, boxes=square, h=1 / n, cells="squares" if n_vertices == 4 else "triangles",
        **exact), method)
    points = np.random.default_rng(0).uniform(0, 1, (50, 2))
    assert u(points) == pytest.approx(same(points), abs=1e-9)
    assert u(points) == pytest.approx(points[:, 0]**2 - points[:, 1]**2, abs=.2)


def test_a_rule_in_python_solves_like_ours(square):
    mine = plumbline.Rule("mine", lambda xi, area: area)
    problem = square_problem(square, load=1)
    assert np.array_equal(plumbline.solve(problem, mine).values,
                          plumbline.solve(problem, "FA").values)
    scattered = square_problem(square, load=1, nodes=lattice(16, 3) + .001)
    assert np.array_equal(plumbline.solve(scattered, mine).values,
                          plumbline.solve(scattered, "FA").values)


def test_other_threads_run_while_one_solves(square):
    problem = plumbline.Problem(KERNEL, boxes=square, h=H, cells="squares", load=1)
    ticks, done = [], threading.Event()

    def tick():
        while not done.is_set():
            ticks.append(time.perf_counter())
            time.sleep(.001)
    thread = threading.Thread(target=tick)
    thread.start()
    begin = time.perf_counter()
    plumbline.solve(problem, "Q1")
    end = time.perf_counter()
    done.set()
    thread.join()
    inside = [t for t in ticks if begin < t < end]
    assert end - begin < .02 or len(inside) > (end - begin) / .02


def test_methods_and_cost(square):
    names = [one["name"] for one in plumbline.methods()]
    assert names[:2] == ["FA", "LAMMPS"] and "Q2" in names
    u = plumbline.solve(square_problem(square, load=1), "FA")
    assert u.cost["n_unknowns"] == 256 and u.cost["setup_seconds"] >= 0
    assert u.diagnostics["n_neighbours"] == 28


@pytest.mark.parametrize("method, cells, order", [("Q1", "lattice", 1), ("Q2", "lattice", 2),
                                                  ("Q3", "lattice", 3), ("Q1", "squares", 1),
                                                  ("Q2", "squares", 2), ("P1", "triangles", 1),
                                                  ("P2", "triangles", 2), ("P3", "triangles", 3)])
def test_gradients_converge_and_are_those_of_the_values(square, method, cells, order):
    # the solution is smooth, so that derivatives in cells have the error h^p
    points = np.random.default_rng(3).uniform(.02, .98, (60, 2))
    points = points[np.all(np.abs(points * 16 - np.round(points * 16)) > .01, axis=1)]
    x, y = points.T
    exact = np.stack([3 * np.cos(3 * x) * np.cos(2 * y), -2 * np.sin(3 * x) * np.sin(2 * y)], -1)
    kernel = plumbline.Kernel("linear-decay", horizon=3 / 8)
    errors = []
    for h in (1 / 8, 1 / 16):
        u = plumbline.solve(plumbline.Problem(kernel, boxes=square, h=h, cells=cells,
                                              solution="sin(3*x)*cos(2*y)"), method)
        found = u.gradient(points)
        assert found.shape == points.shape
        step = 1e-6
        for d in range(2):
            move = step * np.eye(2)[d]
            inside = (u(points + move) - u(points - move)) / (2 * step)
            on_one_cell = np.abs(found[:, d] - inside) < 1e-7
            assert np.mean(on_one_cell) > .9  # others are near a side of a triangle
        errors.append(np.sqrt(np.mean((found - exact)**2)))
    assert errors[1] < errors[0] * .5**order * 1.5


def test_gradients_of_vectors_and_of_moved_meshes(square):
    n, tensor = 8, plumbline.Kernel("bond-tensor", horizon=3 / 8, bulk_modulus=2)
    points = np.array([[.31, .72], [.9, .1], [.5, .5]])
    expected = np.tile([[1, 2], [3, -1]], (3, 1, 1))
    u = plumbline.solve(plumbline.Problem(tensor, boxes=square, h=1 / n, solution="x + 2*y, 3*x - y",
                                          load="0, 0"), "Q2")
    assert u.gradient(points) == pytest.approx(expected, abs=1e-9)
    # cells with a bilinear map
    k = np.arange(-n // 2, n + n // 2 + 1)
    vertices = np.stack(np.meshgrid(k, k), -1).reshape(-1, 2) / n
    inner = np.all((vertices > .01) & (vertices < .99), axis=1)
    vertices[inner] += np.random.default_rng(2).uniform(-.02, .02, vertices[inner].shape)
    wide = len(k)
    cells = np.array([(a + wide * b, a + 1 + wide * b, a + 1 + wide * (b + 1), a + wide * (b + 1))
                      for b in range(wide - 1) for a in range(wide - 1)])
    middle = vertices[cells].mean(axis=1)
    inside = np.all((middle > 0) & (middle < 1), axis=1)
    scalar = plumbline.Kernel("linear-decay", horizon=3 / 8)
    problem = plumbline.Problem(scalar, mesh=(vertices, cells, inside), solution="x + 2*y", load=0)
    u = plumbline.solve(problem, "Q1")
    assert u.gradient(points) == pytest.approx(np.tile([1, 2], (3, 1)), abs=1e-3)


def test_gradients_are_refused_where_solutions_jump(square):
    problem = square_problem(square, solution="x*y")
    for method in ("FA", "DGQ1"):
        with pytest.raises(plumbline.InputError, match="has no gradient"):
            plumbline.solve(problem, method).gradient([[.5, .5]])
    with pytest.raises(plumbline.InputError, match=r"points\[0\]"):
        plumbline.solve(problem, "Q1").gradient([[2, .5]])


def test_errors_are_estimated_at_points(square):
    points = np.array([[.31, .72], [.9, .1], [.5, .5]])
    problem = square_problem(square, solution="sin(3*x)*cos(2*y)")
    u = plumbline.reference(problem, "Q1", points=points)
    error = np.abs(u(points) - np.sin(3 * points[:, 0]) * np.cos(2 * points[:, 1]))
    estimate = u.estimate["at_points"]
    assert estimate.shape == (3,) and np.all(error <= estimate) and estimate.max() < .01
    assert plumbline.reference(problem, "Q1").estimate["at_points"] is None
    with pytest.raises(plumbline.InputError, match="estimate = True"):
        plumbline.reference(problem, "Q1", False, points)
    with pytest.raises(plumbline.InputError, match=r"points\[1\].*outside"):
        plumbline.reference(problem, "Q1", points=[[.5, .5], [3, 3]])
