"""A wrong argument is told by our message, as an exception of Python's kinds."""
import os
import pickle
import subprocess
import sys

import numpy as np
import pytest
from conftest import lattice

import plumbline

KERNEL = plumbline.Kernel("constant", .3)
SQUARE = ((0, 0), (1, 1))


def refused(words, action, kind=plumbline.InputError):
    with pytest.raises(kind) as caught:
        action()
    for word in words:
        assert word in str(caught.value)


def test_kinds():
    assert issubclass(plumbline.InputError, ValueError)
    assert issubclass(plumbline.NumericalError, (ArithmeticError, RuntimeError))


@pytest.mark.parametrize("words, action", [
    (["no-such", "linear-decay"], lambda: plumbline.Kernel("no-such", .3)),
    (["horizon", "-1"], lambda: plumbline.Kernel("constant", -1)),
    (["tensor", "bulk_modulus"], lambda: plumbline.Kernel("bond-tensor", .3, diffusion=1)),
    (["give one"], lambda: plumbline.Kernel("constant", .3, diffusion=1, constant=1)),
    (["'gaussian'", "needs width, s in horizons", "width=0.5"], lambda: plumbline.Kernel("gaussian", .3)),
    (["'polynomial'", "needs coefficients"], lambda: plumbline.Kernel("polynomial", .3)),
    (["'table'", "needs table", "[[0, 1], [1, 0]]"], lambda: plumbline.Kernel("table", .3)),
    (["no_such.csv", "cannot be read"], lambda: plumbline.Kernel("table", .3, table="no_such.csv")),
    (["neither rows [t, rho] nor the name"], lambda: plumbline.Kernel("table", .3, table=[1, 2])),
    (["'constant'", "has no width"], lambda: plumbline.Kernel("constant", .3, width=.5)),
    (["rule = 'FB'", "FA, LAMMPS"], lambda: plumbline.weights("FB", KERNEL, .1)),
    (["h = -0.1"], lambda: plumbline.weights("FA", KERNEL, -.1)),
    (["nodes has the shape (3, 1)"],
     lambda: plumbline.weights("FA", KERNEL, nodes=[[1], [2], [3]], boxes=SQUARE, h=.1)),
    (["boxes"], lambda: plumbline.weights("FA", KERNEL, nodes=[[1, 2]])),
    (["xi[1] is 0"], lambda: KERNEL([[.1, .1], [0, 0]])),
    (["boxes with h, or by a mesh"], lambda: plumbline.Problem(KERNEL)),
    (["h = 0"], lambda: plumbline.Problem(KERNEL, boxes=SQUARE)),
    (["mesh is neither"], lambda: plumbline.Problem(KERNEL, mesh=np.ones(3))),
    (["cells[0, 2] = 9 is no vertex"],
     lambda: plumbline.Problem(KERNEL, mesh=(np.eye(3, 2), [[0, 1, 9]], [True]))),
    (["mesh: inside has the shape (2)"],
     lambda: plumbline.Problem(KERNEL, mesh=(np.eye(3, 2), [[0, 1, 2]], [True, True]))),
    (["cells = 'hexagons'"], lambda: plumbline.Problem(KERNEL, boxes=SQUARE, h=.1, cells="hexagons")),
    (["load", "sin(3*x"], lambda: plumbline.Problem(KERNEL, boxes=SQUARE, h=.1, load="sin(3*x")),
    (["load = 'x, y' has 2 components"],
     lambda: plumbline.Problem(KERNEL, boxes=SQUARE, h=.1, load="x, y")),
    (["load = [1]"], lambda: plumbline.Problem(KERNEL, boxes=SQUARE, h=.1, load=[1])),
    (["load: the function returned an array of shape (3)", "shape (n,)"],
     lambda: plumbline.Problem(KERNEL, boxes=SQUARE, h=.1, load=lambda x, y: np.ones(3))),
    (["load", "finite"],
     lambda: plumbline.Problem(KERNEL, boxes=SQUARE, h=.1, load=lambda x, y: x * np.nan)),
    (["method", "Q17", "Q2"],
     lambda: plumbline.solve(plumbline.Problem(KERNEL, boxes=SQUARE, h=.1), "Q17")),
    (["method = 3"],
     lambda: plumbline.solve(plumbline.Problem(KERNEL, boxes=SQUARE, h=.1), 3)),
    (["P1", "lattice"],
     lambda: plumbline.solve(plumbline.Problem(KERNEL, boxes=SQUARE, h=.1), "P1")),
    (["FA", "no Galerkin method"],
     lambda: plumbline.reference(plumbline.Problem(KERNEL, boxes=SQUARE, h=.1), "FA")),
    (["Q1+polygon8", "replaces the ball by a polygon of 8 sides", "choose Q2"],
     lambda: plumbline.reference(plumbline.Problem(KERNEL, boxes=SQUARE, h=.1), "Q1+polygon8")),
    (["points[0]", "outside"],
     lambda: plumbline.solve(plumbline.Problem(KERNEL, boxes=SQUARE, h=.1), "FA")([[2, 2]])),
    (["no-such.prm"], lambda: plumbline.run("no-such.prm")),
    (["Study/no such key"], lambda: plumbline.run("set Purpose = x\n", set={"Study/no such key": 1})),
    (["rule 'mine'", "shape (2)"],
     lambda: plumbline.weights(plumbline.Rule("mine", lambda xi, area: area[:2]), KERNEL, .1)),
])
def test_messages(words, action):
    refused(words, action)


