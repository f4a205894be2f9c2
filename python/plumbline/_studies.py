"""Studies of scenes as dicts with arrays, from the JSON that the command writes too."""
import json
import os
import tempfile

import numpy as np

from . import _core


def _to_arrays(value):
    """Lists of numbers as arrays, null as NaN where numbers are."""
    if isinstance(value, dict):
        return {key: _to_arrays(one) for key, one in value.items()}
    if isinstance(value, list):
        kinds = {type(one) for one in value}
        if value and kinds <= {int, float, type(None)} and kinds != {type(None)}:
            if kinds == {int}:
                return np.array(value)
            return np.array([np.nan if one is None else one for one in value], float)
        return [_to_arrays(one) for one in value]
    return value


def _flat(record):
    """The numbers and texts of a record, each under one name: a row of a table."""
    row = {}
    for name, value in record.items():
        if name == "scalars":
            row.update({one: scalar["value"] for one, scalar in value.items()})
        elif name in ("key", "cost", "texts", "errors") and isinstance(value, dict):
            row.update(value)
        elif isinstance(value, (str, int, float, bool)) or value is None:
            row[name] = value
    return row


class Record(dict):
    """The results of one method at one level: key, cost, scalars, texts, curves, fields, notes,
    failure. record["Δt"] is the number record["scalars"]["Δt"]["value"].
    """

    def __missing__(self, name):
        scalars = self.get("scalars", {})
        if name in scalars:
            return scalars[name]["value"]
        texts = self.get("texts", {})
        if name in texts:
            return texts[name]
        raise KeyError(f"'{name}'; there are {', '.join([*self, *scalars, *texts])}")

    def field(self, name):
        """points, shape (n, 2) [length], and values, shape (n,) or (n, n_components)."""
        field = self["fields"][name]
        n = field["n_components"]
        values = np.asarray(field["values"], float)
        return (np.asarray(field["points"], float).reshape(-1, 2),
                values if n == 1 else values.reshape(-1, n))


class Records(list):
    """A list of records."""

    def to_frame(self):
        """A pandas.DataFrame, a row for each record: key, cost and scalars. Needs pandas."""
        try:
            import pandas
        except ImportError:
            raise ImportError("to_frame needs pandas: apt-get install python3-pandas") from None
        return pandas.DataFrame([_flat(record) for record in self])


class Study(dict):
    """The results of a study, under the keys of the JSON file that the command writes; lists of
    numbers are arrays.
    """

    @property
    def records(self):
        return self["records"]

    def to_frame(self):
        """See Records.to_frame."""
        return self.records.to_frame()


def _study(text):
    study = Study(_to_arrays(json.loads(text)))
    study["records"] = Records(Record(one) for one in study["records"])
    return study


def _given(scene, set, methods):
    """The scene's file or text, the changed keys, and the Python rules among the methods."""
    changed = dict(set or {})
    if methods is None:
        return os.fspath(scene), changed, []
    methods = [methods] if isinstance(methods, (str, _core.Rule)) else list(methods)
    rules = [one for one in methods if isinstance(one, _core.Rule)]
    changed["Methods/names"] = ", ".join(one.name if isinstance(one, _core.Rule) else one
                                         for one in methods)
    return os.fspath(scene), changed, rules


def _named(scene, set, methods):
    """As _given, of an analysis that takes no rules in Python."""
    text, changed, rules = _given(scene, set, methods)
    if rules:
        raise ValueError(f"methods: '{rules[0].name}' is a rule in Python, which has no model of "
                         "fracture; give names of plumbline.methods()")
    return text, changed, rules


def run(scene, *, set=None, methods=None, levels=0):
    """Run a scene, static or in time, as `plumbline run` does, without files.

    scene    name of a .prm or .json file, or the text of a scene (several lines)
    set      {"Section/key": value}: keys changed in the scene
    methods  names and Rules instead of the scene's
    levels   number of levels of each series, from the first; 0: all

    Returns a Study with the keys of results.json (dynamics.json in time): records with errors as
    scalars and cost, trends with verdicts and rates, advice, expectations.
    """
    text, changed, rules = _given(scene, set, methods)
    return _study(_core.study_json("run", text, changed, rules, levels))


