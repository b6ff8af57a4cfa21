"""A flow around its steps: sound speed, time step, room, failures, conservation, order, and going on from a state."""

from __future__ import annotations

import re
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pydantic import ValidationError

from sphear import SphearError
from sphear.boundaries import Box
from sphear.cases.flow import FLOWS
from sphear.checked import checked
from sphear.schemes.base import FlowFailure
from sphear.schemes.presets import PRESETS
from sphear.schemes.problem import Problem, morris_sound_speed
from sphear.schemes.weakly_compressible.flow import WeaklyCompressibleFlow
from sphear.schemes.weakly_compressible.settings import WeaklyCompressibleSettings
from tests.particles import jittered

Array = np.ndarray[Any, Any]

# one sentence: when, which particle, where and why
SENTENCE = re.compile(r"the flow failed at t = (\S+), particle (\d+) at \((\S+), (\S+)\): ([a-z].*[^.])")
PAIRS = [("summation", "squares"), ("continuity", "products")]


def channel(resolution: int = 10, **changes: Any) -> tuple[Problem, WeaklyCompressibleSettings]:
    settings = FLOWS["poiseuille"].explicit(resolution=resolution, **{**PRESETS["basa2009"], **changes})
    return FLOWS["poiseuille"].problem(settings), settings


def box(viscosity: float = 0.1) -> Problem:
    """Jittered particles with random velocities in a periodic box."""
    positions = jittered((12, 12), 0.24, seed=0, dx=1 / 12)
    return Problem(
        positions=positions,
        velocities=np.asarray(np.random.default_rng(1).standard_normal(positions.shape)),
        box=Box((0.0, 0.0), (1.0, 1.0), ("periodic", "periodic")),
        body_force=(0.0, 0.0),
        spacing=1 / 12,
        density=2.0,
        kinematic_viscosity=viscosity,
        speed=4.0,
        length=1.0,
    )


def smooth(viscosity: float) -> Problem:
    """The box with waves for velocities."""
    start = box(viscosity=viscosity)
    x, y = 2 * np.pi * start.positions.T
    return replace(start, velocities=0.3 * np.stack((np.sin(x) + np.cos(y), np.sin(x + y)), axis=1), speed=1.0)


def conserving(**changes: Any) -> WeaklyCompressibleSettings:
    """Without pressure reduction; the rule for walls, which there are none of, is that of another test."""
    usual = {**PRESETS["basa2009"], "pressure_reduction": "none", "continuation": "mirror"}
    return WeaklyCompressibleSettings(**{**usual, **changes})


@pytest.mark.parametrize(
    ("speed", "viscosity", "force", "largest"),
    [(3.0, 0.1, 1.0, 9.0), (0.1, 50.0, 0.0, 0.1 * 50.0 / 0.5), (0.1, 0.1, 8.0, 8.0 * 0.5)],
)
def test_sound_speed_is_that_of_the_largest_of_three(
    speed: float, viscosity: float, force: float, largest: float
) -> None:
    problem = replace(channel()[0], speed=speed, kinematic_viscosity=viscosity, body_force=(0.0, -force), length=0.5)
    assert morris_sound_speed(problem) == pytest.approx((largest / 0.01) ** 0.5)


def test_sound_speed_can_be_given() -> None:
    assert WeaklyCompressibleFlow(*channel(sound_speed=123.0)).sound_speed == 123.0


def test_the_sound_speed_of_a_gas_follows_from_its_pressure() -> None:
    """c^2 = 1.4 p / rho."""
    flow = WeaklyCompressibleFlow(*channel(equation_of_state="ideal_gas", initial_pressure=125e3))
    assert flow.sound_speed == pytest.approx((1.4 * 125e3) ** 0.5)
    np.testing.assert_allclose(flow.energy, 125e3 / 0.4)


def test_the_time_step_is_the_least_of_its_limits() -> None:
    problem, settings = channel(reynolds=0.5)
    flow = WeaklyCompressibleFlow(problem, settings)
    h = 0.1 / 0.637
    assert flow.kernel.h == pytest.approx(h)
    assert flow.limits["cfl"] == pytest.approx(0.25 * h / (flow.sound_speed + 1.0))  # U0 = Re nu / d = 1
    assert flow.limits["viscous"] == pytest.approx(0.125 * h**2 / 1.0)
    assert flow.limits["body_force"] == pytest.approx(0.25 * (h / 8.0) ** 0.5)  # f = 2 nu^2 Re / d^3
    assert flow.time_step == min(flow.limits.values()) == flow.limits["cfl"]
    assert WeaklyCompressibleFlow(box(), conserving()).limits["body_force"] == np.inf


