"""Plane Couette flow: its equation, its walls, its beginning and end."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sphear.errors import SphearError
from sphear.references.couette import EARLY, PlaneCouette

FLOW = PlaneCouette(gap=0.4, kinematic_viscosity=0.7, wall_velocity=-1.3)
UNIT = PlaneCouette(1.0, 1.0, 1.0)
ACROSS = np.linspace(0.0, 1.0, 41)
times = st.floats(1e-3, 2.0)  # in L^2 / nu


@given(times)
def test_velocities_are_those_of_the_series(time: float) -> None:
    n = np.arange(1, 200)[:, None]
    modes = 2.0 * (-1.0) ** n / (n * math.pi) * np.sin(n * math.pi * ACROSS) * np.exp(-(n**2) * math.pi**2 * time)
    np.testing.assert_allclose(UNIT.velocity(ACROSS, time), ACROSS + modes[::-1].sum(axis=0), rtol=0, atol=1e-14)


def test_both_sums_are_one_function() -> None:
    before, after = (UNIT.velocity(ACROSS, EARLY * (1.0 + x)) for x in (-1e-15, 1e-15))
    np.testing.assert_allclose(before, after, rtol=1e-13, atol=1e-15)


@given(st.floats(0.01, 2.0))
def test_the_equation_of_motion(time: float) -> None:
    """du/dt = nu d2u/dy2, by differences of fourth order."""
    gap, nu = FLOW.gap, FLOW.kinematic_viscosity
    t, dt, dy = time * gap**2 / nu, 1e-3 * time * gap**2 / nu, 2e-3 * gap * math.sqrt(time)
    y = gap * (0.05 + 0.9 * ACROSS)
    first, second = (1, -8, 0, 8, -1), (-1, 16, -30, 16, -1)
    rate = sum(c * FLOW.velocity(y, t + k * dt) for c, k in zip(first, range(-2, 3), strict=True)) / (12 * dt)
    bend = sum(c * FLOW.velocity(y + k * dy, t) for c, k in zip(second, range(-2, 3), strict=True)) / (12 * dy**2)
    np.testing.assert_allclose(rate, nu * bend, rtol=0, atol=1e-6 * abs(FLOW.wall_velocity) * nu / gap**2)


@given(st.floats(0.0, 1e3))
def test_the_fluid_has_the_velocities_of_the_walls(time: float) -> None:
    still, moving = FLOW.velocity([0.0, FLOW.gap], time)
    assert still == 0.0
    assert moving == pytest.approx(FLOW.wall_velocity, rel=1e-15)
    for rounding in (-1e-15, 1e-15):
        beside = FLOW.velocity([rounding, FLOW.gap * (1 + rounding)], time)
        np.testing.assert_array_equal(beside, [still, moving])


@pytest.mark.parametrize("time", [0.0, 5e-324, 1e-300, 1e-30])
def test_it_starts_from_rest(time: float) -> None:
    np.testing.assert_array_equal(FLOW.velocity(0.99 * FLOW.gap * ACROSS, time), 0.0)


def test_soon_after_the_start_it_is_the_layer_of_one_wall() -> None:
    """Stokes's first problem: U erfc(distance / sqrt(4 nu t)), to the last digit however small."""
    distance = np.array([0.0, 0.05, 0.1, 0.3])
    expected = [math.erfc(x / math.sqrt(4e-3)) for x in distance]
    assert expected[-1] < 1e-10
    np.testing.assert_allclose(UNIT.velocity(1.0 - distance, 1e-3), expected, rtol=1e-12)


def test_it_ends_in_uniform_shear() -> None:
    y = FLOW.gap * ACROSS
    expected = FLOW.wall_velocity * ACROSS
    np.testing.assert_allclose(FLOW.steady(y), expected, rtol=1e-15, atol=1e-15)
    np.testing.assert_allclose(FLOW.velocity(y, 5.0 * FLOW.gap**2 / FLOW.kinematic_viscosity), expected, rtol=1e-13)
    assert FLOW.reynolds == pytest.approx(1.3 * 0.4 / 0.7)


@given(times, st.floats(1.0001, 3.0))
def test_the_flow_only_gains_speed(time: float, factor: float) -> None:
    inside = ACROSS[1:-1]
    assert (UNIT.velocity(inside, factor * time) >= UNIT.velocity(inside, time) * (1 - 1e-14)).all()


def test_beyond_the_walls_there_is_no_velocity() -> None:
    for time in (0.0, 0.01, 1.0, math.inf):
        np.testing.assert_array_equal(np.isnan(UNIT.velocity([-0.1, 0.0, 0.5, 1.0, 1.0001], time)), [1, 0, 0, 0, 1])


def test_shapes_are_kept() -> None:
    for shape in ((), (3,), (2, 4)):
        for time in (0.0, 0.01, 1.0):
            assert UNIT.velocity(np.zeros(shape), time).shape == shape


@pytest.mark.parametrize("value", [0.0, -1.0, math.nan, math.inf])
def test_parameters_that_are_not_positive_are_refused(value: float) -> None:
    with pytest.raises(SphearError, match=f"the gap must be positive, not {value}$"):
        PlaneCouette(value, 1.0, 1.0)
    with pytest.raises(SphearError, match=f"the kinematic viscosity must be positive, not {value}$"):
        PlaneCouette(1.0, value, 1.0)


def test_other_parameters_are_checked_too() -> None:
    with pytest.raises(SphearError, match=r"the wall velocity must be finite, not inf$"):
        PlaneCouette(1.0, 1.0, math.inf)
    for time in (-1e-9, math.nan):
        with pytest.raises(SphearError, match=f"must not be negative, it is {time}$"):
            UNIT.velocity(0.0, time)
