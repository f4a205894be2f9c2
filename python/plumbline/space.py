"""Three dimensions: kernels, weights of rules, problems on boxes of cubes, the check of weights."""
from . import _core
from ._checks import Findings, Weights, as_list as _as_list
from ._matrix import to_matrix as _to_matrix
from ._core import SpaceKernel as Kernel, SpaceProblem as Problem, SpaceSolution as Solution

__all__ = ["Kernel", "Problem", "Solution", "check", "matrix", "solve", "weights"]


def weights(rule, kernel, h, *, nodes=None, volumes=None, boxes=None, exclude=None):
    """The bonds that a rule gives to every node of a lattice of cubes, or to scattered nodes.

    rule    a name ("FA", "LAMMPS", "QWJ", "PA-AC", "IPA-AC", "IPA-AC-R2", ...)
    kernel  a space.Kernel
    h       spacing of a lattice; with nodes the side of cubes that fill the box [length]
    nodes   shape (n, 3) [length], free in the box, constrained in a layer at least a horizon wide
    volumes  volumes of the nodes' cells, shape (n,) [length^3]; default: those of their Voronoi cells
    boxes   the domain, ((x0, y0, z0), (x1, y1, z1)) or a list of them; exclude is removed from it
            (box is its former name)

    Returns Weights: w of shape (n_bonds,) [length^3], points and xi of shape (n_bonds, 3) [length],
    area (here the volume of the neighbour's cell or of its part in the ball); of a lattice offsets
    = xi / h, of scattered nodes i (free) and j, indices of nodes.
    """
    if nodes is not None:
        if boxes is None:
            raise _core.InputError("weights: nodes require boxes, the domain in which nodes are free, e.g. "
                                   "boxes=((0, 0, 0), (1, 1, 1))")
        made = _core.node_weights_in_space(rule, kernel, nodes, volumes, boxes, exclude, h)
        return Weights(made["i"], made["j"], made["w"], made["points"], made["xi"], made["area"])
    if volumes is not None or boxes is not None or exclude is not None:
        raise _core.InputError("weights: volumes, boxes and exclude apply to scattered nodes only; give nodes as well, or omit them")
    made = _core.lattice_weights(rule, kernel, h)
    return Weights(None, None, made["w"], made["points"], made["xi"], made["area"], made["offsets"])


def solve(problem, method):
    """Solve a space.Problem by a meshfree rule, "Q1", "Q2", "DGQ0", "DGQ1", "DGQ2", "P1", "DGP0" or "DGP1": a space.Solution."""
    return _core.solve_in_space(problem, method)


def matrix(problem, method, h=None):
    """The discrete operator of a method on a space.Problem, with its load and nodes.

    method  a meshfree rule, "Q1", "Q2", "DGQ0", "DGQ1", "DGQ2", "P1", "DGP0" or "DGP1"
    h       side of cubes other than the problem's own [length]; not with a mesh or scattered nodes

    Returns a plumbline.Matrix, whose help gives shapes, units, the sign, and the order of unknowns.
    """
    return _to_matrix(_core.matrix_in_space(problem, method, h))


def check(nodes, volumes, i, j, w, kernel, *, boxes, points=None, h=None, rule=(), require=("ac",),
          bonds_are="weights", boundary="constrained"):
    """Check the weights of another code, as `plumbline check` does, from arrays.

    nodes     shape (n, 3) [length], those in the box (free) and within a horizon around it
    volumes   of their cells, shape (n,) [length^3]
    i, j, w   bonds: indices of node and neighbour (from 0) and weight [length^3], shape (n_bonds,);
              each pair from both ends
    kernel    the space.Kernel for which the weights are intended
    boxes     the domain, one box: ((x0, y0, z0), (x1, y1, z1))
    points    where the kernel is evaluated, relative to node i, shape (n_bonds, 3); default: at node j
    h         the intended spacing of the nodes; default: computed from their number in the box
    rule      names of the rules that the weights are intended to follow, if known
    bonds_are  what w holds: "weights", "stiffness" (C w: force density per length) or
              "force constants" (V_i C w: force per length)
    require   of "ac", "consistent", "symmetric", "m-matrix", "moments=TOL"
    boundary  "constrained": nodes around the box are constrained; "periodic": opposite sides of the
              box are identified, all nodes lie in it, and bonds across a side lead to the nodes themselves

    box and meant are the earlier names of boxes and rule. Returns Findings, as plumbline.check does, but
    "matrix" and "body" are None; print() shows its sentences, with nodes numbered from 0.
    """
    return Findings(_core.check_in_space(nodes, volumes, i, j, w, kernel, boxes, points, h or 0., _as_list(rule),
                                         _as_list(require), bonds_are, boundary))