def test_a_time_step_beyond_its_limit_is_refused_unless_forced() -> None:
    limit = WeaklyCompressibleFlow(*channel()).time_step
    assert WeaklyCompressibleFlow(*channel(time_step=limit / 2)).time_step == limit / 2
    with pytest.raises(SphearError, match=rf"^the time step of \S+ is beyond the cfl limit of {limit:g}: .*--force$"):
        WeaklyCompressibleFlow(*channel(time_step=2 * limit))
    problem, settings = channel(sound_speed=1e-3, time_step=10.0)
    with pytest.raises(SphearError, match="body-force limit of"):
        WeaklyCompressibleFlow(replace(problem, speed=1e-3, kinematic_viscosity=1e-9), settings)
    assert WeaklyCompressibleFlow(*channel(time_step=2 * limit, force=True)).time_step == 2 * limit


@pytest.mark.parametrize("walls", ["mirror", "fixed", "adami"])
def test_a_resolution_too_coarse_for_the_walls_is_refused(walls: str) -> None:
    WeaklyCompressibleFlow(*channel(resolution=4, walls=walls))
    with pytest.raises(SphearError, match=rf"the resolution of 3 is too coarse for walls={walls}: .* 1\.04\d+ reach"):
        WeaklyCompressibleFlow(*channel(resolution=3, walls=walls))


def test_two_passes_need_twice_the_room() -> None:
    with pytest.raises(SphearError, match=r"the resolution of 6 is too coarse .* 2 supports"):
        WeaklyCompressibleFlow(*channel(resolution=6, viscosity="two_pass"))


def test_a_kernel_that_reaches_no_neighbour_is_refused() -> None:
    """The support of the cubic spline is 2 h."""
    WeaklyCompressibleFlow(*channel(h_over_dx=0.51))
    with pytest.raises(SphearError, match=r"^the setting h_over_dx must be more than 0\.5 for cubic_spline, .* 0\.5$"):
        WeaklyCompressibleFlow(*channel(h_over_dx=0.5))


@pytest.mark.parametrize("what", ["position", "velocity"])
@pytest.mark.parametrize("number", [np.nan, np.inf])
def test_a_start_that_is_no_number_is_refused(what: str, number: float) -> None:
    problem, settings = channel()
    (problem.positions if what == "position" else problem.velocities)[5, 1] = number
    with pytest.raises(SphearError, match=rf"^the initial {what} of particle 5 is not a number: .*{number}\]$"):
        WeaklyCompressibleFlow(problem, settings)


def failure(flow: WeaklyCompressibleFlow, steps: int = 1) -> tuple[float, int, Array, str]:
    """Time, particle, position and cause, read from the message."""
    with pytest.raises(FlowFailure) as caught:
        flow.advance(steps)
    found = SENTENCE.fullmatch(str(caught.value))
    assert found, str(caught.value)
    time, particle, *place, cause = found.groups()
    return float(time), int(particle), np.array(place, float), cause


@pytest.mark.parametrize("walls", ["mirror", "fixed"])
def test_a_particle_through_a_wall_is_the_one_reported(walls: str) -> None:
    """A spacing beyond a mirror, or half of one into fixed particles; not the fastest one, which stays inside."""
    problem, settings = channel(walls=walls, sound_speed=20.0, time_step=0.01, force=True)
    problem = replace(problem, kinematic_viscosity=1e-6)
    outwards, fast = int(np.argmax(problem.positions[:, 1])), 4
    problem.velocities[fast] = 19.0, 0.0
    problem.positions[outwards, 1] = 0.5 - 1e-9
    problem.velocities[outwards] = 0.0, 15.0 if walls == "mirror" else 8.0
    flow = WeaklyCompressibleFlow(problem, settings)
    time, particle, place, cause = failure(flow)
    assert (particle, flow.steps, time) == (outwards, 1, 0.01)
    assert "wall" in cause
    np.testing.assert_allclose(place, flow.positions[outwards], rtol=1e-5)
    assert place[1] > 0.5 + (0.1 if walls == "mirror" else 0.05)


def test_a_particle_through_a_mirror_changes_places_with_its_image() -> None:
    """Its velocity through the wall is reflected, that along it goes on."""
    problem, settings = channel(continuation="mirror", sound_speed=10.0, time_step=1e-6)
    one = int(np.argmax(problem.positions[:, 1]))
    problem.positions[one, 1] = 0.5 - 1e-9
    problem.velocities[one] = 0.1, 2.0
    flow = WeaklyCompressibleFlow(problem, settings)
    flow.advance(1)
    assert flow.positions[one, 1] == pytest.approx(0.5 - 2e-6, abs=1e-7)
    np.testing.assert_allclose(flow.velocities[one], (0.1, -2.0), atol=0.01)


