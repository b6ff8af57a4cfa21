"""Viscosity taken at the end of the step, or in its middle."""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np
import pytest

from sphear.errors import SphearError
from sphear.schemes.base import FlowFailure
from tests.schemes.incompressible.flows import Array, case, in_a_box, vortices

KINDS = ("crank_nicolson", "backward_euler")
TOLERANCE = "sphear.schemes.incompressible.viscous.TOLERANCE"


@pytest.fixture(autouse=True)
def _exact(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(TOLERANCE, 1e-12)


@pytest.mark.parametrize("kind", KINDS)
def test_it_is_the_explicit_step_to_second_order(kind: str) -> None:
    """Of one step: half the step, a quarter of the difference.

    On a lattice, where the velocities are free of divergence: viscosity at the end of a step is that of velocities that
    a projection has freed of it, and not of those before.
    """

    def velocities(step: float, kind: str) -> Array:
        flow = in_a_box(vortices, 12, 0.0, time_step=step, alpha=0.0, shifting="none", viscous_step=kind)
        flow.advance(1)
        return flow.velocities

    apart = [float(np.abs(velocities(s, kind) - velocities(s, "explicit")).max()) for s in (0.008, 0.004, 0.002)]
    assert apart[0] > 1e-7
    assert [a / b for a, b in itertools.pairwise(apart)] == pytest.approx([4.0, 4.0], rel=0.1)


@pytest.mark.parametrize("term", ["morris", "fatehi_manzari", "violeau"])
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", ["couette", "poiseuille"])
def test_far_beyond_the_viscous_limit(name: str, kind: str, term: str) -> None:
    """At a low Reynolds number, where particles hardly move: the flow goes to the steady one and stays there."""
    explicit = case(name, viscosity=term, reynolds=0.01, resolution=10)
    step = 50.0 * explicit.flow.limits["viscous"]
    run = case(name, viscosity=term, reynolds=0.01, resolution=10, viscous_step=kind, time_step=step, max_steps=30)
    run.flow.advance(30)
    assert run.flow.limits["viscous"] == np.inf
    error = run.case.metrics(run.settings, run.flow)["rms_error"]
    # violeau is far off beside walls; Crank-Nicolson lets what it cannot resolve ring for long
    assert error < (0.15 if term == "violeau" else 0.01) + (0.25 if kind == "crank_nicolson" else 0.0)


@pytest.mark.parametrize(("kind", "order"), [("explicit", 1.0), ("backward_euler", 1.0), ("crank_nicolson", 2.0)])
def test_order_in_time_where_viscosity_is_all_there_is(kind: str, order: float) -> None:
    def velocities(steps: int, kind: str) -> Array:
        changes: dict[str, Any] = {"viscosity": "morris", "reynolds": 0.001, "resolution": 10, "shifting": "none"}
        run = case("poiseuille", time_step=0.02 / steps, viscous_step=kind, alpha=0.0, **changes)
        run.flow.advance(steps)
        return run.flow.velocities[:, 0] / run.flow.problem.speed

    exact = velocities(320, "crank_nicolson")
    errors = [float(np.abs(velocities(steps, kind) - exact).max()) for steps in (10, 20)]
    assert np.log2(errors[0] / errors[1]) == pytest.approx(order, abs=0.05)


def test_an_explicit_step_beyond_the_limit_is_refused() -> None:
    with pytest.raises(SphearError, match="beyond the viscous limit of"):
        case("poiseuille", time_step=0.1)


def test_what_does_not_converge_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sphear.schemes.incompressible.viscous.MOST", 1)
    run = case("poiseuille", viscous_step="backward_euler", time_step=0.015)
    with pytest.raises(FlowFailure, match="at t = 0: the implicit viscous step was not solved: after 1 iterations"):
        run.flow.advance(1)
    assert run.run().end.startswith("failed: the flow failed at t = 0: the implicit viscous step")
