"""Fields at points and behind walls, and normal derivatives, from disordered particles."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sphear import WendlandC2
from sphear.boundaries.continuations import LeaningParabola, Line
from sphear.boundaries.models.wall_fit import WallFit, WallWeights
from sphear.interactions.normal_derivative import NormalFit, NormalWeights
from sphear.interactions.point_fit import PointFit, PointWeights
from sphear.neighbours.points import sorted_particles
from sphear.schemes.incompressible.particle_sums import ParticleSums
from sphear.schemes.incompressible.wall_rows import FittedRows
from tests.pair_matrix import pair_matrix
from tests.particles import Array, jittered

KERNEL = WendlandC2(1.5)
SMALL = st.floats(-3.0, 3.0)


def rows(points: Array, particles: Array, weights: Any, fit: Any, **fields: Array) -> Array:
    """The weights (points, particles) of a fit around points, which have no volume themselves."""
    count, everything = len(points), len(points) + len(particles)
    of_points = {"volume": np.zeros(count)} | {name: values[:count] for name, values in fields.items()}
    of_particles = {"volume": np.ones(len(particles))} | {name: values[count:] for name, values in fields.items()}
    around = sorted_particles(particles, KERNEL.radius, None)
    fitted = FittedRows(points, KERNEL.radius, fit, weights, of_points)
    matrix = fitted.matrix(around, of_particles, np.arange(count, everything), everything, 1).toarray()
    assert not matrix[:, : len(points)].any()
    return np.asarray(matrix[:, len(points) :])


def at_points(points: Array, particles: Array, order: int = 1) -> Array:
    return rows(points, particles, PointWeights(KERNEL), PointFit(KERNEL, order=order))


class Wall:
    """The half-plane before the line through the origin with the normal (-sin, cos) of an angle."""

    def __init__(self, angle: float, seed: int, depths: Array) -> None:
        self.normal = np.array([-np.sin(angle), np.cos(angle)])
        along = np.array([self.normal[1], -self.normal[0]])
        local = jittered((9, 7), 0.5, seed) - np.array([4.5, 0.0])
        self.particles = local[:, :1] * along + local[:, 1:] * self.normal
        self.distance = local[:, 1]
        self.places = local[:, 0]
        self.feet = np.linspace(-1.2, 1.3, len(depths))[:, None] * along
        self.depths = depths

    def rows(self, curve: Line) -> Array:
        depth = np.concatenate((self.depths, self.distance))
        normal = np.concatenate((np.tile(self.normal, (len(self.depths), 1)), np.zeros_like(self.particles)))
        weights, fit = WallWeights(KERNEL, curve), WallFit(KERNEL, curve)
        return rows(self.feet, self.particles, weights, fit, depth=depth, normal=normal)


DEPTHS = np.array([0.0, 0.5, 1.5, 2.5])


@given(seed=st.integers(0, 99), field=st.tuples(SMALL, SMALL, SMALL))
def test_a_plane_is_found_at_any_point(seed: int, field: tuple[float, float, float]) -> None:
    particles = jittered((7, 7), 0.7, seed)
    points = np.random.default_rng(seed).uniform(2.0, 5.0, (6, 2))
    points[0] = particles[24]  # on a particle
    found = at_points(points, particles)
    a, b, c = field
    np.testing.assert_allclose(
        found @ (a + b * particles[:, 0] + c * particles[:, 1]), a + points @ np.array([b, c]), atol=1e-10
    )
    np.testing.assert_allclose(found.sum(axis=1), 1.0, atol=1e-12)


@pytest.mark.parametrize("order", [0, 1])
def test_a_constant_is_found_wherever_there_is_fluid_and_nothing_elsewhere(order: int) -> None:
    particles = jittered((5, 5), 0.4, seed=1)
    points = np.array([[2.5, 2.5], [-2.0, 2.5], [-1.5, -1.5], [2.5, 7.3], [40.0, 0.0], [-2.9, -2.9]])
    total = at_points(points, particles, order).sum(axis=1)
    np.testing.assert_allclose(total[:4], 1.0, atol=1e-9)
    np.testing.assert_array_equal(total[4:], 0.0)


@pytest.mark.parametrize(
    "particles",
    [[[0.4, 0.3]], [[0.4, 0.3], [0.9, -0.2]], [[0.5 * k, 0.25 * k] for k in range(-2, 4)]],
    ids=["one", "two", "in line"],
)
def test_few_particles_give_their_mean(particles: list[list[float]]) -> None:
    """A plane through one or two particles, or through a row, is not known: no weight is beyond a mean's."""
    where = np.array(particles)
    plane, mean = at_points(np.zeros((1, 2)), where), at_points(np.zeros((1, 2)), where, order=0)
    np.testing.assert_allclose(plane, mean, atol=1e-12)
    far = 1.0 - np.linalg.norm(where, axis=1) / 3.0
    weight = np.maximum(far, 0.0) ** 4 * (1.0 + 4.0 * (1.0 - far))
    np.testing.assert_allclose(mean[0], weight / weight.sum(), atol=1e-12)