def test_a_speed_above_that_of_sound() -> None:
    problem, settings = channel(sound_speed=30.0)
    problem.velocities[37, 0] = 45.0
    flow = WeaklyCompressibleFlow(problem, settings)
    _, particle, place, cause = failure(flow)
    assert particle == 37
    assert "speed of sound" in cause
    np.testing.assert_allclose(place, flow.positions[37], rtol=1e-5)


def test_a_number_that_is_none_leaves_the_last_good_state() -> None:
    """A pressure beyond all numbers; fast-math must not take it for finite."""
    problem, settings = channel(sound_speed=1e160)
    problem.positions[11] += 0.01
    flow = WeaklyCompressibleFlow(problem, settings)
    time, particle, place, cause = failure(flow)
    assert "not a number" in cause
    assert np.isfinite(place).all()
    assert 0 <= particle < len(problem.positions)
    assert (time, flow.steps) == (0.0, 0)
    np.testing.assert_array_equal(flow.positions, problem.positions)
    np.testing.assert_array_equal(flow.velocities, problem.velocities)


def test_a_particle_alone_has_too_few_neighbours_for_a_correction() -> None:
    problem = box()
    away = replace(problem, box=Box((0.0, 0.0), (5.0, 5.0), ("periodic", "periodic")))
    away.positions[7] = 3.0, 3.0
    time, particle, place, cause = failure(WeaklyCompressibleFlow(away, conserving(correction="bonet_lok")))
    assert (time, particle, place.tolist()) == (0.0, 7, [3.0, 3.0])
    assert "too few neighbours" in cause


@pytest.mark.parametrize("integrator", ["midpoint", "kick_drift_kick"])
def test_a_density_below_zero_is_found(integrator: Any) -> None:
    """d rho/dt = -rho div u with div u dt about 6."""
    settings = conserving(
        density="continuity", sound_speed=1e4, time_step=0.5, force=True, integrator=integrator, correction="shepard"
    )
    problem = replace(box(), velocities=np.asarray(6.0 * box().positions))
    problem.velocities[problem.positions[:, 0] > 0.5] = 0.0
    assert "density or an energy that is not positive" in failure(WeaklyCompressibleFlow(problem, settings))[3]


@pytest.mark.parametrize(("density", "form"), PAIRS)
def test_linear_momentum_is_conserved_to_rounding(density: Any, form: str) -> None:
    problem, settings = box(), conserving(density=density)
    assert settings.form == form
    flow = WeaklyCompressibleFlow(problem, settings)
    flow.advance(50)
    assert np.abs(flow.velocities - problem.velocities).max() > 0.1
    np.testing.assert_allclose(flow.velocities.sum(axis=0), problem.velocities.sum(axis=0), atol=1e-11)


@pytest.mark.parametrize(("viscosity", "kept"), [("violeau", True), ("cleary", True), ("morris", False)])
def test_forces_along_the_line_of_centres_keep_the_angular_momentum_of_a_drop(viscosity: str, kept: bool) -> None:
    """Kick-drift-kick keeps it to rounding, too: x + dt (v + dt a / 2) and half of both kicks."""
    start = box()
    drop = replace(
        start,
        positions=start.positions + 2.0,
        velocities=start.velocities + 5.0 * (start.positions - 0.5) @ np.array([[0.0, 1.0], [-1.0, 0.0]]),
        box=Box((0.0, 0.0), (5.0, 5.0), ("periodic", "periodic")),
    )
    flow = WeaklyCompressibleFlow(
        drop, conserving(viscosity=viscosity, integrator="kick_drift_kick", sound_speed=15.0, force=True)
    )

    def angular_momentum() -> Array:
        (x, y), (u, v) = flow.positions.T - 2.5, flow.velocities.T
        return np.asarray(x * v - y * u)

    before = angular_momentum()
    flow.advance(20)
    assert np.abs(flow.velocities - drop.velocities).max() > 0.1
    change = abs(angular_momentum().sum() - before.sum()) / np.abs(before).sum()
    assert change < 1e-13 if kept else change > 1e-4


def advanced(problem: Problem, settings: WeaklyCompressibleSettings, time: float, steps: int) -> WeaklyCompressibleFlow:
    """At a time, after so many steps."""
    flow = WeaklyCompressibleFlow(problem, settings.model_copy(update={"time_step": time / steps}))
    flow.advance(steps)
    return flow


