"""A term of two passes: a particle with too few neighbours must not spoil those around it."""

from __future__ import annotations

import numpy as np
import pytest

from sphear import CubicSpline, laplacian
from tests.particles import lattice


@pytest.mark.parametrize("fallback", ["uncorrected", "nan"])
def test_neighbours_of_a_deficient_particle_stay_right(fallback):
    """One particle hangs on a square by a single neighbour; the Laplacian of a linear field inside stays zero."""
    square = lattice((13, 13))
    tip = square.max(axis=0) + np.array([0.9, 0.9])
    positions = np.concatenate((square, [tip]))
    values = 1.0 + positions @ np.array([2.0, -3.0])
    result = laplacian(
        positions, values, viscosity="two_pass", correction="bonet_lok", kernel=CubicSpline(0.65), volumes=1.0,
        fallback=fallback,
    )  # fmt: skip
    assert np.isnan(result[-1]) == (fallback == "nan")
    assert np.abs(result[84]) < 1e-10  # the middle of the square
    assert np.isfinite(result[:-1]).all()
