"""Implicit viscous steps where pressure acts: a steady flow does not know its time step."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from sphear.cases.manufactured import manufactured, relative_errors
from sphear.references.manufactured import ClosedVortex
from sphear.schemes.incompressible.flow import IncompressibleFlow
from sphear.schemes.incompressible.settings import IncompressibleSettings
from tests.schemes.incompressible.flows import case

LIMIT = 7.7e-7  # of viscosity at Re = 1e-3, 20 particles a side


@cache
def creeping(viscous_step: str, step: float, steps: int) -> float:
    """The energy of the cavity at Re = 1e-3, where it is steady."""
    flow = case(
        "cavity", reynolds=1e-3, resolution=20, viscous_step=viscous_step, time_step=step, alpha=0.0, threads=1
    ).flow
    flow.advance(steps)
    return float(0.5 * (flow.velocities**2).sum(axis=1).mean())


@pytest.mark.parametrize("kind", ["crank_nicolson", "backward_euler"])
def test_a_creeping_cavity_is_that_of_explicit_steps(kind: str) -> None:
    exact = 0.03401  # with 800 explicit steps at the viscous limit
    assert creeping(kind, 100.0 * LIMIT, 20) == pytest.approx(exact, rel=0.005)
    assert creeping(kind, 4e4 * LIMIT, 1 if kind == "backward_euler" else 2) == pytest.approx(exact, rel=0.01)


def test_second_order_between_walls_beyond_the_viscous_limit() -> None:
    """Of velocity and pressure, the step falling with the spacing."""

    def errors(count: int) -> tuple[float, float]:
        exact = ClosedVortex(0.1)
        settings = IncompressibleSettings(alpha=0.0, viscous_step="crank_nicolson", threads=1)
        flow = IncompressibleFlow(manufactured(exact, count), settings)
        flow.advance(round(0.5 / flow.time_step))
        return relative_errors(flow, exact)

    coarse, fine = errors(16), errors(32)
    assert np.log2(coarse[0] / fine[0]) > 1.75
    assert np.log2(coarse[1] / fine[1]) > 1.75
