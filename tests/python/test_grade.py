"""Grades are those of the command, from arrays."""
import json
import os
import subprocess

import numpy as np
import pytest

import plumbline


@pytest.fixture
def file(root):
    return root / "scenes" / "certified" / "NLB_01.certificate.json"


def certified(file):
    points = json.loads(file.read_text())["points"]
    return np.array([one["x"] for one in points]), np.array([one["value"][0] for one in points])


def test_values_are_graded_in_any_order(file):
    points, values = certified(file)
    order = np.arange(len(points))[::-1]
    found = plumbline.grade(points[order], values[order] * 1.01, file)
    grade, = found["grades"]
    assert grade["rms"] == pytest.approx(.01, rel=1e-9)
    assert not grade["is_at_least"]
    exact, = plumbline.grade(points, values, file)["grades"]
    assert exact["is_at_least"] and exact["digits"] >= 6
    assert found["limit"] == "cannot be decided"


def test_a_series_has_an_order_and_a_limit(file):
    points, values = certified(file)
    h = [.1, .05, .025]
    second = plumbline.grade(points, [values + one**2 for one in h], file, h=h)
    assert second["order"] == pytest.approx(2, abs=1e-3)
    assert second["limit"] == "converges to the certified solution"
    biased = plumbline.grade(points, [values * 1.05 + one**2 for one in h], file, h=h)
    assert biased["limit"] == "converges to another limit"
    assert biased["limit_distance"] == pytest.approx(.05, rel=.01)


def test_problems_are_known_by_name(file, tmp_path):
    names = plumbline.certified_problems()
    assert names[:2] == ["NLB-01", "NLB-02"]
    problem = plumbline.certified_problem("nlb_01")
    points, values = certified(file)
    assert np.array_equal(problem["points"], points) and np.array_equal(problem["values"], values)
    assert problem["digits"] >= 8 and "sin(3*x)*cos(2*y)" in problem["scene"]
    by_name = plumbline.grade(points, values * 1.01, "NLB-01")
    assert by_name["grades"][0]["rms"] == pytest.approx(.01, rel=1e-9)
    mine = tmp_path / "mine.csv"
    np.savetxt(mine, np.column_stack([points, values * 1.01]), delimiter=",", header="x,y,u", comments="")
    by_file = plumbline.grade(mine, problem="NLB-01")
    assert by_file["grades"][0]["rms"] == pytest.approx(by_name["grades"][0]["rms"], rel=1e-9)
    assert [rule["method"] for rule in by_file["rules"]][0] == "IPA-AC-R4"
    with pytest.raises(plumbline.InputError, match="NLB-00.*choose one of NLB-01"):
        plumbline.grade(mine, problem="NLB-00")
    with pytest.raises(plumbline.InputError, match="problem is missing"):
        plumbline.grade(mine)
    with pytest.raises(plumbline.InputError, match="values is missing"):
        plumbline.grade(points, problem="NLB-01")


def test_points_on_a_line_are_numbers():
    problem = plumbline.certified_problem("NLB-21")
    points, values = problem["points"], problem["values"]
    assert points.shape == (len(values), 1)
    for given in points, points[:, 0]:
        assert plumbline.grade(given, values * 1.01, "NLB-21")["grades"][0]["rms"] == pytest.approx(.01, rel=1e-9)
    with pytest.raises(plumbline.InputError, match="give 1 coordinate for each of"):
        plumbline.grade(np.hstack([points, points]), values, "NLB-21")


def test_a_changed_certificate_is_refused(file, tmp_path):
    text = json.loads(file.read_text())
    text["scene_text"] += " "
    changed = tmp_path / "changed.json"
    changed.write_text(json.dumps(text))
    points, values = certified(file)
    with pytest.raises(plumbline.InputError, match="sha256 is not that of its scene_text"):
        plumbline.grade(points, values, changed)


def test_other_points_are_refused(file):
    points, values = certified(file)
    with pytest.raises(plumbline.InputError, match="row 0 is not a point of the certificate"):
        plumbline.grade(points + 1e-3, values, file)
    with pytest.raises(plumbline.InputError, match="give all of them"):
        plumbline.grade(points[1:], values[1:], file)
    with pytest.raises(plumbline.InputError, match="shape"):
        plumbline.grade(points, values[1:], file)
    vectors = file.with_name("NLB_03.certificate.json")
    of_vectors = json.loads(vectors.read_text())["points"]
    points = np.array([one["x"] for one in of_vectors])
    values = np.array([one["value"] for one in of_vectors])
    assert plumbline.grade(points, values, vectors)["grades"][0]["is_at_least"]
    with pytest.raises(plumbline.InputError, match="shape"):
        plumbline.grade(points, values.T, vectors)
    with pytest.raises(plumbline.InputError, match="h must"):
        plumbline.grade(points, [values] * 3, vectors, h=[np.inf, .1, .05])


SCENE = """
set Kernel/type = constant
set Problem/solution = sin(3*x)*cos(2*y)
set Methods/names = PA-AC
set Study/regime = m
set Study/horizon = 0.25
set Study/h = 1/8, 1/16, 1/32
set Reference/method = Q2
"""


def test_a_scene_is_certified_as_by_the_command(root, tmp_path):
    points = tmp_path / "points.csv"
    points.write_text("x,y\n0.1,0.2\n0.5,0.5\n0.31,0.73\n0.9,0.4\n")
    scene = tmp_path / "scene.prm"
    scene.write_text(SCENE + f"set Output/points = {points}\n")
    file = tmp_path / "ours.json"
    found = plumbline.certify(scene, reference_level=2, file=file)
    for one in found["points"]:
        exact = np.sin(3 * one["x"][0]) * np.cos(2 * one["x"][1])
        assert abs(one["value"][0] - exact) <= one["bound"] < 1e-2
    values = [one["value"][0] for one in found["points"]]
    grade, = plumbline.grade([one["x"] for one in found["points"]], values, file)["grades"]
    assert grade["is_at_least"]
    if "PLUMBLINE_COMMAND" in os.environ:  # the same bytes
        subprocess.run([os.environ["PLUMBLINE_COMMAND"], "certify", scene, "--reference-level", "2", "--quiet", "-o", tmp_path / "out"],
                       check=True)
        assert (tmp_path / "out" / "certificate.json").read_bytes() == file.read_bytes()
    with pytest.raises(plumbline.NumericalError, match="nothing is certified"):
        plumbline.certify(scene, methods=["GFD"], reference_level=2)
    with pytest.raises(plumbline.InputError, match="Output/points"):
        plumbline.certify(SCENE)
