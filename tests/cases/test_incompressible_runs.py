"""Runs of incompressible flows: kept, gone on with, and ended by what breaks them down."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from sphear.cases.flow import FLOWS, CaseRun
from sphear.cases.flow.dam_break import standing
from sphear.errors import SphearError
from sphear.schemes.presets import preset_settings

SMALL: dict[str, dict[str, Any]] = {
    "cavity": {"resolution": 12, "until": 0.3},
    "cavity-cylinder": {"resolution": 24, "diameter": 0.4, "max_steps": 8, "viscosity": "oger"},
    "taylor-green": {"resolution": 12, "until": 0.2, "projection": "intermediate", "shifting": "xu"},
    "poiseuille": {**preset_settings("zheng2018", "incompressible"), "resolution": 12, "max_steps": 8},
    "couette": {"resolution": 12, "max_steps": 6, "viscous_step": "crank_nicolson", "walls": "adami"},
    "dam-break": {"resolution": 6, "max_steps": 8},
}


def start(name: str, **changes: Any) -> CaseRun:
    case = FLOWS[name]
    return CaseRun(case, case.settings(**{"scheme": "incompressible", **SMALL[name], **changes}))


@cache
def whole(name: str) -> CaseRun:
    return start(name).run()


@pytest.mark.parametrize("name", SMALL)
def test_an_interrupted_run_goes_on_as_if_nothing_had_happened(name: str, tmp_path: Path) -> None:
    first = start(name)

    def progress(text: str) -> None:
        if len(first.history) == 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        first.run(progress, tmp_path / "state.npz")
    again = start(name)
    again.restore(tmp_path / "state.npz")
    assert len(again.history) == 3
    again.run()
    assert again.end == whole(name).end
    assert again.end in ("time", "steps")
    assert again.history == whole(name).history
    for what in ("positions", "velocities", "density", "pressure"):
        np.testing.assert_array_equal(getattr(again.flow, what), getattr(whole(name).flow, what))


@pytest.mark.parametrize("name", SMALL)
def test_a_run_reports_on_its_solves_and_particles(name: str) -> None:
    run = whole(name)
    last = run.history[-1]
    expected = {
        "pressure_iterations", "pressure_residual", "divergence", "density_deviation", "smallest_distance",
        "largest_gap", run.case.headline,
    }  # fmt: skip
    assert expected <= set(last)
    assert all(np.isfinite(value) for value in last.values())
    assert last["pressure_residual"] <= 1.01 * run.settings.model_dump()["tolerance"]
    result = run.as_dict()
    assert list(result)[:3] == ["case", "settings", "metrics"]
    resolved = result["settings"]
    assert all(resolved[key] is not None for key in set(resolved) - {"until"})


def test_the_state_of_another_flow_is_refused() -> None:
    flow = start("cavity").flow
    state = flow.state()
    state.pop("wall_pressure")
    with pytest.raises(SphearError, match="no wall_pressure of the shape"):
        flow.restore(state)
    with pytest.raises(SphearError, match="it is of another flow"):
        start("cavity", resolution=10).flow.restore(flow.state())


def test_a_state_is_a_copy() -> None:
    flow = start("taylor-green").flow
    state = flow.state()
    kept = {name: values.copy() for name, values in state.items()}
    flow.advance(2)
    for name, values in kept.items():
        np.testing.assert_array_equal(state[name], values)


def spoiled(name: str, values: Any, what: str = "u", **changes: Any) -> CaseRun:
    """A run whose particle 5 has something happen to it after two outputs."""
    run = start(name, **changes)

    def progress(text: str) -> None:
        if len(run.history) == 2:
            getattr(run.flow, what)[5] = values

    return run.run(progress)


FAILURES: dict[str, tuple[Any, str, str]] = {
    "not a number": (np.nan, "u", "a velocity is not a number"),
    "infinite": (np.inf, "u", "a velocity is not a number"),
    "fast": (
        (-400.0, 0.0),
        "u",
        "a speed of 400 is more than 10 times the 1 expected, as when the time step is too long",
    ),
    "behind a wall": ((-0.2, 0.4), "x", "a particle went through a wall"),
}


@pytest.mark.parametrize("failure", FAILURES)
@pytest.mark.parametrize("name", ["cavity", "cavity-cylinder"])
def test_what_breaks_down_is_an_end_and_keeps_everything(name: str, failure: str) -> None:
    values, what, reason = FAILURES[failure]
    run = spoiled(name, values, what)
    assert run.end.startswith("failed: the flow failed at t = ")
    assert reason in run.end
    assert len(run.end.splitlines()) == 1
    assert len(run.history) == 3
    result = run.as_dict()
    assert result["metrics"]["failure_time"] == run.history[-1]["time"]
    assert "profiles" not in result


@pytest.mark.parametrize("step", [0.5, 1e3, 1e100, 1e200, 1e308])
@pytest.mark.parametrize("name", ["cavity", "taylor-green", "cavity-cylinder"])
def test_any_time_step_that_is_forced_ends_a_run_and_leaves_numbers(name: str, step: float) -> None:
    run = start(name, time_step=step, force=True, until=None, max_steps=30).run()
    assert run.end.startswith("failed: the flow failed at t = ")
    assert np.isfinite(run.flow.positions).all()
    assert np.isfinite(run.flow.velocities).all()


def test_a_solve_that_does_not_converge_is_named() -> None:
    run = start("cavity", tolerance=1e-17).run()
    assert "the pressure equation was not solved: after" in run.end
    assert "where 1e-17 is asked for (with the preconditioner grid, then with" in run.end
    assert len(run.history) == 1


def test_particles_too_far_apart_for_their_kernel_are_named() -> None:
    with pytest.raises(SphearError, match=r"h_over_dx must be more than 0.5 for wendland_c2, or no particle has a"):
        start("cavity", h_over_dx=0.4)


def test_a_cylinder_that_turns_fast_is_what_the_time_step_follows() -> None:
    slow, fast = start("cavity-cylinder").flow, start("cavity-cylinder", spin=20.0).flow
    assert fast.problem.speed == pytest.approx(20.0 * 0.2)
    assert fast.time_step == pytest.approx(slow.time_step / 4.0)
    own = start("cavity", solid="Circle((0.5, 0.5), 0.2, spin=-20)").flow
    assert own.problem.speed == pytest.approx(4.0)


def test_the_column_is_as_high_as_its_particles() -> None:
    run = start("dam-break", resolution=10, max_steps=1).run()
    assert run.history[0]["height"] == pytest.approx(2.0, abs=0.01)


def test_particles_that_went_around_a_period_are_as_near_as_before() -> None:
    flow = start("taylor-green", projection="midpoint").flow
    assert flow.metrics()["smallest_distance"] == pytest.approx(1.0)
    flow.x += np.array([5.3, -2.0])  # type: ignore[attr-defined]
    assert flow.metrics()["smallest_distance"] == pytest.approx(1.0)


def test_a_tank_that_is_full_is_over_when_the_front_is_at_its_wall() -> None:
    run = start("dam-break", tank=2.0, until=None, max_steps=500).run()
    assert run.end == "the front is at the wall"


REFUSED: dict[str, tuple[str, dict[str, Any], str]] = {
    "periodic": ("taylor-green", {"resolution": 3}, "the resolution of 3 is too coarse: the kernel's support of 1.046"),
    "slow": ("poiseuille", {"reynolds": 1e-200}, "the setting reynolds should be from 1e-100 to 1e+100, not 1e-200"),
    "column": ("dam-break", {"column": 0.2}, "a column of dam-break is at least 4 particles wide and high"),
    "half a particle": ("dam-break", {"column": 1.99}, "and column=1.99 with resolution=6 is 11.94"),
    "mountain": ("dam-break", {"column": 1e300}, "the setting column should be less than or equal to 100"),
    "tank": ("dam-break", {"tank": 1.2}, "the setting tank should be greater than or equal to 1.5"),
    "no lattice": ("dam-break", {"initial": "relaxed"}, "starts from initial=lattice, not from initial=relaxed"),
    "unknown": ("cavity", {"viscositi": "oger"}, "there is no setting named 'viscositi': did you mean viscosity"),
    "time step": ("cavity", {"time_step": 0.5}, "the time step of 0.5 is beyond the cfl limit of 0.0523"),
    "shifting": (
        "cavity",
        {"shifting_strength": 1.0, "time_step": 0.05},
        "the time step of 0.05 is beyond the shifting limit of 0.0327",
    ),
    "preconditioner": ("cavity", {"preconditioner": "grd"}, "no preconditioner named 'grd': did you mean grid"),
    "kernel": ("cavity", {"kernel": "cubix"}, "no kernel named 'cubix'"),
    "two corrections": ("cavity", {"correction": "bonet_lok"}, "carries its own correction and takes no other"),
    "radial laplacian": ("cavity", {"laplacian": "violeau"}, "the Laplacian of each component, in one sum of"),
    "laplacian in two sums": ("cavity", {"laplacian": "two_pass"}, "differences, not 'two_pass'"),
    "laplacian of values": ("cavity", {"laplacian": "takeda"}, "differences, not 'takeda'"),
    "relaxed": ("cavity-cylinder", {"initial": "relaxed"}, "around shapes start from initial=lattice, not from"),
    "too coarse": ("cavity", {"resolution": 3}, "is 1 wide, narrower than the support of the kernel, 1.05"),
    "gap": ("cavity-cylinder", {"diameter": 0.9}, "narrower than the support of the kernel"),
    "tiny cylinder": ("cavity-cylinder", {"diameter": 0.001}, "too small for any wall particle"),
    "cylinder in the wall": (
        "cavity-cylinder",
        {"centre_x": 0.1},
        "the cylinder overlaps a wall: with a diameter of 0.4 its centre must be 0.2 or more from the walls",
    ),
}


@pytest.mark.parametrize("mistake", REFUSED)
def test_a_mistake_is_refused_before_the_first_step(mistake: str) -> None:
    name, changes, message = REFUSED[mistake]
    with pytest.raises(SphearError) as told:
        start(name, **changes)
    assert message in str(told.value)
    assert len(str(told.value).splitlines()) == 1


@pytest.mark.parametrize("name", ["relaxed", "staggered"])
@pytest.mark.parametrize("wall_model", ["mirror_points", "sfdi"])
def test_other_starts_in_a_box(name: str, wall_model: str) -> None:
    run = start("cavity", initial=name, walls=wall_model, max_steps=3, until=None).run()
    assert (run.end, run.history[-1]["smallest_distance"] > 0.5) == ("steps", True)


def test_a_cylinder_may_fill_the_line_that_profiles_are_of() -> None:
    run = start("cavity-cylinder", resolution=212, diameter=0.97, max_steps=1).run()
    assert "u_min" not in run.as_dict()["metrics"]


def test_a_package_that_is_missing_is_said_at_the_start(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sphear.pressure.AlgebraicMultigrid.installed", staticmethod(lambda: False))
    with pytest.raises(SphearError, match="the preconditioner amg needs pyamg"):
        start("cavity", preconditioner="amg")


def test_the_height_is_that_of_the_fluid_that_stands_on_the_floor() -> None:
    heights = np.array([0.05, 0.14, 0.26, 0.35, 0.62, 0.7])
    assert standing(heights, 0.1) == 0.35
    assert standing(heights[4:], 0.1) == pytest.approx(-0.05)
    assert standing(np.empty(0), 0.1) == pytest.approx(-0.05)