def stability(scene, *, set=None, methods=None, levels=0):
    """Eigenvalues, condition, critical time steps and verdicts of each method's operator, as
    `plumbline stability` does. Arguments as of run(). Returns a Study whose records are Records.
    """
    text, changed, rules = _given(scene, set, methods)
    return _study(_core.study_json("stability", text, changed, rules, levels))


def dispersion(scene, *, angles=(), directions=(), set=None, methods=None, levels=0):
    """Phase and group speeds of waves, as `plumbline dispersion` does.

    angles      in the plane: directions from the first axis [degree]; default: along an axis, the
                diagonal, halfway
    directions  in space: vectors, shape (n, 3); default: along an axis, the diagonals of a face and
                of the cube

    Other arguments as of run(). Returns a Study; curves of its records are columns over k.
    """
    text, changed, rules = _given(scene, set, methods)
    return _study(_core.study_json("dispersion", text, changed, rules, levels,
                                   angles=list(angles), directions=list(directions)))


def _resumable(analyse, folder):
    """The study that analyse(folder) returns as text, with a checkpoint in the folder until it has
    ended; without a folder nothing is kept.
    """
    if folder is None:
        with tempfile.TemporaryDirectory() as own:
            return _study(analyse(own))
    os.makedirs(folder, exist_ok=True)
    study = _study(analyse(os.fspath(folder)))
    checkpoint = os.path.join(folder, "checkpoint.h5")
    if os.path.exists(checkpoint):
        os.remove(checkpoint)
    return study


def grow(scene, *, set=None, methods=None, folder=None):
    """Quasi-static fracture of a body, bond by bond, as `plumbline grow` does, in two and three
    dimensions.

    folder    where a checkpoint is kept: after Ctrl-C or a kill the same call goes on from it.
              None: no checkpoint is kept after the call

    Other arguments as of run(); methods are names. Returns a Study whose one record has the critical
    loads and energies as scalars (G by bonds, G by energy, peak load, advance, ...), the curves
    "events", "broken" and "sides" (columns), and the field "damage" of each of the "moments".
    """
    text, changed, _ = _named(scene, set, methods)
    return _resumable(lambda own: _core.study_json("grow", text, changed, [], 0, own), folder)


def crack(scene, *, set=None, methods=None, levels=0, folder=None):
    """Dynamic fracture of a notched strip of double-well bonds, as `plumbline crack` does: its
    threshold at each level, the crack's motion at the finest one.

    Arguments as of run() and grow(). Returns a Study; texts "outcome" and "reason" of a record say
    whether the crack runs, branches or is arrested, curve "samples" has its tip over time.
    """
    text, changed, _ = _named(scene, set, methods)
    return _resumable(lambda own: _core.study_json("crack", text, changed, [], levels, own), folder)


def strip(scene, *, set=None, methods=None, levels=0):
    """A stationary crack in Rice's strip by meshfree and Galerkin methods, as `plumbline strip`
    does. Arguments as of run(); methods are names. Returns a Study: energies of the strip and of
    its tip by level, limits and their agreement.
    """
    text, changed, _ = _named(scene, set, methods)
    return _study(_core.study_json("strip", text, changed, [], levels))


def certify(scene, *, set=None, methods=None, reference_level=0, file=None):
    """Values of a static solution with error bounds, as `plumbline certify` computes them.

    scene            as of run(): Study/regime = m with three mesh sizes, Reference/method,
                     Output/points; a meshfree rule in Methods/names confirms the values
    set, methods     as of run(); methods are names
    reference_level  level of Study/h for the Galerkin method, from 1, the coarsest; 0: the
                     finest
    file             where the certificate is written, for grade(..., problem=file); None: nowhere

    Returns a dict with the keys of certificate.json: "points" (dicts with "x", "value", "bound",
    "other", "other_bound", "digits", ...), "mean", "size", "galerkin", "meshfree", "rules", ...
    Raises NumericalError where nothing is certified.
    """
    text, changed, rules = _given(scene, set, methods)
    if rules:
        raise ValueError(f"methods: '{rules[0].name}' is a rule in Python, which other programs "
                         "cannot reproduce; give names of plumbline.methods()")
    certificate = _core.certify_json(text, changed, reference_level)
    if file is not None:
        with open(file, "w", encoding="utf-8") as out:
            out.write(certificate)
    return _to_arrays(json.loads(certificate))
