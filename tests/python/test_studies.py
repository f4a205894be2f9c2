"""Studies of scenes give the command's numbers, to the last bit."""
import _thread
import json
import os
import subprocess
import threading
import time

import numpy as np
import pytest

import plumbline

SCENE = "scenes/ipa_ac/constant_kernel.prm"


def command(root, tmp_path, *arguments):
    ended = subprocess.run([os.environ["PLUMBLINE_COMMAND"], *arguments, "--json", "-o",
                            str(tmp_path)], cwd=root, capture_output=True, text=True)
    assert ended.returncode == 0, ended.stderr
    return json.loads(ended.stdout)


def without_times(value):
    """What is measured anew in each run: time and memory."""
    if isinstance(value, dict):
        return {key: without_times(one) for key, one in value.items()
                if key not in ("cost", "setup_seconds", "solve_seconds", "peak_bytes",
                               "factor seconds", "update seconds")}
    if isinstance(value, (list, np.ndarray)):
        return [without_times(one) for one in value]
    if isinstance(value, float) and np.isnan(value):
        return None
    return value


def test_run_gives_the_commands_numbers(root, tmp_path):
    study = plumbline.run(root / SCENE, levels=3, methods=["FA", "IPA-AC-R2", "Q1"])
    said = command(root, tmp_path, "run", SCENE, "--levels", "3", "--methods", "FA,IPA-AC-R2,Q1")
    assert len(study.records) == 9 and len(study["trends"]) == len(said["trends"]) > 0
    assert without_times(study["records"]) == without_times(said["records"])
    assert without_times(study["trends"]) == without_times(said["trends"])


@pytest.mark.parametrize("analysis", ["stability", "dispersion"])
def test_analyses_give_the_commands_records(root, tmp_path, analysis):
    study = getattr(plumbline, analysis)(root / SCENE, levels=2, methods=["FA", "Q1"])
    said = command(root, tmp_path, analysis, SCENE, "--levels", "2", "--methods", "FA,Q1")
    assert without_times(study["records"]) == without_times(said["records"])
    record = study.records[0]
    name = next(iter(record["scalars"]))
    assert record[name] == record["scalars"][name]["value"]
    assert all(isinstance(column["values"], np.ndarray)
               for one in study.records for curve in one["curves"].values() for column in curve)


PLATE = {"Study/h": "1/16", "Study/m": "2"}


@pytest.mark.parametrize("analysis, scene, set", [
    ("grow", "scenes/fracture/plate.prm", PLATE),
    ("crack", "scenes/griffith/speed.prm", {"Time/final time": "0.3"}),
    ("strip", "scenes/fracture/strip.prm", {"Methods/names": "FA, DGQ0"})])
def test_fracture_gives_the_commands_records(root, tmp_path, analysis, scene, set):
    levels = {} if analysis == "grow" else {"levels": 1}
    study = getattr(plumbline, analysis)(root / scene, set=set, **levels)
    said = command(root, tmp_path, analysis, scene, *(["--levels", "1"] if levels else []),
                   *(word for key, value in set.items() for word in ("--set", f"{key}={value}")))
    assert len(study.records) > 0 and not any(one["failure"] for one in study.records)
    assert without_times(study["records"]) == without_times(said["records"])


def test_growth_goes_on_from_its_folder(root, tmp_path):
    """After an interrupt, to the same bits; the folder is empty in the end."""
    scene, set = root / "scenes/fracture/plate.prm", {**PLATE, "Fracture/checkpoint interval": "1"}
    whole, = plumbline.grow(scene, set=set).records
    for share in .5, .25, 1, 2, 4:  # on a busy machine it may not have begun yet, or have ended
        timer = threading.Timer(share * whole["cost"]["solve_seconds"], _thread.interrupt_main)
        timer.start()
        with pytest.raises(KeyboardInterrupt):
            plumbline.grow(scene, set=set, folder=tmp_path)
            time.sleep(10)
        if (tmp_path / "checkpoint.h5").exists():
            break
    assert (tmp_path / "checkpoint.h5").exists()
    after, = plumbline.grow(scene, set=set, folder=tmp_path).records
    assert after["resumed"] > 0 and after["events"] == whole["events"]
    for name, curve in whole["curves"].items():
        for column, other in zip(curve, after["curves"][name]):
            np.testing.assert_array_equal(column["values"], other["values"])
    assert list(tmp_path.iterdir()) == []


def test_fracture_needs_a_method_with_bonds(root):
    mine = plumbline.Rule("mine", lambda xi, area: area)
    with pytest.raises(ValueError, match="'mine' is a rule in Python"):
        plumbline.grow(root / "scenes/fracture/plate.prm", methods=[mine])
    with pytest.raises(ValueError, match="plumbline.grow"):
        plumbline.run(root / "scenes/fracture/plate.prm")
    with pytest.raises(ValueError, match="Fracture/toughness"):
        plumbline.grow(root / SCENE)


def test_dispersion_in_space_takes_directions(root, tmp_path):
    scene = "scenes/three_d/tensor_delta_convergence.prm"
    study = plumbline.dispersion(root / scene, directions=[(0, 0, 1), (1, 1, 0)], levels=1,
                                 methods="FA")
    said = command(root, tmp_path, "dispersion", scene, "--directions", "0,0,1,1,1,0", "--levels",
                   "1", "--methods", "FA")
    assert without_times(study["records"]) == without_times(said["records"])
    assert "T2 waves along (0, 0, 1): phase speed" in study.records[0]["scalars"]
    with pytest.raises(ValueError, match="--directions"):
        plumbline.dispersion(root / scene, angles=[45], levels=1)


def test_a_problem_of_a_scene_is_the_studys(root):
    u = plumbline.solve(plumbline.Problem.of_scene(str(root / SCENE), level=1), "IPA-AC")
    run, = plumbline.run(root / SCENE, levels=2, methods="IPA-AC").records[1:]
    exact = np.sin(3 * u.nodes[:, 0]) * np.cos(2 * u.nodes[:, 1])
    assert run["key"]["h"] == .0625
    found = np.max(np.abs(u.values - exact))
    assert found == pytest.approx(run["nodal Linf | exact"], rel=1e-6)


def test_a_rule_in_python_gets_the_verdict_of_the_same_rule(root):
    mine = plumbline.Rule("mine", lambda xi, area: area)
    study = plumbline.run(root / SCENE, methods=[mine, "FA"], levels=3)
    ours, theirs = ([one for one in study["trends"] if one["method"] == name]
                    for name in ("mine", "FA"))
    assert ours and [one["verdict"] for one in ours] == [one["verdict"] for one in theirs]
    mine, full = ([{error: value for error, value in run["scalars"].items() if " | " in error}
                   for run in study.records if run["key"]["method"] == name]
                  for name in ("mine", "FA"))
    assert mine and mine[0] and mine == full


def test_transient_scenes_run(root):
    study = plumbline.run(root / "scenes/dynamics/wave.prm", levels=1)
    assert len(study.records) > 0 and all(not run["failure"] for run in study.records)


def test_to_frame_needs_pandas_and_says_so(root):
    study = plumbline.stability(root / SCENE, levels=1, methods="FA")
    try:
        import pandas
    except ImportError:
        with pytest.raises(ImportError, match="python3-pandas"):
            study.to_frame()
        return
    frame = study.to_frame()
    assert isinstance(frame, pandas.DataFrame) and list(frame["method"]) == ["FA"]
