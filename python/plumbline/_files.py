"""Nodes and volumes from files of other programs."""
import pathlib
from typing import NamedTuple, Optional

import numpy as np

from . import _core


class Nodes(NamedTuple):
    """Nodes of a meshfree code, in the order of the file, or of their ids in a LAMMPS dump."""
    nodes: np.ndarray              # coordinates, shape (n, 2) or (n, 3) [length]
    volumes: Optional[np.ndarray]  # of their cells, shape (n,) [length^dimension]; None: not in the file
    ids: np.ndarray                # as the file numbers them, shape (n,)
    groups: np.ndarray             # types, blocks or names of groups, shape (n,)


def read_nodes(file, *, format=None, volume=None, style=None, frame=-1, dimension=None):
    """Read the nodes and volumes of a meshfree code from a file, for check() and weights().

    file    in one of these formats, recognised by its ending or first line:
            "lammps data", "lammps dump" (text), "peridigm" (lines x y z block volume), "csv"
            (columns x, y, [z], volume, [id], [group]); all other formats by meshio, which must be
            installed: VTU and VTK, Exodus (with netCDF4), Abaqus .inp, gmsh .msh ... The
            cells of a mesh become nodes at their centroids; in files without cells the points are
            the nodes
    format  one of these names, or "meshio"; default: recognised from the file
    volume  the name of the column or of the point data that holds volumes; default: "volume"
    style   of the atoms of a LAMMPS data file: "peri" (with volumes) or "atomic"; default: as the
            file says after "Atoms #"
    frame   of a LAMMPS dump: 0 is the first, -1 the last
    dimension  2 or 3; default: 2 where all z are equal

    Returns Nodes: nodes, volumes, ids, groups.
    Raises InputError with file, line and reason.
    """
    path = pathlib.Path(file)
    if dimension not in (None, 2, 3):
        raise _core.InputError(f"read_nodes: dimension = {dimension}; give 2, 3 or None")
    kind = format or _format_of(path)
    if kind not in _readers:
        raise _core.InputError(f"read_nodes: format = '{kind}' is not known; choose one of "
                               + ", ".join(f"'{one}'" for one in _readers))
    for name, value, usual in (("volume", volume, None), ("style", style, None), ("frame", frame, -1)):
        if value != usual and name not in _arguments[kind]:
            raise _core.InputError(f"read_nodes: {name} = {value!r} is not used by files of the format "
                                   f"'{kind}'; leave it out")
    x, volumes, ids, groups, of_cells = _readers[kind](path, volume, style, frame)
    _require_good(path, x, volumes, ids)
    is_flat = x.shape[1] == 2 or (np.ptp(x[:, 2]) == 0 and of_cells != 3)
    if of_cells == 2 and (not is_flat or dimension == 3):
        _fail(path, "has cells of a surface in space, which have areas and no volumes; give a mesh of "
                    "tetrahedra or hexahedra, or one in the plane")
    if dimension == 2 and not is_flat:
        raise _core.InputError(f"'{path}': z is not the same for all nodes, so that they are not in "
                               "a plane; give dimension=3")
    if dimension == 3 and x.shape[1] == 2:
        raise _core.InputError(f"'{path}' has no z; give dimension=2")
    if dimension != 3 and is_flat:
        x = x[:, :2]
    return Nodes(np.ascontiguousarray(x), volumes, ids, groups)


def _fail(path, reason, line=None):
    place = f"'{path}'" + ("" if line is None else f", line {line}")
    raise _core.InputError(f"{place}: {reason}")


def _lines(path):
    try:
        return path.read_text(encoding="utf-8").splitlines()
    except OSError as error:
        _fail(path, f"cannot be read: {error.strerror}; give a file that exists")
    except UnicodeDecodeError:
        _fail(path, "is not a text file; give its format, e.g. format='meshio'")


def _format_of(path):
    ending = path.suffix.lower()
    if ending == ".csv":
        return "csv"
    if ending not in ("", ".txt", ".data", ".lmp", ".dump", ".lammpstrj", ".dat"):
        return "meshio"
    first = (_lines(path) or [""])[0]
    if first.startswith("ITEM:"):
        return "lammps dump"
    return "lammps data" if ending in (".data", ".lmp") or "LAMMPS" in first else "peridigm"


def _require_good(path, x, volumes, ids):
    if len(x) == 0:
        _fail(path, "has no nodes; give a file with nodes")
    bad = np.flatnonzero(~np.all(np.isfinite(x), axis=1))
    if len(bad):
        _fail(path, f"node {ids[bad[0]]} has a coordinate that is not finite")
    if volumes is not None:
        bad = np.flatnonzero(~(np.isfinite(volumes) & (volumes > 0)))
        if len(bad):
            _fail(path, f"node {ids[bad[0]]} has the volume {volumes[bad[0]]:g}; all must be above 0")