@given(seed=st.integers(0, 99), angle=st.floats(0.0, 6.3), field=st.tuples(SMALL, SMALL, SMALL))
def test_a_parabola_is_continued_behind_a_wall(seed: int, angle: float, field: tuple[float, float, float]) -> None:
    """Zero on the wall, s + s^2 + s t before it, at s = -depth behind it."""
    wall = Wall(angle, seed, DEPTHS)
    a, b, c = field
    fluid = a * wall.distance + b * wall.distance**2 + c * wall.distance * wall.places
    here = np.linspace(-1.2, 1.3, len(DEPTHS))
    expected = -a * DEPTHS + b * DEPTHS**2 - c * DEPTHS * here
    np.testing.assert_allclose(wall.rows(LeaningParabola()) @ fluid, expected, atol=1e-8)


@given(seed=st.integers(0, 99), angle=st.floats(0.0, 6.3), slope=SMALL)
def test_a_line_is_continued_behind_a_wall(seed: int, angle: float, slope: float) -> None:
    wall = Wall(angle, seed, DEPTHS)
    np.testing.assert_allclose(wall.rows(Line()) @ (slope * wall.distance), -slope * DEPTHS, atol=1e-10)


def test_one_particle_before_a_wall_gives_a_line() -> None:
    wall = Wall(0.0, 0, DEPTHS[1:2])
    wall.feet[:] = 0.0
    wall.particles, wall.distance = np.array([[0.3, 0.5]]), np.array([0.5])
    for curve in (Line(), LeaningParabola()):
        np.testing.assert_allclose(wall.rows(curve), [[-1.0]], atol=1e-12)


def test_without_fluid_before_it_a_wall_has_nothing_to_continue() -> None:
    wall = Wall(0.0, 0, DEPTHS)
    wall.feet += np.array([50.0, 0.0])
    assert not wall.rows(LeaningParabola()).any()


def normal_rows(points: Array, normals: Array, particles: Array) -> Array:
    """The rows (points, points + particles) of n . grad f; the points on the wall are neighbours too."""
    everything = np.concatenate((points, particles))
    where = ParticleSums(everything, len(points), KERNEL, np.ones(len(everything)), None, 1)
    where.fields["normal"] = np.concatenate((normals, np.zeros_like(particles)))
    return np.asarray(
        pair_matrix(where, NormalWeights(KERNEL), NormalFit(KERNEL))[np.argsort(where.neighbours.rows)].toarray()
    )


@given(seed=st.integers(0, 99), angle=st.floats(0.0, 6.3), field=st.tuples(SMALL, SMALL, SMALL))
def test_normal_derivatives_of_planes(seed: int, angle: float, field: tuple[float, float, float]) -> None:
    wall = Wall(angle, seed, np.zeros(4))
    normals = np.tile(wall.normal, (4, 1))
    found = normal_rows(wall.feet, normals, wall.particles)
    a, b, c = field
    everything = np.concatenate((wall.feet, wall.particles))
    values = a + everything @ np.array([b, c])
    slope = found @ values - found.sum(axis=1) * values[:4]
    np.testing.assert_allclose(slope, wall.normal @ np.array([b, c]), atol=1e-9)


def test_a_normal_derivative_needs_particles_in_two_directions() -> None:
    points, normals = np.zeros((1, 2)), np.array([[0.0, 1.0]])
    assert not normal_rows(points, normals, np.array([[0.5, 0.5], [1.0, 1.0]])).any()
    assert not normal_rows(points, normals, np.array([[9.0, 9.0]])).any()
    np.testing.assert_allclose(
        normal_rows(points, normals, np.array([[0.7, 0.0], [0.0, 0.5]])), [[0.0, 0.0, 2.0]], atol=1e-12
    )
