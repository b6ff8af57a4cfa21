"""Flows that no fluid makes end as failed, and flows that are not resolved are told."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from sphear.boundaries import Box
from sphear.schemes.problem import Problem
from sphear.schemes.watch import Watch, unresolved
from tests.particles import lattice
from tests.schemes.incompressible.flows import case

PERIODIC = Box((0.0, 0.0), (1.0, 1.0), ("periodic", "periodic"))
LID = Box((0.0, 0.0), (1.0, 1.0), ("walls", "walls"), upper_velocity=(1.0, 0.0))
CHANNEL = Box((0.0, 0.0), (1.0, 1.0), ("periodic", "walls"))
TANK = Box((0.0, 0.0), (1.0, 1.0), ("walls", "walls"))


def problem(box: Box, speed: float = 0.0, force: tuple[float, float] = (0.0, 0.0), nu: float = 0.1) -> Problem:
    x = lattice((10, 10), 0.1)
    velocities = np.tile((speed, 0.0), (len(x), 1))
    return Problem(x, velocities, box, force, 0.1, 1.0, nu, 1.0, 1.0)


def flow(of: Problem, speed: float, rise: float = 0.0) -> Any:
    """One that has come to have this speed everywhere, and stands higher by this."""
    return SimpleNamespace(
        problem=of,
        velocities=np.tile((speed, 0.0), (len(of.positions), 1)),
        positions=of.positions + np.array((0.0, rise)),
        count=len(of.positions),
        energy_budget=None,
    )


@pytest.mark.parametrize(
    ("of", "speed", "rise", "said"),
    [
        (problem(PERIODIC, 1.0), 1.01, 0.0, "its energy has grown by 0.02 of what there was"),
        (problem(PERIODIC, 1.0), 1.3, 0.0, "1.3 times as fast as the fastest particle at the start"),
        (problem(PERIODIC), 0.1, 0.0, "from rest"),
        (problem(LID), 1.3, 0.0, "1.3 times as fast as the fastest wall"),
        (problem(TANK, force=(0.0, -1.0)), 0.5, 0.0, "its energy has grown"),
        (problem(TANK, force=(0.0, -1.0)), 0.0, 0.1, "its energy has grown"),
    ],
)
def test_nonsense_is_named(of: Problem, speed: float, rise: float, said: str) -> None:
    assert said in (Watch(of).fault(flow(of, speed, rise)) or "")


@pytest.mark.parametrize(
    ("of", "speed", "rise"),
    [
        (problem(PERIODIC, 1.0), 1.0, 0.0),
        (problem(LID), 1.0, 0.0),
        (problem(TANK, force=(0.0, -1.0)), 0.0, 0.0),
        (problem(TANK, force=(0.0, -1.0)), 0.4, -0.1),
        (problem(PERIODIC, force=(1.0, 0.0)), 5.0, 0.0),  # goes round, and falls all the time
    ],
)
def test_what_a_fluid_does_is_let_go_on(of: Problem, speed: float, rise: float) -> None:
    assert Watch(of).fault(flow(of, speed, rise)) is None


def test_vortices_that_coarse_particles_blow_up_end_as_failed() -> None:
    run = case("taylor-green", resolution=13, reynolds=1e5, until=1.0, threads=1).run()
    assert run.end.startswith("failed: ")
    assert "no force drives it" in run.end


def test_resolution_is_asked_for_by_its_number() -> None:
    assert unresolved(problem(LID, nu=0.1)) == []
    (layers,) = unresolved(problem(LID, nu=1e-3))
    assert "0.32 spacings" in layers
    assert "6.3 times the resolution" in layers
    (cell,) = unresolved(problem(PERIODIC, nu=1e-4))
    assert "cell Reynolds number U dx / nu is 1e+03" in cell
    assert unresolved(replace(problem(PERIODIC), kinematic_viscosity=0.0)) == []
    assert unresolved(problem(CHANNEL, nu=1e-4)) == []
