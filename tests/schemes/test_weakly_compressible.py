"""The scheme around its steps: sound speed, time step, resolution, failures and conservation."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from pydantic import ValidationError

from sphear import SphearError
from sphear.boundaries import Box
from sphear.cases.flow import FLOWS
from sphear.schemes.settings import FlowSettings
from sphear.schemes.flow import Flow, FlowFailure
from sphear.schemes.problem import Problem, morris_sound_speed

Array = np.ndarray[Any, Any]

# one sentence: when, which particle, where and why
SENTENCE = re.compile(r"the flow failed at t = (\S+), particle (\d+) at \((\S+), (\S+)\): ([a-z].*[^.])")


def channel(resolution: int = 10, **changes: Any) -> tuple[Problem, FlowSettings]:
    settings = FLOWS["poiseuille"].settings(resolution=resolution, **changes)
    return FLOWS["poiseuille"].problem(settings), settings


def box(velocity_scale: float = 1.0) -> Problem:
    """Jittered particles with random velocities in a periodic box."""
    generator = np.random.default_rng(0)
    ticks = (np.arange(12) + 0.5) / 12
    lattice = np.stack(np.meshgrid(ticks, ticks, indexing="ij"), axis=-1).reshape(-1, 2)
    return Problem(
        positions=lattice + 0.02 * generator.random(lattice.shape),
        velocities=velocity_scale * generator.normal(size=lattice.shape),
        box=Box((0.0, 0.0), (1.0, 1.0), ("periodic", "periodic")),
        body_force=(0.0, 0.0),
        spacing=1 / 12,
        density=2.0,
        kinematic_viscosity=0.1,
        speed=4.0,
        length=1.0,
    )


def conserving(**changes: Any) -> FlowSettings:
    """Morris without pressure reduction; the rule for walls, which there are none of, is that of another test."""
    return FlowSettings(pressure_reduction="none", wall_velocity="mirror", **changes)


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
    assert Flow(*channel(sound_speed=123.0)).sound_speed == 123.0


def test_the_time_step_is_the_least_of_its_limits() -> None:
    problem, settings = channel(reynolds=0.5)
    flow = Flow(problem, settings)
    h = 0.1 / 0.637
    assert flow.kernel.h == pytest.approx(h)
    assert flow.limits["cfl"] == pytest.approx(0.25 * h / (flow.sound_speed + 1.0))  # U0 = Re nu / d = 1
    assert flow.limits["viscous"] == pytest.approx(0.125 * h**2 / 1.0)
    assert flow.limits["body_force"] == pytest.approx(0.25 * (h / 8.0) ** 0.5)  # f = 2 nu^2 Re / d^3
    assert flow.time_step == min(flow.limits.values()) == flow.limits["cfl"]
    assert Flow(box(), conserving()).limits["body_force"] == np.inf


def test_a_time_step_beyond_its_limit_is_refused_unless_forced() -> None:
    limit = Flow(*channel()).time_step
    assert Flow(*channel(time_step=limit / 2)).time_step == limit / 2
    with pytest.raises(SphearError, match=rf"^the time step of \S+ is beyond the cfl limit of {limit:g}: .*--force$"):
        Flow(*channel(time_step=2 * limit))
    problem, settings = channel(sound_speed=1e-3, time_step=10.0)
    with pytest.raises(SphearError, match="body-force limit of"):
        Flow(replace(problem, speed=1e-3, kinematic_viscosity=1e-9), settings)
    assert Flow(*channel(time_step=2 * limit, force=True)).time_step == 2 * limit


def test_a_resolution_too_coarse_for_mirror_particles_is_refused() -> None:
    Flow(*channel(resolution=4))
    with pytest.raises(SphearError, match=r"the resolution of 3 is too coarse .* support of 1\.04\d+ reach"):
        Flow(*channel(resolution=3))


def test_two_passes_need_twice_the_room() -> None:
    with pytest.raises(SphearError, match=r"the resolution of 6 is too coarse .* 2 supports"):
        Flow(*channel(resolution=6, viscosity="two_pass"))


def failure(flow: Flow, steps: int = 1) -> tuple[float, int, Array, str]:
    """Time, particle, position and cause, read from the message."""
    with pytest.raises(FlowFailure) as caught:
        flow.advance(steps)
    found = SENTENCE.fullmatch(str(caught.value))
    assert found, str(caught.value)
    time, particle, *place, cause = found.groups()
    return float(time), int(particle), np.array(place, float), cause


def test_a_particle_through_a_wall_is_the_one_reported() -> None:
    """Not the fastest one, which stays inside."""
    problem, settings = channel()
    outwards, fast = int(np.argmax(problem.positions[:, 1])), 4
    problem.velocities[fast] = 7.0, 0.0
    problem.positions[outwards, 1] = 0.5 - 1e-9
    problem.velocities[outwards] = 0.0, 4.0
    flow = Flow(problem, settings)
    time, particle, place, cause = failure(flow, 100)
    assert particle == outwards
    assert "wall" in cause
    assert place[1] >= 0.5 or flow.positions[outwards, 1] > 0.5
    assert time == pytest.approx(flow.steps * flow.time_step)
    assert flow.steps < 100


def test_a_speed_above_that_of_sound() -> None:
    problem, settings = channel(sound_speed=30.0)
    problem.velocities[37, 0] = 45.0
    flow = Flow(problem, settings)
    _, particle, place, cause = failure(flow)
    assert particle == 37
    assert "speed of sound" in cause
    np.testing.assert_allclose(place, flow.positions[37], rtol=1e-5)


def test_a_number_that_is_none_leaves_the_last_good_state() -> None:
    """A pressure beyond all numbers; fast-math must not take it for finite."""
    problem, settings = channel(sound_speed=1e160)
    problem.positions[11] += 0.01
    flow = Flow(problem, settings)
    time, particle, place, cause = failure(flow)
    assert "not a number" in cause
    assert np.isfinite(place).all()
    assert 0 <= particle < len(problem.positions)
    assert (time, flow.steps) == (0.0, 0)
    np.testing.assert_array_equal(flow.positions, problem.positions)
    np.testing.assert_array_equal(flow.velocities, problem.velocities)


def test_a_velocity_that_is_no_number_is_found() -> None:
    problem, settings = channel()
    problem.velocities[5, 1] = np.nan
    assert "not a number" in failure(Flow(problem, settings))[3]


def test_linear_momentum_is_conserved_to_rounding() -> None:
    problem = box()
    flow = Flow(problem, conserving())
    before = problem.velocities.sum(axis=0)
    flow.advance(50)
    assert np.abs(flow.velocities - problem.velocities).max() > 0.1
    np.testing.assert_allclose(flow.velocities.sum(axis=0), before, atol=1e-11)


def test_a_moving_frame_sees_the_same_flow() -> None:
    """Galilean invariance, over a periodic side."""
    rest = Flow(box(), conserving())
    wind = np.array([3.0, -2.0])
    moving = Flow(replace(box(), velocities=box().velocities + wind), conserving())
    rest.advance(20)
    moving.advance(20)
    np.testing.assert_allclose(moving.velocities - wind, rest.velocities, atol=1e-9)
    np.testing.assert_allclose((moving.positions - wind * moving.time - rest.positions + 0.5) % 1.0, 0.5, atol=1e-9)


def test_steps_can_be_made_in_parts_and_the_problem_stays_as_it_is() -> None:
    problem = box()
    whole, parts = Flow(problem, conserving()), Flow(problem, conserving())
    whole.advance(7)
    for steps in (0, 3, 4):
        parts.advance(steps)
    np.testing.assert_array_equal(whole.positions, parts.positions)
    np.testing.assert_array_equal(problem.positions, box().positions)
    assert parts.steps == 7
    assert parts.time == pytest.approx(7 * parts.time_step)


WRONG: dict[str, Any] = {
    "reynolds": 0.0, "resolution": 0, "until": -1.0, "max_steps": 0, "sound_speed": np.inf, "time_step": np.nan,
    "h_over_dx": 0.0, "pressure_reduction": "some", "equation_of_state": "ideal_gas", "nonsense": 1,
}  # fmt: skip


@pytest.mark.parametrize("name", WRONG)
def test_a_setting_out_of_range_is_refused(name: str) -> None:
    with pytest.raises(ValidationError, match=name):
        FlowSettings.model_validate({name: WRONG[name]})


@pytest.mark.parametrize("name", ["viscosity", "correction", "kernel", "wall_velocity"])
def test_a_name_that_does_not_exist_is_refused(name: str) -> None:
    wrong: Any = {name: "nobody"}
    with pytest.raises(SphearError, match=r"there is no .* named 'nobody'"):
        Flow(*channel(**wrong))


def test_a_correction_beside_a_self_corrected_term_is_refused() -> None:
    with pytest.raises(SphearError, match="carries its own correction"):
        Flow(*channel(viscosity="schwaiger", correction="shepard"))
