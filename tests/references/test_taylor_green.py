"""Taylor-Green vortices: the Navier-Stokes equations by differences, the period, and the decay of the energy."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sphear.errors import SphearError
from sphear.references.taylor_green import TaylorGreen

FLOW = TaylorGreen(kinematic_viscosity=0.03, side=1.7, speed=2.5, density=1.2)
POINTS = np.random.default_rng(3).uniform(-2.0, 2.0, (50, 2))
times = st.floats(0.0, 3.0)
Field = Callable[[Any], Any]

FIRST = np.array([1, -8, 0, 8, -1]) / 12.0
SECOND = np.array([-1, 16, -30, 16, -1]) / 12.0


def derivative(f: Field, x: Any, step: Any, coefficients: Any = FIRST) -> Any:
    """A derivative by differences of fourth order, along `step`."""
    size = np.linalg.norm(step)
    order = 1 if coefficients is FIRST else 2
    return sum(c * f(x + k * step) for c, k in zip(coefficients, range(-2, 3), strict=True)) / size**order


AXES = 2e-3 * FLOW.side * np.eye(2)


@given(times)
def test_the_equations_of_motion(time: float) -> None:
    """du/dt + u . grad u = -grad p / rho + nu lap u, and div u = 0."""
    u = FLOW.velocity(POINTS, time)
    size = FLOW.speed**2 / FLOW.side

    def velocity(x: Any) -> Any:
        return FLOW.velocity(x, time)

    rate = derivative(lambda t: FLOW.velocity(POINTS, t), time, 1e-3)
    slopes = [derivative(velocity, POINTS, axis) for axis in AXES]
    convection = sum(u[:, [k]] * slopes[k] for k in range(2))
    laplacian = sum(derivative(velocity, POINTS, axis, SECOND) for axis in AXES)
    push = np.stack([derivative(lambda x: FLOW.pressure(x, time), POINTS, axis) for axis in AXES], axis=-1)
    right = -push / FLOW.density + FLOW.kinematic_viscosity * laplacian
    np.testing.assert_allclose(rate + convection, right, rtol=0, atol=1e-6 * size)
    np.testing.assert_allclose(slopes[0][:, 0] + slopes[1][:, 1], 0.0, atol=1e-9 * FLOW.speed / FLOW.side)


def lattice(n: int) -> np.ndarray:
    axis = (np.arange(n) + 0.5) / n * FLOW.side
    return np.stack(np.meshgrid(axis, axis), axis=-1)


@given(times)
def test_energy_and_pressure_are_integrals_over_the_box(time: float) -> None:
    """The mean over a lattice of a period is exact for these waves."""
    places = lattice(8)
    speed2 = np.sum(FLOW.velocity(places, time) ** 2, axis=-1)
    energy = 0.5 * FLOW.density * speed2.mean() * FLOW.side**2
    assert FLOW.kinetic_energy(time) == pytest.approx(energy, rel=1e-12)
    assert FLOW.pressure(places, time).mean() == pytest.approx(0.0, abs=1e-13)


def test_the_energy_of_the_unit_box() -> None:
    flow = TaylorGreen(0.01)
    assert flow.reynolds == pytest.approx(100.0)
    for time in (0.0, 0.5, 2.0):
        assert flow.kinetic_energy(time) == pytest.approx(0.25 * math.exp(-16 * math.pi**2 * 0.01 * time), rel=1e-14)
        assert flow.decay(time) ** 2 == pytest.approx(4.0 * flow.kinetic_energy(time))


def test_the_beginning() -> None:
    flow = TaylorGreen(0.01)
    np.testing.assert_allclose(flow.velocity([[0.0, 0.25], [0.25, 0.0], [0.125, 0.125]], 0.0),
                               [[-1.0, 0.0], [0.0, 1.0], [-0.5, 0.5]], atol=1e-15)  # fmt: skip
    np.testing.assert_allclose(flow.pressure([[0.0, 0.0], [0.25, 0.25], [0.125, 0.125]], 0.0), [-0.5, 0.5, 0.0],
                               atol=1e-15)  # fmt: skip
    assert np.abs(FLOW.velocity(lattice(64), 0.0)).max() <= FLOW.speed


@given(times)
def test_the_box_is_periodic(time: float) -> None:
    for shift in (FLOW.side, np.array([FLOW.side, 0.0]), np.array([0.0, -3.0 * FLOW.side])):
        np.testing.assert_allclose(FLOW.velocity(POINTS + shift, time), FLOW.velocity(POINTS, time), atol=1e-13)
        np.testing.assert_allclose(FLOW.pressure(POINTS + shift, time), FLOW.pressure(POINTS, time), atol=1e-13)


def test_nothing_is_left_in_the_end() -> None:
    assert FLOW.kinetic_energy(math.inf) == 0.0
    np.testing.assert_array_equal(FLOW.velocity(POINTS, math.inf), 0.0)


def test_shapes() -> None:
    for shape in ((), (3,), (2, 4)):
        assert FLOW.velocity(np.zeros((*shape, 2)), 0.1).shape == (*shape, 2)
        assert FLOW.pressure(np.zeros((*shape, 2)), 0.1).shape == shape
    for positions in (np.zeros((4, 3)), np.zeros(4), 1.0):
        with pytest.raises(SphearError, match="positions must have two components"):
            FLOW.velocity(positions, 0.1)


@pytest.mark.parametrize("name", ["kinematic_viscosity", "side", "speed", "density"])
@pytest.mark.parametrize("value", [0.0, -1.0, math.nan, math.inf])
def test_parameters_that_are_not_positive_are_refused(name: str, value: float) -> None:
    arguments = {"kinematic_viscosity": 1.0} | {name: value}
    with pytest.raises(SphearError, match=f"the {name.replace('_', ' ')} must be positive, not {value}$"):
        TaylorGreen(**arguments)
