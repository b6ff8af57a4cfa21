"""Flows in which viscosity is all: their sound, their steps, and what they give far below Re = 1."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

import sphear
from sphear.cases.flow import FLOWS
from sphear.schemes.problem import corner_sound_speed


def test_a_corner_of_walls_has_a_sound_speed_that_follows_its_pressure() -> None:
    """The density varies by 10 % where the pressure is rho nu U / dx."""
    case = FLOWS["cavity"]
    problem = case.problem(case.settings(scheme="explicit", reynolds=0.01, resolution=25))
    pressure = problem.kinematic_viscosity * problem.speed * 25
    assert pressure / corner_sound_speed(problem) ** 2 == pytest.approx(0.1)


@pytest.mark.parametrize("case", ["poiseuille", "taylor-green"])
def test_flows_without_corners_keep_the_rule_of_morris(case: str) -> None:
    problem = FLOWS[case].problem(FLOWS[case].settings(scheme="explicit", reynolds=0.01, resolution=25))
    assert corner_sound_speed(problem) == 0.0


def test_sound_from_corners_never_limits_the_step() -> None:
    case = FLOWS["cavity"]
    usual = case.problem(case.settings(scheme="explicit", reynolds=100, resolution=25))
    for viscosity in (1e-2, 1.0, 1e2, 1e4):
        problem = replace(usual, kinematic_viscosity=viscosity, speed=1.0)
        h = 1.57 * problem.spacing
        limits = problem.time_step_limits(h, max(10.0, corner_sound_speed(problem)))
        assert limits["cfl"] > min(limits["viscous"], 0.99 * 0.25 * h / 11.0)


@pytest.mark.parametrize(("resolution", "until"), [(37, 0.16), (13, 0.4)])
def test_a_slow_cavity_keeps_its_corners(resolution: int, until: float) -> None:
    """By the rule of Morris alone, 37 a side fails at t = 0.14 with 12 times the lid's speed."""
    run = sphear.flow("cavity", scheme="explicit", reynolds=1, resolution=resolution, until=until).run()
    assert run.end == "time"
    assert run.history[-1]["kinetic_energy"] == pytest.approx(0.034, rel=0.1)  # a grid program: 0.0335


def implicit(case: str, until: float, **settings: Any) -> sphear.CaseRun:
    chosen = {"scheme": "incompressible", "viscous_step": "crank_nicolson", "resolution": 13, **settings}
    return sphear.flow(case, reynolds=1e-3, until=until, **chosen).run()


def test_implicit_steps_resolve_the_run() -> None:
    """Nothing else limits them in a slow channel: one step would be as long as the run, and 12 % off."""
    done = implicit("poiseuille", 1.0)
    assert done.flow.steps == 100
    assert done.history[-1]["rms_error"] < 0.01


def test_a_step_that_is_named_is_taken() -> None:
    assert implicit("poiseuille", 1.0, time_step=0.01).flow.steps == 11


def test_explicit_steps_do_not_follow_the_run() -> None:
    case = FLOWS["poiseuille"]
    chosen = {"scheme": "incompressible", "reynolds": 1.0, "resolution": 13}
    short, long = (sphear.CaseRun(case, case.settings(**chosen, until=until)) for until in (1e-3, 5.0))
    assert short.flow.time_step == long.flow.time_step


def test_long_steps_of_a_slow_cavity_do_not_ring() -> None:
    """By Crank and Nicolson alone, where fluid feels its walls in a twentieth of a step, it fails at t = 1.67."""
    done = implicit("cavity", 1.8, resolution=29)
    assert done.end == "time"
    assert done.history[-1]["kinetic_energy"] == pytest.approx(0.0335, rel=0.01)  # of a grid program


def test_steps_beside_a_free_surface_are_at_most_a_hundred_viscous_ones() -> None:
    """Beyond thousands of them the surface of a slow flow makes energy, or nothing is solved."""
    flow = sphear.flow(
        "dam-break", scheme="incompressible", reynolds=1e-3, resolution=13, viscous_step="crank_nicolson"
    ).flow
    explicit = flow.problem.time_step_limits(flow.kernel.h, 0.0, flow.term.radial)["viscous"]
    assert flow.time_step == pytest.approx(100 * explicit)
