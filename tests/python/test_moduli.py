"""Elastic constants are those of the command, to the last bit."""
import json
import os
import subprocess

import numpy as np
import pytest
from conftest import lattice

import plumbline


def command(root, *arguments):
    ended = subprocess.run([os.environ["PLUMBLINE_COMMAND"], "moduli", "--json", *arguments],
                           cwd=root, capture_output=True, text=True)
    assert ended.returncode == 0, ended.stderr
    return json.loads(ended.stdout)["records"]


@pytest.mark.parametrize("state", ["plane stress", "plane strain", "3D"])
def test_moduli_are_those_of_the_command(root, state):
    ours = plumbline.moduli(["FA", "IPA-AC-R2"], m=[2, 3.015], E=200, state=state).records
    theirs = command(root, "--state", state, "--rules", "FA,IPA-AC-R2", "--m", "2,3.015", "--E",
                     "200")
    assert len(ours) == 4
    assert [one["scalars"] for one in ours] == [one["scalars"] for one in theirs]


def test_full_area_in_plane_stress_is_the_hand_calculation():
    record, = plumbline.moduli("FA", m=3.015, E=200, state="plane stress").records
    assert record["E"] == pytest.approx(209.7, abs=.05)
    assert record["nu"] == pytest.approx(.318, abs=.0005)
    assert record["shear along axes"] == pytest.approx(74.3, abs=.05)
    assert record["shear across axes"] == pytest.approx(79.5, abs=.06)


@pytest.mark.parametrize("rule", ["FA", "IPA-AC-R2"])
def test_weights_have_the_moduli_of_their_rule(rule):
    m, E = 3.015, 200.
    kernel = plumbline.Kernel("bond-tensor", m, bulk_modulus=5 * (3 * E / 8) / 3)
    record, = plumbline.moduli(rule, m=m, E=E, state="plane stress").records
    w = plumbline.weights(rule, kernel, 1)
    found = plumbline.moduli_of_weights(kernel, w.w, w.xi, points=w.points, state="plane stress")
    for name in ("C1111", "C1122", "C1212", "E", "nu", "shear along axes", "anisotropy"):
        assert found[name].shape == (1,) and found[name][0] == record[name], name


def test_weights_of_nodes_have_moduli_for_each_node(square):
    kernel = plumbline.Kernel("bond-tensor", 3 / 8, bulk_modulus=5 / 8)
    nodes = lattice(8, 3)
    w = plumbline.weights("IPA-AC-R2", kernel, nodes=nodes, boxes=square)
    order = np.random.default_rng(0).permutation(len(w.w))
    found = plumbline.moduli_of_weights(kernel, w.w[order], w.xi[order], i=w.i[order],
                                        points=w.points[order], state="plane stress")
    assert np.array_equal(found["nodes"], np.unique(w.i)) and len(found["E"]) == 64
    assert found["E"] == pytest.approx(np.ones(64), rel=1e-11)
    assert found["nu"] == pytest.approx(np.full(64, 1 / 3), rel=1e-11)


def test_a_rule_in_python_has_moduli():
    mine = plumbline.Rule("mine", lambda xi, area: area)
    ours, full = plumbline.moduli([mine, "FA"], m=3).records
    assert ours["key"]["method"] == "mine" and ours["scalars"] == full["scalars"]
    with pytest.raises(plumbline.InputError, match="rule 'mine' is made for the plane"):
        plumbline.moduli(mine, m=3, state="3D")


@pytest.mark.parametrize("words, action", [
    ("^rules: 'FB' is not known", lambda: plumbline.moduli("FB")),
    ("^state: 'flat' is not known", lambda: plumbline.moduli("FA", state="flat")),
    ("^m: horizon / h = 0.5", lambda: plumbline.moduli("FA", m=.5)),
    ("^E: Young's modulus is -1", lambda: plumbline.moduli("FA", E=-1)),
    ("^kernel: 'constant' has no elastic", lambda: plumbline.moduli("FA", kernel="constant")),
    ("w has the shape", lambda: plumbline.moduli_of_weights(
        plumbline.Kernel("bond-tensor", 3), [1, 2], [[1, 0]])),
    ("bond 0 has the weight", lambda: plumbline.moduli_of_weights(
        plumbline.Kernel("bond-tensor", 3), [np.nan], [[1, 0]])),
    ("scalar", lambda: plumbline.moduli_of_weights(
        plumbline.Kernel("constant", 3), [1], [[1, 0]])),
])
def test_wrong_arguments_are_refused(words, action):
    with pytest.raises(plumbline.InputError, match=words):
        action()
