import pathlib

import numpy as np
import pytest


@pytest.fixture
def root():
    return pathlib.Path(__file__).parents[2]


def lattice(n, n_around):
    """Centres of n x n cells of the unit square and of n_around layers of cells around it."""
    x = (np.arange(-n_around, n + n_around) + .5) / n
    return np.stack([a.ravel() for a in np.meshgrid(x, x)], axis=-1)


@pytest.fixture
def square():
    return ((0, 0), (1, 1))
