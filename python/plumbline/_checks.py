"""Weights of rules, and the check of weights."""
from typing import NamedTuple, Optional

import numpy as np

from . import _core


class Weights(NamedTuple):
    """The bonds and weights that a rule gives for nodes; one row for each bond.

    L_h u_i = -sum_k C(points_k) (u[j_k] - u[i_k]) w_k over the bonds with i_k = i.
    """
    i: Optional[np.ndarray]  # index of the node, shape (n,); None on lattices
    j: Optional[np.ndarray]  # index of its neighbour, shape (n,); None on lattices
    w: np.ndarray            # weights, shape (n,) [length^2]
    points: np.ndarray       # where the kernel is taken, relative to node i, shape (n, 2) [length]
    xi: np.ndarray           # from node i to node j, shape (n, 2) [length]
    area: np.ndarray         # of the neighbour's cell, or of its part in the ball, shape (n,)
    offsets: Optional[np.ndarray] = None  # of lattices: xi / h in whole numbers, shape (n, 2)

    def save(self, nodes_file, bonds_file, nodes, volumes):
        """Write nodes and bonds as CSV with 17 digits, which `plumbline check` reads.

        nodes    those that weights() was given, shape (n, 2) or (n, 3) [length]
        volumes  of their cells, shape (n,); ids in the files are indices from 0
        """
        if self.i is None:
            raise _core.InputError("save: these are the weights of one family on a lattice; give "
                                   "weights() the nodes and their boxes")
        nodes, volumes = np.asarray(nodes, float), np.asarray(volumes, float)
        if nodes.ndim != 2 or nodes.shape[1] != self.xi.shape[1] or volumes.shape != nodes.shape[:1]:
            raise _core.InputError(f"save: nodes has the shape {nodes.shape} and volumes "
                                   f"{volumes.shape}; give (n, {self.xi.shape[1]}) and (n,)")
        axes = "xyz"[:nodes.shape[1]]
        np.savetxt(nodes_file, np.column_stack([np.arange(len(nodes)), nodes, volumes]),
                   fmt="%d" + ",%.17g" * (len(axes) + 1), comments="",
                   header=",".join(["id", *axes, "volume"]))
        np.savetxt(bonds_file, np.column_stack([self.i, self.j, self.w, self.points]),
                   fmt="%d,%d" + ",%.17g" * (len(axes) + 1), comments="",
                   header=",".join(["i", "j", "weight", *("q" + one for one in axes)]))


def weights(rule, kernel, h=None, *, nodes=None, volumes=None, boxes=None, exclude=None):
    """The bonds that a rule gives: one family on a lattice, or the families of all nodes.

    rule     a name ("FA", "LAMMPS", "QWJ", "PA-AC", "IPA-AC", "IPA-AC-R2", ...) or a Rule
    kernel   a Kernel
    h        spacing of a lattice, whose nodes all have the same family [length]
    nodes    instead: shape (n, 2) [length], in the boxes (free) and within a horizon around them
    volumes  areas of the nodes' cells, shape (n,); default: those of their Voronoi cells
    boxes    the domain, ((x0, y0), (x1, y1)) or a list of them; exclude is taken out of it.
             With nodes, h is the side of the cells that fill the boxes (default: as many as nodes)

    Returns Weights: i, j, w, points, xi, area (and offsets of a lattice). i are free nodes.
    """
    if nodes is None:
        if h is None or volumes is not None or boxes is not None:
            raise _core.InputError("weights: give h of a lattice, or nodes with their boxes")
        made = _core.lattice_weights(rule, kernel, h)
        return Weights(None, None, made["w"], made["points"], made["xi"], made["area"],
                       made["offsets"])
    if boxes is None:
        raise _core.InputError("weights: nodes need boxes, the domain whose nodes are free, e.g. "
                               "boxes=((0, 0), (1, 1))")
    if h is None:
        h = _usual_h(np.asarray(nodes, float), boxes)
    made = _core.node_weights(rule, kernel, nodes, volumes, boxes, exclude, h)
    return Weights(made["i"], made["j"], made["w"], made["points"], made["xi"], made["area"])


def _usual_h(nodes, boxes):
    """The side of cells that fill the first box, about as many as it has nodes."""
    low, high = np.reshape(np.asarray(boxes, float), (-1, 2, 2))[0]
    n_inside = np.count_nonzero(np.all((nodes > low) & (nodes < high), axis=-1))
    size = np.sqrt(np.prod(high - low) / max(1, n_inside))
    return (high - low)[0] / max(1, round((high - low)[0] / size))