def _table(path, lines, n_columns, what):
    """Numbers from lines (number from 1, text), shape (n, n_columns)."""
    rows = []
    for number, text in lines:
        words = text.split()
        if len(words) < n_columns:
            _fail(path, f"has {len(words)} columns where {what} needs {n_columns}", number)
        try:
            rows.append([float(word) for word in words[:n_columns]])
        except ValueError as error:
            _fail(path, f"{error} ({what})", number)
    return np.array(rows, float).reshape(-1, n_columns)


def _peridigm(path, volume, style, frame):
    lines = [(k, text.split("#")[0]) for k, text in enumerate(_lines(path), 1)]
    rows = _table(path, [one for one in lines if one[1].strip()], 5, "x y z block volume")
    return rows[:, :3], rows[:, 4], np.arange(1, len(rows) + 1), rows[:, 3].astype(int), None


def _csv(path, volume, style, frame):
    lines = _lines(path)
    names = [name.strip() for name in lines[0].split(",")] if lines else []
    volume = volume or ("volume" if "volume" in names else None)
    for name in ["x", "y"] + ([volume] if volume else []):
        if name not in names:
            _fail(path, f"has no column '{name}', only " + ", ".join(f"'{one}'" for one in names), 1)
    axes = [name for name in ("x", "y", "z") if name in names]
    wanted = axes + [name for name in (volume, "id") if name and name in names]
    columns = {name: [] for name in wanted}
    groups = []
    for number, text in enumerate(lines[1:], 2):
        words = text.split(",")
        if len(words) != len(names):
            _fail(path, f"has {len(words)} columns, the header {len(names)}", number)
        try:
            for name in wanted:
                columns[name].append(float(words[names.index(name)]))
        except ValueError as error:
            _fail(path, str(error), number)
        groups.append(words[names.index("group")].strip() if "group" in names else "")
    x = np.array([columns[name] for name in axes]).T.reshape(-1, len(axes))
    ids = np.array(columns["id"]).astype(int) if "id" in names else np.arange(len(x))
    return x, np.array(columns[volume]) if volume else None, ids, np.array(groups), None


# Columns of LAMMPS data files by atom style: id, type, volume, x, y, z (positions).
_styles = {"atomic": (0, 1, None, 2, 3, 4), "peri": (0, 1, 2, 4, 5, 6)}


def _lammps_data(path, volume, style, frame):
    lines = _lines(path)
    at = next((k for k, text in enumerate(lines) if text.split("#")[0].strip() == "Atoms"), None)
    if at is None:
        _fail(path, "has no section 'Atoms'; give a LAMMPS data file, as write_data writes it")
    said = lines[at].split("#")[1].strip() if "#" in lines[at] else ""
    style = style or said
    if style not in _styles:
        _fail(path, (f"atoms are of style '{style}'" if style else "the style of atoms is not given")
              + "; give style='peri' or style='atomic'", at + 1)
    head = [text.split() for text in lines[:at]]
    n = next((int(words[0]) for words in head if words[1:2] == ["atoms"] and words[0].isdigit()), None)
    rows = []
    for number, text in enumerate(lines[at + 1:], at + 2):
        text = text.split("#")[0]
        if text.strip() and text.split()[0][0].isalpha():
            break  # the next section
        if text.strip():
            rows.append((number, text))
    if n is None or len(rows) != n:
        _fail(path, f"has {len(rows)} atoms, but its header says {n}; the file may be truncated")
    columns = _styles[style]
    values = _table(path, rows, max(c for c in columns if c is not None) + 1,
                    f"atom style {style}")
    volumes = None if columns[2] is None else values[:, columns[2]]
    return (values[:, columns[3]:columns[5] + 1], volumes, values[:, 0].astype(int),
            values[:, 1].astype(int), None)


def _lammps_dump(path, volume, style, frame):
    lines = _lines(path)
    starts = [k for k, text in enumerate(lines) if text.startswith("ITEM: TIMESTEP")]
    if not -len(starts) <= frame < len(starts):
        _fail(path, f"has {len(starts)} frames, so that there is no frame {frame}")
    k = starts[frame]
    n, box = None, None
    while k < len(lines) and not lines[k].startswith("ITEM: ATOMS"):
        if lines[k].startswith("ITEM: NUMBER OF ATOMS") and k + 1 < len(lines):
            n = int(_table(path, [(k + 2, lines[k + 1])], 1, "the number of atoms")[0, 0])
        if lines[k].startswith("ITEM: BOX BOUNDS"):
            box = k
        k += 1
    if k >= len(lines) or n is None:
        _fail(path, "has no ITEM: ATOMS in this frame; the file may be truncated")
    names = lines[k].split()[2:]
    if len(lines) < k + 1 + n:
        _fail(path, f"has {len(lines) - k - 1} of {n} atoms; the file is truncated")
    axes = next((axes for axes in (("x", "y", "z"), ("xs", "ys", "zs"))
                 if all(name in names for name in axes)), None)
    if axes is None:
        _fail(path, "has neither x y z nor xs ys zs; write them by 'dump custom'", k + 1)
    if volume and volume not in names:
        _fail(path, f"has no column '{volume}', only " + " ".join(names), k + 1)
    volume = volume or ("volume" if "volume" in names else None)
    wanted = [name for name in (*axes, volume, "id", "type") if name in names]
    rows = []
    for number, text in enumerate(lines[k + 1:k + 1 + n], k + 2):
        words = text.split()
        if len(words) < len(names):
            _fail(path, f"has {len(words)} columns where ITEM: ATOMS has {len(names)}", number)
        rows.append((number, " ".join(words[names.index(name)] for name in wanted)))
    values = _table(path, rows, len(wanted), "ITEM: ATOMS " + " ".join(wanted))
    column = {name: values[:, i] for i, name in enumerate(wanted)}
    x = np.stack([column[name] for name in axes], axis=1)
    if axes[0] == "xs":
        if box is None or "xy" in lines[box].split():
            _fail(path, "xs ys zs need the bounds of a box that is not triclinic; write x y z", k + 1)
        bounds = _table(path, list(enumerate(lines[box + 1:box + 4], box + 2)), 2, "box bounds")
        x = bounds[:, 0] + x * (bounds[:, 1] - bounds[:, 0])
    ids = column.get("id", np.arange(1, n + 1)).astype(int)
    order = np.argsort(ids, kind="stable")  # LAMMPS writes atoms in any order
    groups = column.get("type", np.ones(n)).astype(int)
    return (x[order], None if volume is None else column[volume][order], ids[order], groups[order],
            None)