@pytest.mark.parametrize(("density", "form"), PAIRS)
def test_a_gas_without_viscosity_keeps_its_energy_to_the_order_of_the_step(density: Any, form: str) -> None:
    """(8) with (11), (9) with (10), and (14)."""
    problem = smooth(viscosity=1e-15)
    settings = conserving(equation_of_state="ideal_gas", initial_pressure=10.0, density=density)
    assert settings.form == form

    def energy(flow: WeaklyCompressibleFlow) -> float:
        return float(((flow.velocities**2).sum(axis=1) / 2 + flow.energy).mean())

    before = energy(WeaklyCompressibleFlow(problem, settings))
    kinetic = (problem.velocities**2).sum(axis=1).mean() / 2
    drifts = [abs(energy(advanced(problem, settings, 0.32, steps)) - before) / kinetic for steps in (64, 128, 256)]
    assert drifts[0] < 0.01
    for coarse, fine in pairwise(drifts):
        assert 4 < coarse / fine < 8


@pytest.mark.parametrize("integrator", ["midpoint", "kick_drift_kick"])
def test_both_integrators_are_of_second_order(integrator: Any) -> None:
    """Of velocity, density and energy, all integrated."""
    problem = smooth(viscosity=0.02)
    settings = conserving(
        equation_of_state="ideal_gas", initial_pressure=10.0, density="continuity", integrator=integrator
    )
    best = advanced(problem, settings, 0.16, 1024)
    errors = []
    for steps in (32, 64, 128):
        flow = advanced(problem, settings, 0.16, steps)
        names = ("positions", "velocities", "density", "energy")
        errors.append([np.abs(getattr(flow, name) - getattr(best, name)).max() for name in names])
    orders = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
    assert (np.abs(orders - 2.0) < 0.35).all(), orders


def test_a_moving_frame_sees_the_same_flow() -> None:
    """Galilean invariance, over a periodic side."""
    rest = WeaklyCompressibleFlow(box(), conserving())
    wind = np.array([3.0, -2.0])
    moving = WeaklyCompressibleFlow(replace(box(), velocities=box().velocities + wind), conserving())
    rest.advance(20)
    moving.advance(20)
    np.testing.assert_allclose(moving.velocities - wind, rest.velocities, atol=1e-9)
    np.testing.assert_allclose((moving.positions - wind * moving.time - rest.positions + 0.5) % 1.0, 0.5, atol=1e-9)


def test_steps_can_be_made_in_parts_and_the_problem_stays_as_it_is() -> None:
    problem = box()
    whole, parts = WeaklyCompressibleFlow(problem, conserving()), WeaklyCompressibleFlow(problem, conserving())
    whole.advance(7)
    for steps in (0, 3, 4):
        parts.advance(steps)
    np.testing.assert_array_equal(whole.positions, parts.positions)
    np.testing.assert_array_equal(problem.positions, box().positions)
    assert parts.steps == 7
    assert parts.time == pytest.approx(7 * parts.time_step)


GOING_ON: dict[str, dict[str, Any]] = {
    "gas": {"equation_of_state": "ideal_gas", "initial_pressure": 10.0, "density": "continuity"},
    "kicks": {"density": "continuity", "integrator": "kick_drift_kick"},
    "drift of the step before": {"transport": "transport_velocity"},
}


@pytest.mark.parametrize("changes", GOING_ON.values(), ids=GOING_ON)
def test_a_flow_goes_on_from_its_state_bit_by_bit(changes: dict[str, Any], tmp_path: Path) -> None:
    through, kept, again = (WeaklyCompressibleFlow(box(), conserving(**changes)) for _ in range(3))
    through.advance(11)
    kept.advance(6)
    np.savez(tmp_path / "state.npz", allow_pickle=False, **kept.state())
    with np.load(tmp_path / "state.npz", allow_pickle=False) as file:
        again.restore(dict(file))
    assert (again.steps, again.time) == (6, kept.time)
    again.advance(5)
    for name, values in through.state().items():
        np.testing.assert_array_equal(again.state()[name], values, err_msg=name)


def test_a_state_in_memory_can_be_gone_back_to() -> None:
    flow = WeaklyCompressibleFlow(box(), conserving())
    flow.advance(2)
    state = flow.state()
    places = flow.positions.copy()
    flow.advance(3)
    flow.restore(state)
    np.testing.assert_array_equal(flow.positions, places)


