"""Walls, viscosity, pressure and time together: a manufactured flow in a closed square, and how its errors fall."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest

from sphear.cases.flow import FLOWS
from sphear.cases.manufactured import manufactured, relative_errors
from sphear.errors import SphearError
from sphear.references.manufactured import ClosedVortex
from sphear.schemes.base import flow_of
from sphear.schemes.incompressible.flow import IncompressibleFlow
from sphear.schemes.incompressible.settings import IncompressibleSettings

EXACT = ClosedVortex(0.01)
# of velocity and pressure, between 32 and 64 particles a side: terms that do not converge on disordered particles stop
ORDERS = {
    "fatehi_manzari": (1.8, 1.8),
    "schwaiger": (1.8, 1.8),
    "least_squares": (1.8, 1.8),
    "gotoh": (1.2, 1.8),
    "oger": (1.2, 1.4),
    "morris": (0.7, 0.8),
}


@cache
def errors(count: int, **changes: Any) -> tuple[float, float]:
    """Of velocity and pressure, in parts of the exact ones, at t = 1/2."""
    flow = IncompressibleFlow(manufactured(EXACT, count), IncompressibleSettings(**{"alpha": 0.0, **changes}))
    flow.advance(round(0.5 / flow.time_step))
    return relative_errors(flow, EXACT)


@pytest.mark.parametrize("term", ORDERS)
def test_order_in_the_spacing(term: str) -> None:
    coarse, fine = errors(32, viscosity=term), errors(64, viscosity=term)
    for before, after, order in zip(coarse, fine, ORDERS[term], strict=True):
        assert np.log2(before / after) > order
    assert fine[0] < 0.004
    assert fine[1] < 0.012


@pytest.mark.parametrize("wall_model", ["adami", "sfdi"])
def test_order_with_other_walls(wall_model: str) -> None:
    coarse, fine = errors(32, walls=wall_model), errors(64, walls=wall_model)
    assert np.log2(coarse[0] / fine[0]) > 1.5
    assert fine[0] < 0.004


def test_order_with_an_implicit_viscous_step() -> None:
    coarse, fine = (errors(count, viscous_step="crank_nicolson") for count in (24, 48))
    assert np.log2(coarse[0] / fine[0]) > 1.5
    assert fine[0] < 0.003


def test_forces_at_the_start_of_a_step_are_far_off() -> None:
    assert errors(32, projection="start")[0] > 10.0 * errors(32)[0]


def test_the_explicit_scheme_says_that_it_knows_no_such_force() -> None:
    with pytest.raises(SphearError, match="constant body forces only"):
        flow_of(manufactured(EXACT, 16), FLOWS["cavity"].settings(scheme="explicit"))