# Tetrahedra or triangles that cells consist of, by corners.
_pieces = {"triangle": (2, [(0, 1, 2)]), "quad": (2, [(0, 1, 2), (0, 2, 3)]),
           "tetra": (3, [(0, 1, 2, 3)]),
           "pyramid": (3, [(0, 1, 2, 4), (0, 2, 3, 4)]),
           "wedge": (3, [(0, 1, 2, 3), (1, 2, 3, 4), (2, 3, 4, 5)]),
           "hexahedron": (3, [(0, 1, 3, 4), (1, 2, 3, 6), (1, 3, 4, 6), (3, 4, 6, 7), (1, 4, 5, 6)])}


def _sizes(corners, pieces):
    """Volumes and centroids of cells, shapes (n,) and (n, 3)."""
    total, moment = 0., 0.
    for piece in pieces:
        p = [corners[:, k] for k in piece]
        edges = np.stack([one - p[0] for one in p[1:]], axis=1)
        if len(piece) == 3:
            size = .5 * np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1)
        else:
            size = np.abs(np.linalg.det(edges)) / 6
        total = total + size
        moment = moment + size[:, None] * sum(p) / len(piece)
    return total, moment / np.where(total > 0, total, 1)[:, None]


def _meshio(path, volume, style, frame):
    try:
        import meshio
    except ImportError:
        _fail(path, "needs the Python package meshio (apt-get install python3-meshio)")
    if not path.exists():
        _fail(path, "cannot be read: there is no such file")
    try:
        mesh = meshio.read(path)
    except (Exception, SystemExit) as error:  # meshio raises many kinds, and exits for some
        _fail(path, f"meshio cannot read it: {str(error).strip() or type(error).__name__}; give a whole "
                    "file, or its format")
    points = np.zeros((len(mesh.points), 3))
    points[:, :np.shape(mesh.points)[1]] = mesh.points
    solid = [block for block in mesh.cells if block.type not in ("vertex", "line", "line3")]
    if not solid:
        names = sorted(mesh.point_data)
        if volume and volume not in names:
            _fail(path, f"has no point data '{volume}', only " + ", ".join(names))
        of = volume or ("volume" if "volume" in names else None)
        volumes = None if of is None else np.asarray(mesh.point_data[of], float).ravel()
        n = len(points)
        return points, volumes, np.arange(n), np.zeros(n, int), None
    if volume:
        _fail(path, f"has cells, whose volumes are known; leave volume = '{volume}' out")
    for block in solid:
        if block.type not in _pieces:
            _fail(path, f"has cells of type '{block.type}'; choose linear cells: " + ", ".join(_pieces))
    highest = max(_pieces[block.type][0] for block in solid)
    places, volumes, groups = [], [], []
    data = {name: mesh.cell_data[name] for name in ("gmsh:physical", "ElementBlockIds", "group")
            if name in mesh.cell_data}
    for k, block in enumerate(mesh.cells):
        if block.type not in _pieces or _pieces[block.type][0] != highest:
            continue  # sides of the body
        size, centroid = _sizes(points[np.asarray(block.data)], _pieces[block.type][1])
        places.append(centroid)
        volumes.append(size)
        of = next(iter(data.values()), None)
        groups.append(np.asarray(of[k]) if of is not None else np.full(len(size), k))
    x = np.concatenate(places)
    return x, np.concatenate(volumes), np.arange(len(x)), np.concatenate(groups), highest


_readers = {"lammps data": _lammps_data, "lammps dump": _lammps_dump, "peridigm": _peridigm,
            "csv": _csv, "meshio": _meshio}

# The arguments of read_nodes that a format uses.
_arguments = {"lammps data": ("style",), "lammps dump": ("volume", "frame"), "peridigm": (),
              "csv": ("volume",), "meshio": ("volume",)}
