"""Plane Poiseuille flow: its equation, its walls, its beginning and end, and the tabulated series."""

from __future__ import annotations

import math
from importlib.resources import files

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sphear.errors import SphearError
from sphear.references.poiseuille import EARLY, PlanePoiseuille, rms_error

FLOW = PlanePoiseuille(half_width=0.3, kinematic_viscosity=0.7, body_force=-1.9)
UNIT = PlanePoiseuille(1.0, 1.0, 2.0)  # U0 = 1
ACROSS = np.linspace(-1.0, 1.0, 41)
times = st.floats(1e-4, 3.0)  # in d^2 / nu


def series(y: np.ndarray, time: float, terms: int = 20000) -> np.ndarray:
    """The start-up series of UNIT as it is written down, with a fixed number of terms."""
    n = np.arange(terms)[:, None]
    k = 2 * n + 1
    modes = (-1.0) ** n / k**3 * np.cos(0.5 * k * math.pi * y) * np.exp(-(k**2) * math.pi**2 * time / 4.0)
    return np.asarray(1.0 - y**2 - 32.0 / math.pi**3 * modes[::-1].sum(axis=0))


def test_the_tabulated_series() -> None:
    file = files("sphear.references").joinpath("data", "poiseuille_unsteady_series.csv")
    lines = [line for line in file.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    names, rows = lines[0].split(","), np.array([line.split(",") for line in lines[1:]], dtype=float)
    assert names[0] == "y_over_d"
    assert len(names) == 9
    for name, column in zip(names[1:], rows.T[1:], strict=True):
        np.testing.assert_allclose(UNIT.velocity(rows[:, 0], float(name.removeprefix("T"))), column, rtol=0, atol=6e-9)


@given(times)
def test_velocities_are_those_of_the_series(time: float) -> None:
    np.testing.assert_allclose(UNIT.velocity(ACROSS, time), series(ACROSS, time), rtol=0, atol=1e-14)


def test_both_sums_are_one_function() -> None:
    before, after = (UNIT.velocity(ACROSS, EARLY * (1.0 + x)) for x in (-1e-15, 1e-15))
    np.testing.assert_allclose(before, after, rtol=2e-14)


@given(st.floats(0.01, 2.5))
def test_the_equation_of_motion(time: float) -> None:
    """dU/dt = f + nu d2U/dy2, by differences of fourth order."""
    d, nu, f = FLOW.half_width, FLOW.kinematic_viscosity, FLOW.body_force
    t, dt, dy = time * d**2 / nu, 1e-3 * time * d**2 / nu, 2e-3 * d * math.sqrt(time)
    y = 0.9 * d * ACROSS
    first, second = (1, -8, 0, 8, -1), (-1, 16, -30, 16, -1)
    rate = sum(c * FLOW.velocity(y, t + k * dt) for c, k in zip(first, range(-2, 3), strict=True)) / (12 * dt)
    bend = sum(c * FLOW.velocity(y + k * dy, t) for c, k in zip(second, range(-2, 3), strict=True)) / (12 * dy**2)
    np.testing.assert_allclose(rate, f + nu * bend, rtol=0, atol=1e-7 * abs(f))


@given(st.floats(0.0, 1e3))
def test_the_walls_hold_the_fluid_and_both_halves_are_alike(time: float) -> None:
    d = FLOW.half_width
    np.testing.assert_array_equal(FLOW.velocity([-d, d, d * (1 + 1e-15), -d * (1 - 1e-15)], time), 0.0)
    np.testing.assert_array_equal(FLOW.velocity(d * ACROSS, time), FLOW.velocity(-d * ACROSS, time))


@pytest.mark.parametrize("time", [0.0, 5e-324, 1e-300, 1e-30])
def test_it_starts_from_rest(time: float) -> None:
    velocities = FLOW.velocity(0.99 * FLOW.half_width * ACROSS, time)
    if time == 0.0:
        np.testing.assert_array_equal(velocities, 0.0)
    np.testing.assert_allclose(velocities, FLOW.body_force * time, rtol=1e-14, atol=1e-322)


def test_it_ends_in_the_parabola() -> None:
    d, nu, f = FLOW.half_width, FLOW.kinematic_viscosity, FLOW.body_force
    y = d * ACROSS
    parabola = f / (2 * nu) * (d**2 - y**2)
    np.testing.assert_allclose(FLOW.steady(y), parabola, rtol=1e-13)
    np.testing.assert_allclose(FLOW.velocity(y, FLOW.time(40.0)), parabola, rtol=1e-13)
    assert FLOW.steady(0.0) == FLOW.centreline_velocity == pytest.approx(f * d**2 / (2 * nu))
    remaining = FLOW.velocity(0.0, FLOW.time(5.0)) / FLOW.centreline_velocity
    assert 1.0 - remaining == pytest.approx(32 / math.pi**3 * math.exp(-5.0), rel=1e-12)


@given(times, st.floats(1.0001, 3.0))
def test_the_flow_only_gains_speed(time: float, factor: float) -> None:
    inside = 0.99 * ACROSS
    assert (UNIT.velocity(inside, factor * time) > UNIT.velocity(inside, time)).all()


@given(times, st.floats(1e-9, 0.01))
def test_velocities_near_the_wall_keep_their_digits(time: float, distance: float) -> None:
    """Beside a wall the velocity is the shear there times the distance, and the error (38) is relative."""
    distance *= math.sqrt(min(time, 1.0))
    near, nearer = UNIT.velocity([1.0 - distance, 1.0 - 0.5 * distance], time)
    assert near / (1.0 - (1.0 - distance)) == pytest.approx(nearer / (1.0 - (1.0 - 0.5 * distance)), rel=0.02)


def test_beyond_the_walls_there_is_no_velocity() -> None:
    for time in (0.0, 0.01, 1.0, math.inf):
        np.testing.assert_array_equal(np.isnan(UNIT.velocity([-1.1, -1.0, 0.0, 1.0, 1.0001], time)), [1, 0, 0, 0, 1])


def test_the_dimensionless_time() -> None:
    """Equation 39; the slowest mode decays by e in a unit of it."""
    assert PlanePoiseuille(0.5, 1.0, 1.0).dimensionless_time(0.25) == pytest.approx(math.pi**2 / 4)
    assert FLOW.time(FLOW.dimensionless_time(0.123)) == pytest.approx(0.123)
    end = FLOW.centreline_velocity
    left = [float(end - FLOW.velocity(0.0, FLOW.time(t))) for t in (4.0, 5.0)]
    assert left[0] / left[1] == pytest.approx(math.e, rel=1e-10)


def test_the_flow_of_a_reynolds_number() -> None:
    flow = PlanePoiseuille.of_reynolds(0.5)
    assert (flow.half_width, flow.kinematic_viscosity, flow.body_force) == (0.5, 1.0, 8.0)
    assert flow.reynolds == pytest.approx(0.5)
    assert flow.centreline_velocity == pytest.approx(1.0)
    assert PlanePoiseuille.of_reynolds(30.0, 2.0, 0.1).reynolds == pytest.approx(30.0)


def test_shapes_are_kept() -> None:
    for shape in ((), (3,), (2, 4)):
        for time in (0.0, 0.01, 1.0):
            assert UNIT.velocity(np.zeros(shape), time).shape == shape


def test_the_error_of_some_velocities() -> None:
    """Equation 38, with the particle at rest left out of the mean and of the number."""
    assert rms_error([1.1, 1.8], [1.0, 2.0]) == pytest.approx(0.1)
    assert rms_error([1.1, 1.8, 0.0], [1.0, 2.0, 0.0]) == pytest.approx(0.1)
    assert rms_error([1.1, 1.8, 7.0], [1.0, 2.0, 0.0]) == pytest.approx(0.1)
    assert rms_error([1.0, 2.2], [1.0, 2.0]) == pytest.approx(0.1 / math.sqrt(2.0))


def test_the_error_where_all_is_at_rest() -> None:
    assert rms_error([0.0, 0.0], [0.0, 0.0]) == 0.0
    assert rms_error([0.0, 1e-9], [0.0, 0.0]) == math.inf


@pytest.mark.parametrize("computed", [[1.0, math.nan], [1.0, math.inf]])
def test_the_error_of_a_lost_particle_is_infinite(computed: list[float]) -> None:
    assert rms_error(computed, [1.0, 1.0]) == math.inf
    assert rms_error([0.1, 0.1], UNIT.velocity([0.5, 1.5], 0.1)) == math.inf


@pytest.mark.parametrize(("computed", "exact"), [([], []), ([1.0], [1.0, 2.0])])
def test_an_error_needs_pairs(computed: list[float], exact: list[float]) -> None:
    with pytest.raises(SphearError, match="as many computed as exact velocities"):
        rms_error(computed, exact)


@pytest.mark.parametrize("value", [0.0, -1.0, math.nan, math.inf])
def test_parameters_that_are_not_positive_are_refused(value: float) -> None:
    with pytest.raises(SphearError, match=f"the half width must be positive, not {value}$"):
        PlanePoiseuille(value, 1.0, 1.0)
    with pytest.raises(SphearError, match=f"the kinematic viscosity must be positive, not {value}$"):
        PlanePoiseuille(1.0, value, 1.0)
    with pytest.raises(SphearError, match=f"the Reynolds number must be positive, not {value}$"):
        PlanePoiseuille.of_reynolds(value)
    with pytest.raises(SphearError, match=f"the half width must be positive, not {value}$"):
        PlanePoiseuille.of_reynolds(1.0, half_width=value)


def test_other_parameters_are_checked_too() -> None:
    with pytest.raises(SphearError, match=r"the body force must be finite, not nan$"):
        PlanePoiseuille(1.0, 1.0, math.nan)
    for time in (-1e-9, math.nan):
        with pytest.raises(SphearError, match=f"must not be negative, it is {time}$"):
            UNIT.velocity(0.0, time)
