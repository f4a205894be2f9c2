"""Nonlocal models: Galerkin references, meshfree rules, and the check of a code's weights.

Input and output are arrays. Lengths, areas and moduli are in any consistent units. See README.md
next to the sources, and help() of each name.
"""
import os as _os

_n = _os.environ.get("DEAL_II_NUM_THREADS")
if _n is not None and not (_n.isdigit() and 0 < int(_n) <= 100000):  # deal.II ends the process
    raise ValueError("the environment variable DEAL_II_NUM_THREADS must be a whole number from 1 "
                     "to 100000; unset it, or call plumbline.set_threads")

from . import _arguments
_arguments.explain_core()

from ._core import (InputError, Kernel, NumericalError, Problem, Rule, Solution, __version__,
                    kernels, methods, reference, set_threads, solve)
from ._checks import Findings, Weights, check, weights
from ._files import Nodes, read_nodes
from ._grade import certified_problem, certified_problems, grade
from ._matrix import Matrix, load_matrix, matrix
from ._meshes import to_meshio, to_pyvista
from ._moduli import moduli, moduli_of_weights
from . import space
from ._studies import Record, Records, Study, certify, crack, dispersion, grow, run, stability, strip

__all__ = ["Findings", "InputError", "Kernel", "Matrix", "Nodes", "NumericalError", "Problem", "Record",
           "Records", "Rule", "Solution", "Study", "Weights", "certified_problem", "certified_problems", "certify",
           "check", "crack", "dispersion", "grade", "grow", "kernels", "load_matrix", "matrix", "methods", "moduli",
           "moduli_of_weights", "read_nodes", "reference", "run", "set_threads", "solve", "space", "stability",
           "strip", "to_meshio", "to_pyvista", "weights"]

_arguments.explain_python(__all__, globals())
_arguments.explain_python(space.__all__, vars(space))
