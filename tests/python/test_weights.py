"""Weights in arrays have the moments that the rules promise."""
import os
import subprocess

import numpy as np
import pytest
from conftest import lattice

import plumbline

H = 1 / 16
KERNEL = plumbline.Kernel("linear-decay", horizon=3 * H, diffusion=.5)


def moment(w, alpha, kernel=KERNEL):
    """Sum of w C(points) xi^alpha, for each node."""
    terms = w.w * kernel(w.points) * w.xi[:, 0]**alpha[0] * w.xi[:, 1]**alpha[1]
    return terms.sum() if w.i is None else np.bincount(w.i, terms)[np.unique(w.i)]


def test_kernel_has_the_moments_of_its_limit():
    # scaled to -D Laplace: the second moment is 2 D
    assert KERNEL.moment((2, 0)) == pytest.approx(1, rel=1e-14)
    assert KERNEL.moment((1, 0)) == 0
    assert KERNEL.limit == {"diffusion": pytest.approx(.5, rel=1e-14)}
    # against the integral in polar coordinates, 2 pi c int (1 - r/horizon) r dr = pi c horizon^2 / 3
    assert KERNEL.moment((0, 0)) == pytest.approx(np.pi * KERNEL.constant * (3 * H)**2 / 3)


def test_kernel_values_are_radial_and_vanish_beyond_the_horizon():
    xi = np.array([[H, 0], [0, H], [2 * H, H], [4 * H, 0]])
    r = np.linalg.norm(xi, axis=1)
    expected = KERNEL.constant * np.maximum(0, 1 - r / (3 * H))
    assert KERNEL(xi) == pytest.approx(expected, rel=1e-13)


def test_tensor_kernel_is_c_over_r_times_the_direction():
    kernel = plumbline.Kernel("bond-tensor", .3, bulk_modulus=2)
    assert kernel.is_tensor and kernel.n_components == 2
    values = kernel([[.1, 0], [0, .1], [.1, .1]])
    assert values.shape == (3, 2, 2)
    assert values[0, 1, 1] == 0 and values[1, 0, 0] == 0 and values[2, 0, 1] == values[2, 0, 0] > 0
    assert kernel.limit == {"lambda": pytest.approx(1.2), "mu": pytest.approx(1.2)}


def test_full_area_on_a_lattice_is_the_nodes_in_the_ball():
    w = plumbline.weights("FA", KERNEL, H)
    assert len(w.w) == 28 and np.all(w.w == H * H)  # lattice points with 0 < i^2 + j^2 <= 9
    assert np.array_equal(w.offsets * H, w.xi) and np.array_equal(w.points, w.xi)
    assert sorted(map(tuple, w.offsets)) == sorted(
        (i, j) for i in range(-3, 4) for j in range(-3, 4) if 0 < i * i + j * j <= 9)


def test_partial_areas_add_up_to_the_ball_without_the_own_cell():
    w = plumbline.weights("PA-AC", KERNEL, H)
    assert w.w.sum() == pytest.approx(np.pi * (3 * H)**2 - H * H, rel=1e-13)


@pytest.mark.parametrize("rule, degree", [("IPA-AC-R2", 2), ("IPA-AC-R4", 4)])
def test_recalibrated_weights_have_exact_moments(rule, degree, square):
    alphas = [(a, d - a) for d in range(1, degree + 1) for a in range(d + 1)]
    jittered = lattice(16, 3)
    jittered += np.random.default_rng(1).uniform(-.2, .2, jittered.shape) * H
    for w in (plumbline.weights(rule, KERNEL, H),
              plumbline.weights(rule, KERNEL, nodes=jittered, boxes=square, h=H)):
        for alpha in alphas:
            exact = KERNEL.moment(alpha)
            size = (3 * H)**(sum(alpha) - 2)
            assert np.max(np.abs(moment(w, alpha) - exact)) < 1e-11 * size, alpha
    # and a rule without recalibration has not
    assert abs(moment(plumbline.weights("IPA-AC", KERNEL, H), (2, 0)) - 1) > 1e-3


def test_bonds_of_nodes_go_from_free_nodes_in_the_users_numbers(square):
    nodes = lattice(16, 3)[::-1].copy()
    w = plumbline.weights("FA", KERNEL, nodes=nodes, boxes=square)
    assert np.array_equal(np.unique(w.i), np.flatnonzero(np.all((nodes > 0) & (nodes < 1), axis=1)))
    assert nodes[w.j] - nodes[w.i] == pytest.approx(w.xi, abs=1e-15)
    assert np.all(np.bincount(w.i)[np.unique(w.i)] == 28)


def test_given_volumes_are_the_weights_of_full_area(square):
    nodes = lattice(16, 3)
    volumes = np.random.default_rng(2).uniform(.5, 2, len(nodes)) * H * H
    w = plumbline.weights("FA", KERNEL, nodes=nodes, volumes=volumes, boxes=square)
    assert np.array_equal(w.w, volumes[w.j])


def test_a_rule_in_python_is_the_same_rule():
    mine = plumbline.Rule("mine", lambda xi, area: area)
    a, b = plumbline.weights(mine, KERNEL, H), plumbline.weights("FA", KERNEL, H)
    assert np.array_equal(a.w, b.w) and np.array_equal(a.xi, b.xi)
    partial = plumbline.Rule("partial", lambda xi, area: area, partial=True)
    a, b = plumbline.weights(partial, KERNEL, H), plumbline.weights("IPA-AC", KERNEL, H)
    assert np.array_equal(a.w, b.w) and np.array_equal(a.points, b.points)


def test_a_rule_in_python_can_leave_out_bonds_and_move_points():
    half = plumbline.Rule("half", lambda xi, area: (np.where(xi[:, 0] > 0, area, 0), xi / 2))
    w = plumbline.weights(half, KERNEL, H)
    assert np.all(w.xi[:, 0] > 0) and len(w.w) == 11 and np.array_equal(w.points, w.xi / 2)


def test_saved_weights_are_read_by_the_command(root, tmp_path, square):
    nodes = lattice(16, 3)
    w = plumbline.weights("IPA-AC-R2", KERNEL, nodes=nodes, boxes=square)
    w.save(tmp_path / "nodes.csv", tmp_path / "bonds.csv", nodes, np.full(len(nodes), H**2))
    (tmp_path / "scene.prm").write_text("subsection Kernel\n set type = linear-decay\nend\n"
                                        "subsection Study\n set m = 3\n set h = 0.0625\nend\n"
                                        "subsection Problem\n set solution = x*y\nend\n"
                                        "subsection Methods\n set names = FA\nend\n")
    ended = subprocess.run([os.environ["PLUMBLINE_COMMAND"], "check", "nodes.csv", "bonds.csv",
                            "--scene", "scene.prm"], cwd=tmp_path, capture_output=True, text=True)
    assert ended.returncode == 0, ended.stdout + ended.stderr
    assert "the weights are those of IPA-AC-R2" in ended.stdout
    found = np.loadtxt(tmp_path / "bonds.csv", delimiter=",", skiprows=1)
    np.testing.assert_array_equal(found, np.column_stack([w.i, w.j, w.w, w.points]))
    with pytest.raises(plumbline.InputError, match="one family on a lattice"):
        plumbline.weights("FA", KERNEL, H).save("a", "b", nodes, nodes[:, 0])
    with pytest.raises(plumbline.InputError, match="give .n, 2. and .n,."):
        w.save("a", "b", nodes, nodes)
