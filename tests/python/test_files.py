"""Nodes of other programs' files: as those programs write them, and broken."""
import shutil
import subprocess

import numpy as np
import pytest
from conftest import lattice

import plumbline

H = 1 / 8
IN_SPACE = np.stack([a.ravel() for a in np.meshgrid(*3 * [(np.arange(4) + .5) * H], indexing="ij")], axis=-1)


def sorted_rows(x):
    return x[np.lexsort(x.T)]


@pytest.fixture
def lammps(tmp_path):
    """Files that LAMMPS itself writes of a cube of 4 x 4 x 4 atoms."""
    if shutil.which("lmp") is None:
        pytest.skip("LAMMPS is not installed")
    (tmp_path / "in.lmp").write_text(f"""units si
boundary s s s
atom_style peri
atom_modify map array
neighbor 0.01 bin
lattice sc {H} origin 0.5 0.5 0.5
region all block 0 3.9 0 3.9 0 3.9
create_box 1 all
create_atoms 1 region all
pair_style peri/pmb
pair_coeff * * 1.0 {2.1 * H} 1e9 0.25
set group all density 1
set group all volume {H ** 3}
run 0
write_data cube.data
write_dump all custom cube.dump id type x y z
""")
    subprocess.run(["lmp", "-in", "in.lmp", "-log", "none"], cwd=tmp_path, check=True,
                   stdout=subprocess.DEVNULL)
    return tmp_path


def test_lammps_data_and_dump_give_its_atoms(lammps):
    data = plumbline.read_nodes(lammps / "cube.data")
    assert np.allclose(sorted_rows(data.nodes), sorted_rows(IN_SPACE), atol=1e-12)
    assert np.allclose(data.volumes, H ** 3, rtol=1e-12) and sorted(data.ids) == list(range(1, 65))
    dump = plumbline.read_nodes(lammps / "cube.dump")
    order = np.argsort(data.ids)
    assert np.allclose(dump.nodes, data.nodes[order], atol=1e-6)  # LAMMPS writes six digits
    assert dump.volumes is None and np.array_equal(dump.ids, data.ids[order])


def test_truncated_lammps_files_are_refused(lammps):
    for name, reason in [("cube.data", "atoms, but its header says 64"), ("cube.dump", "is truncated")]:
        text = (lammps / name).read_text().splitlines()
        start = next(k for k, line in enumerate(text) if "Atoms" in line or "ITEM: ATOMS" in line)
        short = lammps / ("short_" + name)
        short.write_text("\n".join(text[:start + 20]))
        with pytest.raises(plumbline.InputError, match=reason):
            plumbline.read_nodes(short)
        broken = lammps / ("broken_" + name)
        broken.write_text("\n".join(text[:start + 3] + ["1 1 x"] + text[start + 4:]))
        with pytest.raises(plumbline.InputError, match=f"line {start + 4}"):
            plumbline.read_nodes(broken)


def test_nodes_of_peridigm_and_csv_are_checked(tmp_path, square):
    n = 16
    nodes = lattice(n, 3)
    volumes = np.full(len(nodes), 1 / n ** 2)
    np.savetxt(tmp_path / "nodes.txt", np.column_stack(
        [nodes, np.zeros(len(nodes)), np.ones(len(nodes), int), volumes]), header="x y z block volume")
    np.savetxt(tmp_path / "nodes.csv", np.column_stack([np.arange(len(nodes)), nodes, volumes]),
               delimiter=",", header="id,x,y,volume", comments="")
    kernel = plumbline.Kernel("linear-decay", horizon=3 / n, diffusion=.5)
    for name in ("nodes.txt", "nodes.csv"):
        read = plumbline.read_nodes(tmp_path / name)
        assert np.array_equal(read.nodes, nodes) and np.array_equal(read.volumes, volumes)
        w = plumbline.weights("IPA-AC-R2", kernel, nodes=read.nodes, volumes=read.volumes, boxes=square)
        points = None if np.array_equal(w.points, w.xi) else w.points
        assert plumbline.check(read.nodes, read.volumes, w.i, w.j, w.w, kernel, boxes=square,
                               points=points).passed
    assert plumbline.read_nodes(tmp_path / "nodes.txt", dimension=3).nodes.shape == (len(nodes), 3)