def test_the_state_of_another_flow_is_refused() -> None:
    gas = WeaklyCompressibleFlow(*channel(equation_of_state="ideal_gas"))
    with pytest.raises(SphearError, match=r"^the saved state has no energy of the shape \(100,\): .* another flow$"):
        gas.restore(WeaklyCompressibleFlow(*channel()).state())
    with pytest.raises(SphearError, match=r"no clock of the shape \(2,\)"):
        gas.restore({})


def test_two_threads_compute_what_one_does() -> None:
    one, two = (WeaklyCompressibleFlow(*channel(threads=threads)) for threads in (1, 2))
    for flow in (one, two):
        flow.advance(10)
    np.testing.assert_allclose(two.velocities, one.velocities, rtol=1e-11, atol=1e-13)
    np.testing.assert_allclose(two.positions, one.positions, rtol=1e-11, atol=1e-13)


WRONG: dict[str, Any] = {
    "reynolds": 0.0, "resolution": 0, "until": -1.0, "max_steps": 0, "sound_speed": np.inf, "time_step": np.nan,
    "h_over_dx": 0.0, "pressure_reduction": "some", "equation_of_state": "solid", "density": "guessed",
    "momentum": "cubes", "density_diffusion": -0.1, "walls": "paper", "integrator": "euler", "transport": "train",
    "shifting_strength": 0.0, "background_pressure": 0.0, "initial": "heap", "seed": -1, "initial_pressure": 0.0,
    "threads": 0, "nonsense": 1,
}  # fmt: skip


@pytest.mark.parametrize("name", WRONG)
def test_a_setting_out_of_range_is_refused(name: str) -> None:
    with pytest.raises(ValidationError, match=name):
        WeaklyCompressibleSettings.model_validate({name: WRONG[name]})


CONTRADICTIONS: dict[str, dict[str, Any]] = {
    "momentum of the other density": {"density": "summation", "momentum": "products"},
    "momentum of the other density too": {"density": "continuity", "momentum": "squares"},
    "diffusion of a sum": {"density_diffusion": 0.1, "density": "summation"},
    "transport velocity of another density": {"transport": "transport_velocity", "density": "continuity"},
    "shifted gas": {"transport": "shifting", "equation_of_state": "ideal_gas"},
    "transported gas": {"transport": "transport_velocity", "equation_of_state": "ideal_gas"},
    "sound of a gas": {"sound_speed": 30.0, "equation_of_state": "ideal_gas"},
    "particles on fixed walls": {"wall_particles": True, "walls": "fixed"},
    "particles on Adami's walls": {"wall_particles": True, "walls": "adami"},
}


@pytest.mark.parametrize("settings", CONTRADICTIONS.values(), ids=CONTRADICTIONS)
def test_settings_that_contradict_each_other_are_both_named(settings: dict[str, Any]) -> None:
    with pytest.raises(SphearError) as caught, checked():
        WeaklyCompressibleSettings.model_validate(settings)
    sentence = str(caught.value)
    for name, value in settings.items():
        assert f"{name}={value}" in sentence or name in sentence
    assert "\n" not in sentence
    assert not sentence.endswith(".")


@pytest.mark.parametrize("case", [None, "poiseuille", "cavity"])
def test_wrong_settings_are_one_sentence_however_they_are_made(case: str | None) -> None:
    make: Any = WeaklyCompressibleSettings if case is None else FLOWS[case].settings
    with pytest.raises(SphearError, match=r"^density_diffusion smooths the continuity equation and density=summation"):
        make(density="summation", density_diffusion=0.1)
    with pytest.raises(SphearError, match=r"^the setting reynolds should be greater than 0, not -1$"):
        make(reynolds=-1)


def test_fixed_walls_cannot_mirror_velocities() -> None:
    with pytest.raises(SphearError, match=r"^walls=fixed .* continuation=linear or quadratic, not mirror$"):
        WeaklyCompressibleFlow(*channel(walls="fixed", continuation="mirror"))


@pytest.mark.parametrize("density", ["summation", "continuity"])
def test_the_momentum_that_belongs_to_a_density_can_be_named(density: Any) -> None:
    form = dict(PAIRS)[density]
    named = WeaklyCompressibleSettings.model_validate({"density": density, "momentum": form})
    assert named.form == WeaklyCompressibleSettings(density=density).form == form


@pytest.mark.parametrize("name", ["viscosity", "correction", "kernel", "continuation"])
def test_a_name_that_does_not_exist_is_refused(name: str) -> None:
    wrong: Any = {name: "nobody"}
    with pytest.raises(SphearError, match=r"there is no .* named 'nobody'"):
        WeaklyCompressibleFlow(*channel(**wrong))
