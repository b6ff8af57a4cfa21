"""The manufactured flow solves the Navier-Stokes equations with its force, checked by finite differences."""

from __future__ import annotations

import numpy as np
import pytest

from sphear.references.manufactured import ClosedVortex

NU, STEP = 0.03, 1e-4
FLOW = ClosedVortex(NU)
PLACES = np.random.default_rng(0).random((40, 2))
AXES = STEP * np.eye(2)


@pytest.mark.parametrize("time", [0.0, 0.3, 0.71])
def test_momentum_is_balanced(time: float) -> None:
    u = FLOW.velocity(PLACES, time)
    change = (FLOW.velocity(PLACES, time + STEP) - FLOW.velocity(PLACES, time - STEP)) / (2 * STEP)
    ahead, behind = ([FLOW.velocity(PLACES + sign * e, time) for e in AXES] for sign in (1, -1))
    slopes = [(a - b) / (2 * STEP) for a, b in zip(ahead, behind, strict=True)]
    laplacian = (sum(ahead) + sum(behind) - 4 * u) / STEP**2
    push = np.stack(
        [(FLOW.pressure(PLACES + e, time) - FLOW.pressure(PLACES - e, time)) / (2 * STEP) for e in AXES], axis=1
    )
    convected = sum(u[:, axis, None] * slopes[axis] for axis in range(2))
    expected = change + convected + push - NU * laplacian
    np.testing.assert_allclose(FLOW.force(PLACES, time), expected, rtol=0, atol=2e-6)
    np.testing.assert_allclose(slopes[0][:, 0] + slopes[1][:, 1], 0.0, atol=1e-6)


def test_walls_hold_the_fluid() -> None:
    ticks = np.linspace(0, 1, 7)
    sides = np.concatenate(
        [np.stack(pair, axis=1) for x in (0.0, 1.0) for pair in ((x + 0 * ticks, ticks), (ticks, x + 0 * ticks))]
    )
    np.testing.assert_allclose(FLOW.velocity(sides, 0.4), 0.0, atol=1e-15)


def test_pressure_has_no_mean() -> None:
    ticks = (np.arange(20) + 0.5) / 20
    places = np.stack(np.meshgrid(ticks, ticks), axis=-1).reshape(-1, 2)
    assert abs(FLOW.pressure(places, 0.2).mean()) < 1e-15
