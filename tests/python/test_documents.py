"""What the documents show runs, and what is exported is documented and typed."""
import inspect
import math
import re

import plumbline


def test_the_example_of_the_readme_runs(root, capsys):
    text = (root / "python/README.md").read_text()
    example, *_ = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    exec(compile(example, "README.md", "exec"), {})
    printed = capsys.readouterr().out
    assert "the weights are those of IPA-AC-R2" in printed and "\nas required\n" in printed
    *_, errors, values, _ = printed.split("\n")
    difference, estimate = map(float, errors.split())
    assert estimate < difference < .01
    centre, other = map(float, values.strip("[]").split())
    assert abs(centre - math.sin(1.5) * math.cos(1)) < 1e-5
    assert abs(other - math.sin(.75) * math.cos(1.5)) < 1e-5


def test_the_example_of_moduli_runs(root, capsys):
    text = (root / "python/README.md").read_text()
    _, example, *_ = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    exec(compile(example, "README.md", "exec"), {})
    own, rule = map(float, capsys.readouterr().out.split())
    assert own == rule and abs(own - 209.7) < .05


def test_the_example_of_matrices_runs(root, capsys, tmp_path, monkeypatch):
    text = (root / "python/README.md").read_text()
    _, _, example, _ = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    monkeypatch.chdir(tmp_path)
    exec(compile(example, "README.md", "exec"), {})
    words, residual = capsys.readouterr().out.rsplit(maxsplit=1)
    assert "of IPA-AC-R2: 256 x" in words and float(residual) < 1e-9
    assert plumbline.load_matrix("equations.npz").method == "IPA-AC-R2"


def test_the_example_in_space_runs(root, capsys):
    text = (root / "python/README.md").read_text()
    *_, example = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    exec(compile(example, "README.md", "exec"), {})
    errors = {line.split()[0]: float(line.split()[1])
              for line in capsys.readouterr().out.strip().split("\n")}
    assert errors["IPA-AC-R2"] < errors["FA"] / 10 and errors["Q1"] < errors["FA"] / 10


def test_the_example_of_the_main_readme_runs(root, capsys, tmp_path, monkeypatch):
    text = (root / "README.md").read_text()
    scene = re.search(r"`convergence\.prm`.*?```scene\n(.*?)```", text, re.DOTALL).group(1)
    (tmp_path / "convergence.prm").write_text(scene)
    monkeypatch.chdir(tmp_path)
    example = re.search(r"```python\n(import numpy as np, plumbline\n.*?)```", text, re.DOTALL).group(1)
    exec(compile(example, "README.md", "exec"), {})
    lines = capsys.readouterr().out.split("\n")
    assert lines[:4] == ["FA not AC", "IPA-AC not AC", "IPA-AC-R2 AC", "Q1 AC"]
    assert any("the weights are those of FA" in line for line in lines[4:])
    assert lines[-2] == "NOT as required"


def test_all_names_have_docstrings():
    for name in plumbline.__all__:
        assert (inspect.getdoc(getattr(plumbline, name)) or "").strip(), name


def test_stubs_name_what_the_module_has(root):
    stub = (root / "python/plumbline/_core.pyi").read_text()
    from plumbline import _core
    ours = {name for name in dir(_core) if not name.startswith("_")}
    assert ours == set(re.findall(r"^(?:class|def) (\w+)", stub, re.MULTILINE))
