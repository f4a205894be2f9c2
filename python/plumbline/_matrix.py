"""The linear equations of a method as arrays, and their files."""
import dataclasses
import os
from typing import Optional

import numpy as np

from . import _core


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class Matrix:
    """The equations A u = load of a method, where u are the values at all nodes.

    A has one row for each unknown and one column for each component of each node; the unknowns come
    first, then what is constrained. Component c of node k is number k * n_components + c. Row k is
    A[k, indices[p]] = data[p] for indptr[k] <= p < indptr[k + 1], columns ascending (CSR).

    Sign: that of -Laplace. The matrix of reduced() is positive definite for Galerkin methods, and on
    lattices for rules with positive weights. A meshfree rule states the equation at its
    nodes, A u = L_h u = -sum C (u_j - u_i) w = load [force/length^dim]; multiplied by `volumes` its
    rows are forces. Rows of a Galerkin method are tested by shape functions [force].
    Constrained nodes have columns and no rows: their values are `constraint`. reduced() moves them
    to the load.
    """

    data: np.ndarray     # entries, shape (n_entries,)
    indices: np.ndarray  # their columns, shape (n_entries,), int32
    indptr: np.ndarray   # where rows begin, shape (n_unknowns + 1,), int64
    load: np.ndarray     # shape (n_unknowns,), units of A u
    nodes: np.ndarray    # free nodes in the order of Solution.nodes, then constrained ones, shape
                         # (n_nodes, dim) [length]; of Galerkin methods support points
    n_unknown_nodes: int     # nodes whose values are unknown: the first ones
    n_components: int        # of u at each node
    constraint: np.ndarray   # u of the constrained nodes, shape ((n_nodes - n_unknown_nodes) *
                             # n_components,); may be 0 at nodes that no row reaches
    volumes: Optional[np.ndarray]  # of the cells of free nodes, shape (n_unknown_nodes,)
                                   # [length^dim]; None for Galerkin methods
    is_exact: bool       # False: entries by quadrature, which is refined as solve() refines it
    method: str

    @property
    def shape(self):
        """(n_unknowns, n_columns)."""
        return len(self.load), len(self.load) + len(self.constraint)

    @property
    def is_unknown(self):
        """Which nodes are unknown, shape (n_nodes,): True for the first n_unknown_nodes."""
        return np.arange(len(self.nodes)) < self.n_unknown_nodes

    def __repr__(self):
        return (f"<plumbline.Matrix of {self.method}: {self.shape[0]} x {self.shape[1]}, "
                f"{len(self.data)} entries, {self.n_unknown_nodes} of {len(self.nodes)} nodes "
                "unknown>")

    def with_constraint(self, u):
        """Values at all nodes, shape (n_columns,), from those at the unknown nodes.

        u  shape (n_unknowns,) or (n_unknown_nodes, n_components), as Solution.values
        """
        u = np.asarray(u, float).ravel()
        if len(u) != len(self.load):
            raise _core.InputError(f"u has {len(u)} values, but {len(self.load)} are unknown; give "
                                   "n_components values for each of the first n_unknown_nodes "
                                   "nodes")
        return np.concatenate([u, self.constraint])

    def __matmul__(self, u):
        """A u, shape (n_unknowns,), of values at all nodes: shape (n_columns,)."""
        u = np.asarray(u, float).ravel()
        if len(u) != self.shape[1]:
            raise _core.InputError(f"u has {len(u)} values, but the matrix has {self.shape[1]} "
                                   "columns; give the values at all nodes, such as "
                                   "with_constraint(solution.values)")
        rows = np.repeat(np.arange(self.shape[0]), np.diff(self.indptr))
        return np.bincount(rows, self.data * u[self.indices], minlength=self.shape[0])

    def reduced(self):
        """The square system of the unknowns: a Matrix without constrained nodes.

        Its load is load - A_c constraint, A_c being the columns of the constrained nodes.
        """
        n = len(self.load)
        is_free = self.indices < n
        of_constraint = self @ np.concatenate([np.zeros(n), self.constraint])
        ends = np.concatenate([[0], np.cumsum(is_free)])
        return dataclasses.replace(
            self, data=self.data[is_free], indices=self.indices[is_free],
            indptr=ends[self.indptr], load=self.load - of_constraint,
            nodes=self.nodes[:self.n_unknown_nodes], constraint=np.zeros(0))

    def to_scipy(self):
        """A as scipy.sparse.csr_matrix; needs the package scipy."""
        from scipy.sparse import csr_matrix
        return csr_matrix((self.data, self.indices, self.indptr), shape=self.shape)

    def save(self, path):
        """Write it to NAME.npz, or to NAME.mtx (Matrix Market, 17 digits).

        .npz  one array for each attribute; load_matrix() reads it
        .mtx  the matrix; beside it NAME_load.mtx, NAME_constraint.mtx and NAME_nodes.mtx
        """
        name, suffix = os.path.splitext(os.fspath(path))
        if suffix == ".npz":
            given = {one.name: getattr(self, one.name) for one in dataclasses.fields(self)}
            given["volumes"] = np.zeros(0) if self.volumes is None else self.volumes
            np.savez(path, **given)
        elif suffix == ".mtx":
            rows = np.repeat(np.arange(self.shape[0]), np.diff(self.indptr))
            with open(path, "w") as file:
                file.write("%%MatrixMarket matrix coordinate real general\n"
                           f"{self.shape[0]} {self.shape[1]} {len(self.data)}\n")
                np.savetxt(file, np.column_stack([rows + 1., self.indices + 1., self.data]),
                           fmt="%d %d %.17g")
            for part in ("load", "constraint", "nodes"):
                _write_array(f"{name}_{part}.mtx", getattr(self, part))
        else:
            raise _core.InputError(f"save: '{path}' ends with '{suffix}'; give a name that ends "
                                   "with .npz (numpy) or .mtx (Matrix Market)")


def _write_array(path, values):
    """Matrix Market's dense format, column by column."""
    columns = values.reshape(len(values), -1)
    with open(path, "w") as file:
        file.write("%%MatrixMarket matrix array real general\n"
                   f"{columns.shape[0]} {columns.shape[1]}\n")
        np.savetxt(file, columns.T.ravel(), fmt="%.17g")


def load_matrix(path):
    """Read a Matrix from a file NAME.npz that Matrix.save() has written."""
    with np.load(path) as file:
        names = [one.name for one in dataclasses.fields(Matrix)]
        missing = [one for one in names if one not in file]
        if missing:
            raise _core.InputError(f"'{path}' has no array {', '.join(missing)}; give a .npz file "
                                   "that Matrix.save() has written")
        given = {one: file[one] for one in names}
    for name, kind in (("n_unknown_nodes", int), ("n_components", int), ("is_exact", bool),
                       ("method", str)):
        given[name] = kind(given[name])
    if not len(given["volumes"]):
        given["volumes"] = None
    return Matrix(**given)


def to_matrix(made):
    """A Matrix of the arrays that _core returns, without copies."""
    return Matrix(**{**made, "indices": made["indices"].view(np.int32),
                     "indptr": made["indptr"].view(np.int64)})


def matrix(problem, method, h=None):
    """The discrete operator of a method on a problem, with its load and nodes: a Matrix.

    problem  a Problem
    method   a name of plumbline.methods(), meshfree or Galerkin, or a Rule
    h        of cells other than the problem's own [length]; not for meshes and nodes in arrays

    matrix(problem, method) @ values = load for the values at all nodes that solve() finds. Bodies
    with a free boundary, periodic problems and the method LOCAL have no such matrix.
    """
    return to_matrix(_core.matrix_arrays(problem, method, h))
