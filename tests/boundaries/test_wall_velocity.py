"""Velocities behind walls: what each rule continues exactly."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from sphear.boundaries import WALL_VELOCITIES, Box

Array = np.ndarray[Any, Any]
SPACING = 0.1
DEPTHS = np.array([0.01, 0.1, 0.3])


def places(axis: int) -> Array:
    """Disordered particles between walls at -0.3 and 0.7 along one axis."""
    x = np.random.default_rng(0).random((200, 2))
    x[:, axis] -= 0.3
    return x


def continued(rule: str, profile: Callable[[Array], Array], axis: int = 1, **walls: tuple[float, float]) -> Array:
    """The tangential velocity at depths behind the lower and the upper wall, (2, depths)."""
    sides: tuple[Any, ...] = ("periodic", "walls") if axis else ("walls", "periodic")
    lower_corner = tuple(-0.3 if k == axis else 0.0 for k in range(2))
    upper_corner = tuple(0.7 if k == axis else 1.0 for k in range(2))
    box = Box(lower_corner, upper_corner, sides, **walls)
    lower, upper, _, velocities = box.arrays()
    x = places(axis)
    v = np.zeros_like(x)
    v[:, 1 - axis] = profile(x[:, axis])
    a, b = np.zeros((2, 2)), np.zeros((2, 2))
    WALL_VELOCITIES[rule](x, v, lower, upper, axis, velocities, SPACING, a, b)
    along = 1 - axis
    continued: Array = velocities[:, [along]] - a[:, [along]] * DEPTHS + b[:, [along]] * DEPTHS**2
    return continued


def expected(profile: Callable[[Array], Array]) -> Array:
    return np.stack((profile(-0.3 - DEPTHS), profile(0.7 + DEPTHS)))


def shear(y: Array) -> Array:
    return 3.0 * y + 0.5


def poiseuille(y: Array) -> Array:
    return (y + 0.3) * (0.7 - y)


def walls(profile: Callable[[Array], Array], axis: int = 1) -> dict[str, Any]:
    """The walls' velocities of a profile."""
    ends = profile(np.array([-0.3, 0.7]))
    return {
        name: (float(end), 0.0) if axis else (0.0, float(end))
        for name, end in zip(("lower_velocity", "upper_velocity"), ends, strict=True)
    }


@pytest.mark.parametrize("rule", ["linear", "quadratic", "global_quadratic"])
@pytest.mark.parametrize("axis", [0, 1])
def test_linear_shear_between_moving_walls_goes_on(rule: str, axis: int) -> None:
    found = continued(rule, shear, axis, **walls(shear, axis))
    np.testing.assert_allclose(found, expected(shear), rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("rule", ["quadratic", "global_quadratic"])
def test_a_parabola_between_walls_at_rest_goes_on(rule: str) -> None:
    np.testing.assert_allclose(continued(rule, poiseuille), expected(poiseuille), rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("rule", ["quadratic", "global_quadratic"])
def test_a_parabola_between_moving_walls_goes_on(rule: str) -> None:
    def profile(y: Array) -> Array:
        return np.asarray(2.0 - shear(y) + 4.0 * poiseuille(y))

    np.testing.assert_allclose(continued(rule, profile, **walls(profile)), expected(profile), rtol=1e-9, atol=1e-9)


def test_quadratic_sees_each_wall_alone() -> None:
    """Other parabolas within two spacings of each wall, and anything between them."""

    def profile(y: Array) -> Array:
        from_lower, from_upper = y + 0.3, 0.7 - y
        inner = np.where(from_upper < 0.21, from_upper - 5 * from_upper**2, 7.0)
        return np.asarray(np.where(from_lower < 0.21, 2 * from_lower + from_lower**2, inner))

    np.testing.assert_allclose(continued("quadratic", profile), expected(profile), rtol=1e-9, atol=1e-9)


def test_linear_fits_the_particles_within_one_spacing() -> None:
    def profile(y: Array) -> Array:
        return np.asarray(np.where(y < -0.2, 2 * (y + 0.3) ** 2, 9.0))

    near = places(1)[:, 1] + 0.3
    near = near[near < SPACING]
    slope = np.sum(2 * near**3) / np.sum(near**2)
    np.testing.assert_allclose(continued("linear", profile)[0], -slope * DEPTHS, rtol=1e-12)


@pytest.mark.parametrize("rule", ["linear", "quadratic", "global_quadratic"])
def test_nothing_near_a_wall_leaves_its_velocity(rule: str) -> None:
    a, b = np.zeros((2, 2)), np.zeros((2, 2))
    nobody = np.zeros((0, 2))
    corners = np.zeros(2), np.ones(2)
    WALL_VELOCITIES[rule](nobody, nobody, *corners, 1, np.zeros((2, 2)), SPACING, a, b)
    assert not a.any()
    assert not b.any()


def test_mirror_fits_nothing() -> None:
    np.testing.assert_allclose(continued("mirror", shear, **walls(shear)), [[-0.4] * 3, [2.6] * 3])


def test_names() -> None:
    assert WALL_VELOCITIES.name("mirroring") == "mirror"
    assert WALL_VELOCITIES.name("global") == "global_quadratic"
