"""Grades of values by a certificate, and the certified problems."""
import os

import numpy as np

from . import _core


def certified_problems():
    """Names of the certified problems that come with the package, e.g. "NLB-01"."""
    return _core.certified_names()


def certified_problem(problem):
    """A certified problem, by its name ("NLB-07", in any case) or the file of its certificate.

    Returns a dict: "name", "purpose", "horizon", "scene" (text of the scene), "points", shape
    (n, 2), in three dimensions (n, 3), in one (n, 1), "values" there, shape (n,) or for vectors (n,
    n_components), "bounds", shape (n,), "digits" (the minimum over all points).
    """
    found = _core.certified_problem(os.fspath(problem))
    for key in ("points", "values", "bounds"):
        found[key] = np.array(found[key])
    if found["values"].shape[1] == 1:
        found["values"] = found["values"][:, 0]
    return found


def grade(points, values=None, problem=None, *, h=()):
    """Grade values of another code against a certificate, as `plumbline grade` does.

    grade("mine.csv", problem="NLB-07")           a file of values
    grade(["a.csv", "b.csv"], problem="NLB-07", h=[.1, .05])
    grade(points, values, "NLB-07")               arrays

    points   those of the certificate in any order, shape (n, 2), in three dimensions (n, 3),
             in one (n, 1) or (n,); or the name of a CSV file with their coordinates and values
             (x,y,u; for vectors x,y,u,v or x,y,u1,u2), or a list of such files, one for each grid
    values   u there, an array of shape (n,) or (n, n_components) for vectors; or, if h is given, a
             list of such arrays, one for each grid from coarse to fine
    problem  name of a certified problem, see certified_problems(), or of a file certificate.json
             that `plumbline certify` has written
    h        mesh size of each grid, decreasing

    Returns a dict: "grades" (for each grid a dict with "h", "largest" and "rms" error relative to
    the certified values, "digits", "is_at_least", "order"), "order" (least squares), "own_order",
    "gci", "limit_distance", "bound", "limit" ("converges to the certified solution", "converges to
    another limit" or "cannot be decided"), "reason", and "rules": the same errors of Plumbline's
    meshfree rules, lists over their mesh sizes "h".
    """
    if problem is None:
        raise _core.InputError("problem is missing; give the name of a certified problem, one of "
                               f"{', '.join(certified_problems())}, or the file of a certificate")
    sizes = [float(one) for one in np.atleast_1d(h)]
    name = os.fspath(problem)
    if values is None:
        files = [points] if isinstance(points, (str, os.PathLike)) else list(points)
        if not all(isinstance(one, (str, os.PathLike)) for one in files):
            raise _core.InputError("values is missing; give the values at the points, or the name of "
                                   "a CSV file that has both in place of the points")
        return _core.grade_files(name, [os.fspath(one) for one in files], sizes)
    return _core.grade_arrays(name, points, list(values) if sizes else [values], sizes)