class Findings(dict):
    """The findings of check() and of space.check(): a dict with

    passed      whether all requirements hold and nothing is inconsistent
    complaints  sentences: causes, outliers, requirements that do not hold
    verdicts    sentences: all other results
    rule        the rule that the weights are recognised as, or ""
    causes      dicts with name, text, factor: what is wrong with all weights
    outliers    dicts with node, neighbour, index (of the bond), found, expected, text
    moments     degrees 1 to 4 with worst, median and the defects of all free nodes
    weights, symmetry, volume_factor, volume_defect, n_free, n_ignored_bonds, spacing
    elastic     for solids: least, median and largest value of C1111, C1122, C1212, E, nu over the nodes
    matrix      signs and eigenvalues; None in three dimensions
    body        None, or of a body with free surfaces or cracks a dict as in check.json: families
                (interior, near surfaces, near cracks), correction, crossing, missing, different;
                moments, weights, symmetry and matrix are those of the interior then
    """

    _ONCE = {  # keys of earlier versions of space.check
        "is_ac": lambda self: self["moments"]["second"]["value"] <= 1e-8,
        "first_moments": lambda self: tuple(self["moments"]["degrees"][0]["worst"].values()),
        "second_moments": lambda self: tuple(self["moments"]["second"].values()),
        "median_moments": lambda self: self["moments"]["degrees"][1]["median"],
        "imbalance": lambda self: self["symmetry"]["imbalance"],
        "n_unpaired": lambda self: self["symmetry"]["n_unpaired"],
        "n_bonds": lambda self: self["weights"]["n_bonds"],
        "n_negative": lambda self: self["weights"]["n_negative"],
    }

    def __missing__(self, key):
        if key not in self._ONCE:
            raise KeyError(key)
        return self._ONCE[key](self)

    def __contains__(self, key):
        return super().__contains__(key) or key in self._ONCE

    def get(self, key, default=None):
        return self[key] if key in self else default

    @property
    def passed(self):
        return self["passed"]

    def __str__(self):
        return "\n".join([*self["verdicts"], *self["complaints"],
                          "as required" if self.passed else "NOT as required"])

    def _repr_pretty_(self, printer, _is_cycle):
        printer.text(str(self))


def as_list(names):
    return [names] if isinstance(names, str) else list(names)


def check(nodes, volumes, i, j, w, kernel, *, boxes, exclude=None, points=None, h=None,
          boundary_is_data=False, rule=(), require=("ac",), bonds_are="weights",
          boundary="constrained", cracks=()):
    """Check the weights of another code, as `plumbline check` does, from arrays.

    nodes     shape (n, 2) [length], those in the boxes (free) and within a horizon around them
    volumes   areas of their cells, shape (n,) [length^2]
    i, j, w   bonds: indices of node and neighbour (from 0) and weight [length^2], shape (n_bonds,)
    kernel    the Kernel that the weights are meant for
    boxes     the domain, ((x0, y0), (x1, y1)) or a list of them; exclude is taken out of it
    points    where the kernel is taken, relative to node i, shape (n_bonds, 2); default: at node j
    h         side of cells that fill the boxes; default: by the number of nodes in the first box
    boundary_is_data  nodes on the boundary of the domain are constrained
    rule      names of the rules that the weights are meant to be, if that is known
    bonds_are  what w holds: "weights", "stiffness" (C w: force density per length) or
              "force constants" (V_i C w: force per length)
    require   of "ac", "consistent", "symmetric", "m-matrix", "moments=TOL"
    boundary  "constrained": nodes around the boxes are constrained, and balls are whole; "free": the
              boundary of the boxes is a free surface, where families are truncated; "periodic":
              opposite sides of one box are joined, all nodes lie in it, and bonds across its sides
              are to the nodes themselves
    cracks    that no bond may cross: a list of polylines, each of shape (n, 2) [length]

    Returns Findings; print() shows its sentences, where nodes are numbered from 0.
    """
    return Findings(_core.check_arrays(nodes, volumes, i, j, w, kernel, boxes, exclude, points,
                                       h or 0., boundary_is_data, as_list(rule),
                                       as_list(require), bonds_are, boundary,
                                       [np.asarray(one, float) for one in cracks]))
