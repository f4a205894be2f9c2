"""Solutions as meshes of other Python packages."""
import os
import tempfile

import numpy as np

from . import _core


def _require_meshio():
    try:
        import meshio
    except ImportError:
        raise ImportError("to_meshio and to_pyvista need meshio: apt-get install python3-meshio") from None
    return meshio


# corners of the reference cube in the order of VTK
_CORNERS = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0),
                     (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)])


def _cubes(meshio, solution):
    """The cubes of a solution in space, corners shared, with its averages over them."""
    centres, h = solution.cells, solution.h
    low = centres.min(axis=0)
    at = np.rint((centres - low) / h).astype(int)
    corners, index = np.unique((at[:, None] + _CORNERS).reshape(-1, 3), axis=0, return_inverse=True)
    return meshio.Mesh(low - h / 2 + corners * h, [("hexahedron", index.reshape(-1, 8))],
                       cell_data={"average of u": [solution.averages]})


def to_meshio(solution):
    """A solution as a meshio.Mesh, for all formats that meshio writes. Needs meshio.

    solution  of solve() or reference(): what Solution.write_vtu writes, points with the point data
              "u", of finite elements also their cells (each split where functions are of degree 2
              or more); or of space.solve(): the cubes of the domain with the cell data "average of u"
    """
    meshio = _require_meshio()
    if isinstance(solution, _core.SpaceSolution):
        return _cubes(meshio, solution)
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "solution.vtu")
        solution.write_vtu(file)
        return meshio.read(file)


def to_pyvista(solution):
    """A solution as a pyvista.UnstructuredGrid, see to_meshio(). Needs pyvista and meshio."""
    mesh = to_meshio(solution)
    try:
        import pyvista
    except ImportError:
        raise ImportError("to_pyvista needs the Python package pyvista, which Debian 12 does not "
                          "have: pip install pyvista; or take to_meshio") from None
    return pyvista.from_meshio(mesh)