def test_cells_of_a_gmsh_mesh_become_nodes(tmp_path):
    pytest.importorskip("meshio")
    if shutil.which("gmsh") is None:
        pytest.skip("gmsh is not installed")
    (tmp_path / "ball.geo").write_text('SetFactory("OpenCASCADE"); Sphere(1) = {0, 0, 0, 1}; '
                                       "Mesh.MeshSizeMax = .25; Physical Volume(7) = {1};\n")
    subprocess.run(["gmsh", "-3", "-format", "msh22", "ball.geo"], cwd=tmp_path, check=True,
                   stdout=subprocess.DEVNULL)
    read = plumbline.read_nodes(tmp_path / "ball.msh")
    ball = 4 * np.pi / 3
    assert .95 * ball < np.sum(read.volumes) < ball and set(read.groups) == {7}
    assert np.max(np.linalg.norm(read.nodes, axis=1)) < 1
    assert abs(read.volumes @ read.nodes[:, 0]) < 1e-2


@pytest.mark.parametrize("ending", ["vtu", "vtk", "inp", "msh", "e"])
def test_cells_of_all_kinds_have_their_volumes(tmp_path, ending):
    meshio = pytest.importorskip("meshio")
    points = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1],
                       [0, 1, 1], [2, 0, 0], [2, 0, 1], [0, 2, 0]], float)
    cells = [("hexahedron", np.array([[0, 1, 2, 3, 4, 5, 6, 7]])),
             ("wedge", np.array([[1, 8, 2, 5, 9, 6]])), ("tetra", np.array([[3, 2, 10, 7]]))]
    file = tmp_path / ("cells." + ending)
    meshio.write_points_cells(file, points, cells)
    read = plumbline.read_nodes(file)
    assert np.allclose(read.volumes, [1, .5, 1 / 6], rtol=1e-6)
    assert np.allclose(read.nodes, [[.5, .5, .5], [4 / 3, 1 / 3, .5], [.25, 1.25, .25]], atol=1e-6)


def test_points_without_cells_are_nodes(tmp_path):
    meshio = pytest.importorskip("meshio")
    cells = [("vertex", np.arange(len(IN_SPACE))[:, None])]
    meshio.Mesh(IN_SPACE, cells, point_data={"V": np.full(len(IN_SPACE), H ** 3)}).write(tmp_path / "p.vtu")
    read = plumbline.read_nodes(tmp_path / "p.vtu", volume="V")
    assert np.allclose(read.nodes, IN_SPACE) and np.allclose(read.volumes, H ** 3)
    assert plumbline.read_nodes(tmp_path / "p.vtu").volumes is None
    with pytest.raises(plumbline.InputError, match="no point data 'W', only V"):
        plumbline.read_nodes(tmp_path / "p.vtu", volume="W")


def test_triclinic_boxes_and_columns_of_text_are_read(tmp_path):
    head = ("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS xy xz yz pp pp pp\n"
            "0 1 0.1\n0 1 0\n0 1 0\n")
    (tmp_path / "a.dump").write_text(head + "ITEM: ATOMS id element x y z\n2 C 1 2 3\n1 H 4 5 6\n")
    read = plumbline.read_nodes(tmp_path / "a.dump")
    assert np.array_equal(read.nodes, [[4, 5, 6], [1, 2, 3]]) and list(read.ids) == [1, 2]
    (tmp_path / "a.dump").write_text(head + "ITEM: ATOMS id xs ys zs\n2 0 0 0\n1 1 1 1\n")
    with pytest.raises(plumbline.InputError, match="triclinic; write x y z"):
        plumbline.read_nodes(tmp_path / "a.dump")


def test_surfaces_in_space_are_refused_and_single_cells_are_solid(tmp_path):
    meshio = pytest.importorskip("meshio")
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
    meshio.write_points_cells(tmp_path / "s.vtu", points, [("triangle", np.array([[0, 1, 2], [0, 1, 3]]))])
    with pytest.raises(plumbline.InputError, match="surface in space"):
        plumbline.read_nodes(tmp_path / "s.vtu")
    meshio.write_points_cells(tmp_path / "t.vtu", points, [("tetra", np.array([[0, 1, 2, 3]]))])
    read = plumbline.read_nodes(tmp_path / "t.vtu")
    assert read.nodes.shape == (1, 3) and np.allclose(read.volumes, 1 / 6)
    with pytest.raises(plumbline.InputError, match="has cells, whose volumes are known"):
        plumbline.read_nodes(tmp_path / "t.vtu", volume="V")


