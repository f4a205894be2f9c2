"""Grades of values by a certificate."""
import os

import numpy as np

from . import _core


def grade(points, values, certificate, *, h=()):
    """Grade values of another code by a certificate, as `plumbline grade` does.

    points       those of the certificate in any order, shape (n, 2)
    values       u there, an array of shape (n,) or (n, 2) for vectors; or, if h is given, a list of
                 such arrays, one for each grid from coarse to fine
    certificate  name of the file certificate.json that `plumbline certify` has written
    h            mesh size of each grid, decreasing

    Returns a dict: "grades" (for each grid a dict with "h", "largest" and "rms" error relative to
    the certified values, "digits", "is_at_least", "order"), "order" (least squares), "own_order",
    "gci", "limit_distance", "bound", "limit" ("converges to the certified solution", "converges to
    another limit" or "cannot be decided"), "reason".
    """
    sizes = [float(one) for one in np.atleast_1d(h)]
    return _core.grade_arrays(os.fspath(certificate), points, list(values) if sizes else [values],
                              sizes)
