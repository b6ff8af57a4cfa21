"""Flows against their exact solutions and against an independent program."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import pytest

from sphear.cases.flow import FLOWS, FlowRun


def run(case: str, **settings: Any) -> FlowRun:
    return FlowRun(FLOWS[case], FLOWS[case].settings(**settings)).run()


@pytest.mark.parametrize(("viscosity", "independent"), [("morris", 0.022), ("violeau", 0.061), ("cleary_4.24", 0.0105)])
def test_channel_agrees_with_an_independent_program(viscosity: str, independent: float) -> None:
    """RMS error at t* = 5, Re = 0.5, 20 x 20 particles, linear extrapolation, uncorrected."""
    flow = run("poiseuille", viscosity=viscosity, until=5.0)
    assert flow.end == "time"
    assert flow.history[-1]["rms_error"] == pytest.approx(independent, rel=0.2)


def test_channel_reaches_the_steady_state() -> None:
    flow = run("poiseuille", viscosity="cleary_4.24")
    assert flow.end == "steady"
    assert flow.history[-1]["rms_error"] < 0.02


def test_direct_second_derivatives_fail_and_level_0_cures_them() -> None:
    """As Basa, Quinlan & Lastiwka (2009) found for model A."""
    assert run("poiseuille", viscosity="takeda", until=2.0).end.startswith("failed: the RMS error")
    assert run("poiseuille", viscosity="takeda", correction="shepard", until=2.0).end == "time"


def test_couette_flow_converges() -> None:
    errors = [run("couette", resolution=n, until=0.2).history[-1]["rms_error"] for n in (10, 20)]
    assert errors[1] < 0.6 * errors[0] < 0.006


def test_the_vortex_decays_as_it_should() -> None:
    flow = run("taylor-green", until=0.1)
    energy = [row["kinetic_energy"] for row in flow.history]
    assert flow.history[-1]["kinetic_energy_ratio"] == pytest.approx(1.0, abs=0.02)
    assert all(later < earlier for earlier, later in pairwise(energy))


def test_what_a_run_says_of_itself() -> None:
    found = run("poiseuille", viscosity="E", correction="0", until=0.05).as_dict()
    assert set(found) == {"case", "settings", "metrics", "performance"}
    assert found["settings"]["viscosity"] == "morris"
    assert found["settings"]["correction"] == "shepard"
    assert found["settings"]["time_step"] > 0
    assert found["metrics"]["failure_time"] is None
    assert found["performance"]["particles"] == 400
    assert found["performance"]["steps"] == found["metrics"]["steps"]


def test_a_run_ends_after_so_many_steps() -> None:
    flow = run("poiseuille", max_steps=7)
    assert (flow.end, flow.flow.steps) == ("steps", 7)