@pytest.mark.parametrize("name, text, given, reason", [
    ("a.txt", "0 0 0 1 1\n", {"style": "peri"}, "style = 'peri' is not used by files of the format 'peridigm'"),
    ("a.txt", "0 0 0 1\n", {}, "line 1: has 4 columns where x y z block volume needs 5"),
    ("a.txt", "# none\n", {}, "has no nodes"),
    ("a.txt", "0 0 0 1 1\n1 0 0 1 -2\n", {}, "node 2 has the volume -2; all must be above 0"),
    ("a.txt", "0 0 nan 1 1\n", {}, "coordinate that is not finite"),
    ("a.csv", "x,volume\n0,1\n", {}, "line 1: has no column 'y'"),
    ("a.csv", "x,y\n0\n", {}, "line 2: has 1 columns, the header 2"),
    ("a.data", "made by hand\n\n1 atoms\n\nAtoms\n\n1 1 0 0 0\n", {}, "line 5: the style of atoms is not given"),
    ("a.data", "2 atoms\n\nAtoms # full\n\n1 1 0 0 0\n", {}, "atoms are of style 'full'; give style='peri'"),
    ("a.txt", "0 0 0 1 1\n0 0 1 1 1\n", {"dimension": 2}, "z is not the same for all nodes"),
    ("a.txt", "0 0 0 1 1\n", {"format": "exodus"}, "format = 'exodus' is not known; choose one of 'lammps data'"),
    ("a.dump", "ITEM: TIMESTEP\n0\n", {"frame": 2}, "has 1 frames, so that there is no frame 2"),
])
def test_bad_files_are_refused_with_the_place(tmp_path, name, text, given, reason):
    (tmp_path / name).write_text(text)
    with pytest.raises(plumbline.InputError) as caught:
        plumbline.read_nodes(tmp_path / name, **given)
    assert reason in str(caught.value)


def test_files_that_are_missing_or_of_no_mesh_are_refused(tmp_path):
    with pytest.raises(plumbline.InputError, match="no such file|cannot be read"):
        plumbline.read_nodes(tmp_path / "none.txt")
    pytest.importorskip("meshio")
    (tmp_path / "no.vtu").write_text("<VTKFile")
    with pytest.raises(plumbline.InputError, match="meshio cannot read it"):
        plumbline.read_nodes(tmp_path / "no.vtu")


def test_solutions_become_meshes_of_meshio(tmp_path):
    meshio = pytest.importorskip("meshio")
    kernel = plumbline.Kernel("linear-decay", horizon=3 / 8, diffusion=.5)
    problem = plumbline.Problem(kernel, boxes=((0, 0), (1, 1)), h=1 / 8, solution="1 + 2*x*y")
    for method, kind, n in (("Q1", "quad", 64), ("IPA-AC-R2", "vertex", 64)):
        solution = plumbline.solve(problem, method)
        mesh = plumbline.to_meshio(solution)
        assert [(block.type, len(block.data)) for block in mesh.cells] == [(kind, n)]
        x, y = mesh.points.T[:2]
        assert np.allclose(mesh.point_data["u"], 1 + 2 * x * y, atol=1e-10)
        mesh.write(tmp_path / "u.vtk")
        assert np.array_equal(meshio.read(tmp_path / "u.vtk").point_data["u"], mesh.point_data["u"])


def test_solutions_in_space_become_cubes_of_meshio():
    pytest.importorskip("meshio")
    space = plumbline.space
    kernel = space.Kernel("linear-decay", 1 / 2, diffusion=.5)
    problem = space.Problem(kernel, box=((1, 0, 0), (2, 1, 1)), h=1 / 4, solution="x + 2*y - z")
    solution = space.solve(problem, "IPA-AC-R2")
    mesh = plumbline.to_meshio(solution)
    (block,), (averages,) = mesh.cells, mesh.cell_data["average of u"]
    corners = mesh.points[block.data]
    assert block.type == "hexahedron" and corners.shape == (64, 8, 3) and len(mesh.points) == 125
    assert np.allclose(corners.mean(axis=1), solution.cells)
    assert np.allclose(averages, corners.mean(axis=1) @ [1, 2, -1], atol=1e-9)
    # VTK's order of corners: the volume by three edges is positive
    edges = corners[:, [1, 3, 4]] - corners[:, :1]
    assert np.allclose(np.linalg.det(edges), 1 / 64)