def test_a_numerical_failure_is_an_arithmetic_error():
    # too few neighbours for the moments of degree 4
    problem = plumbline.Problem(plumbline.Kernel("constant", .11), boxes=SQUARE, h=.1, load=1)
    refused(["moment"], lambda: plumbline.solve(problem, "IPA-AC-R4"), plumbline.NumericalError)
    refused(["moment"], lambda: plumbline.solve(problem, "IPA-AC-R4"), ArithmeticError)


def test_an_exception_of_a_users_function_comes_through():
    def load(x, y):
        raise KeyError("mine")
    with pytest.raises(KeyError, match="mine"):
        plumbline.Problem(KERNEL, boxes=SQUARE, h=.1, load=load)
    rule = plumbline.Rule("mine", lambda xi, area: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        plumbline.solve(plumbline.Problem(KERNEL, boxes=SQUARE, h=.1, load=1), rule)
    nodes = lattice(10, 3)
    with pytest.raises(ZeroDivisionError):
        plumbline.solve(plumbline.Problem(KERNEL, boxes=SQUARE, h=.1, load=1, nodes=nodes), rule)


def test_a_wrong_number_of_threads_does_not_end_the_process():
    environment = dict(os.environ, DEAL_II_NUM_THREADS="many")
    ended = subprocess.run([sys.executable, "-c", "import plumbline"], env=environment,
                           capture_output=True, text=True)
    assert ended.returncode == 1 and "DEAL_II_NUM_THREADS" in ended.stderr


def test_a_kernel_takes_the_file_of_its_table(tmp_path):
    file = tmp_path / "profile.csv"
    file.write_text("t,rho\n0,1\n1,0\n")
    bonds = [[.1, .05], [.2, 0]]
    expected = plumbline.Kernel("table", .3, table=np.array([[0, 1], [1, 0]]))(bonds)
    assert np.array_equal(plumbline.Kernel("table", .3, table=file)(bonds), expected)
    assert np.array_equal(plumbline.Kernel("table", .3, table=str(file))(bonds), expected)


@pytest.mark.parametrize("words, action", [
    (["Kernel has no argument E", "give Kernel(type, horizon, diffusion=None", "bulk_modulus = 2/3 E"],
     lambda: plumbline.Kernel("bond-tensor", E=200e9)),
    (["did you mean diffusion?"], lambda: plumbline.Kernel("constant", .3, difusion=1)),
    (["the argument horizon is missing"], lambda: plumbline.Kernel("constant")),
    (["at most 2 positional arguments", "diffusion", "by name"], lambda: plumbline.Kernel("constant", .3, 1)),
    (["horizon = 'x' is not a number"], lambda: plumbline.Kernel("constant", "x")),
    (["Problem: kernel = 3 is not a plumbline.Kernel"], lambda: plumbline.Problem(3)),
    (["Problem.of_scene has no argument levels", "did you mean level?"],
     lambda: plumbline.Problem.of_scene("x", levels=3)),
    (["weights: kernel = 'k' is not a plumbline.Kernel"], lambda: plumbline.weights("FA", "k", .1)),
    (["weights has no argument H"], lambda: plumbline.weights("FA", KERNEL, H=.1)),
    (["space.Kernel: the argument horizon is missing"], lambda: plumbline.space.Kernel("constant")),
    (["Kernel.moment has no argument c"], lambda: KERNEL.moment((0, 0), c=1)),
    (["xi = 'x' is not an array of numbers"], lambda: KERNEL("x")),
    (["solve: problem = None is not a plumbline.Problem"], lambda: plumbline.solve(None, "FA")),
    (["reference: problem = None is not a plumbline.Problem"], lambda: plumbline.reference(None)),
    (["matrix: problem = None is not a plumbline.Problem"], lambda: plumbline.matrix(None, "FA")),
    (["problem = None is not a plumbline.space.Problem"], lambda: plumbline.space.solve(None, "FA")),
    (["space.matrix", "give problem"], lambda: plumbline.space.matrix(None, "FA")),
    (["set_threads(-1)", "out of range"], lambda: plumbline.set_threads(-1)),
    (["Solution has no constructor"], lambda: plumbline.Solution()),
])
def test_arguments_are_told_by_name_with_those_that_are_allowed(words, action):
    with pytest.raises(TypeError) as caught:
        action()
    for word in words:
        assert word in str(caught.value)
    for foreign in ("incompatible", "_core", "Invoked with", "\n"):
        assert foreign not in str(caught.value)


def test_public_functions_can_be_pickled():
    for one in (plumbline.run, plumbline.check, plumbline.weights, plumbline.solve, plumbline.kernels,
                plumbline.space.solve, plumbline.Problem.of_scene):
        assert pickle.loads(pickle.dumps(one)) is one


def test_every_public_function_and_class_explains_its_arguments():
    for module in (plumbline, plumbline.space):
        for name in module.__all__:
            one = getattr(module, name)
            if callable(one) and not (isinstance(one, type) and (issubclass(one, (Exception, tuple)) or
                                                                 one.__module__ != "plumbline._core")):
                with pytest.raises(TypeError) as caught:
                    one(no_such_argument=1)
                assert "no_such_argument" in str(caught.value) or "no constructor" in str(caught.value), name
