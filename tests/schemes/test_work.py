"""Sums over particles in one pass, against NumPy's."""

from __future__ import annotations

import numpy as np
import pytest

from sphear.schemes.incompressible.slopes import add_scaled, changes, squared_traces, traces
from sphear.schemes.work import work

NUMBERS = np.random.default_rng(3)


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("count", [0, 1, 256, 700])
def test_work_and_its_size(count: int, dimension: int) -> None:
    before, after, a = NUMBERS.normal(size=(3, count, dimension))
    each = ((before + after) * a).sum(axis=1)
    assert work(before, after, a) == pytest.approx((each.sum(), np.abs(each).sum()))
    one = np.ones((1, dimension))
    each = ((before + after) * one).sum(axis=1)
    assert work(before, after, one) == pytest.approx((each.sum(), np.abs(each).sum()))


@pytest.mark.parametrize("dimension", [2, 3])
def test_what_is_made_of_slopes(dimension: int) -> None:
    slopes, ways = NUMBERS.normal(size=(50, dimension, dimension)), NUMBERS.normal(size=(50, dimension))
    flat = slopes.reshape(50, -1)
    np.testing.assert_allclose(traces(flat, dimension), np.trace(slopes, axis1=1, axis2=2))
    np.testing.assert_allclose(squared_traces(flat, dimension), np.trace(slopes @ slopes, axis1=1, axis2=2))
    np.testing.assert_allclose(changes(flat, ways), np.einsum("nab,nb->na", slopes, ways), atol=1e-14)
    sums = ways.copy()
    add_scaled(sums, flat[:, 0].copy(), ways)
    np.testing.assert_allclose(sums, ways * (1.0 + flat[:, :1]))
