"""Elastic constants of rules and of weights."""
import numpy as np

from . import _core
from ._studies import _study


def moduli(rule="all", *, m=(2, 3, 4, 5), E=1., state="plane strain", kernel="bond-tensor"):
    """Elastic constants of rules on lattices, as `plumbline moduli` computes them.

    rule    a name ("FA", "IPA-AC-R2", ...), a Rule, or a list of them; "all": those of the library
    m       horizon / h, each between 1 and 50
    E       Young's modulus that the kernel is scaled to [force/area]
    state   "plane strain" (as in scenes), "plane stress" or "3D" (a cubic lattice; not for a Rule)
    kernel  "bond-tensor", "bond-tensor constant" or "bond-tensor conical"

    Returns a Study with one record for each rule and m: record["E"], "nu", "C1111", "C1122",
    "C1212", "shear along axes", "shear across axes", "anisotropy", "error of E", "neighbours".
    """
    chosen = [rule] if isinstance(rule, (str, _core.Rule)) else list(rule)
    rules = [one for one in chosen if isinstance(one, _core.Rule)]
    names = ",".join(one if isinstance(one, str) else one.name for one in chosen)
    ratios = [repr(float(one)) for one in np.atleast_1d(m)]
    return _study(_core.moduli_json(names, rules, ratios, E, state, kernel))


def moduli_of_weights(kernel, w, xi, *, i=None, points=None, state="plane strain"):
    """Elastic constants of given weights, of each node from the bonds of its family.

    kernel  a tensor Kernel
    w       weights, shape (n_bonds,) [length^2]
    xi      from the node to its neighbour, shape (n_bonds, 2) [length]
    i       index of the node, shape (n_bonds,); default: all bonds are of one node
    points  where the kernel is taken, relative to the node, shape (n_bonds, 2); default: xi
    state   "plane strain" (as in scenes) or "plane stress": the state of E and nu

    Returns a dict of arrays with one value for each node: "nodes" (i, ascending), "C1111", "C1122",
    "C1212", "E", "nu", "shear along axes", "shear across axes", "anisotropy". Both axes are
    averaged, as on a lattice; nodes whose family is cut by the boundary show its surface effect.
    """
    if i is None:
        i = np.zeros(len(w), np.int64)
    return _core.moduli_arrays(kernel, w, xi, i, xi if points is None else points, state)
