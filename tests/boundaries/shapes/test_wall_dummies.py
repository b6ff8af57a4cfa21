"""Dummy particles: where they stand, what they know of the wall, and how dense fluid and dummies are together."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.spatial import cKDTree

from sphear import SphearError, WendlandC2
from sphear.boundaries.shapes import (
    Circle,
    HalfPlane,
    Intersection,
    Polygon,
    Rectangle,
    Shape,
    check_room,
    dummies,
    fluid_lattice,
    repeated,
)
from sphear.neighbours.domain import Domain
from tests.boundaries.shapes.examples import (
    ALL,
    CAVITY,
    CHANNEL,
    COMPOUNDS,
    CYLINDER,
    ELL,
    PRIMITIVES,
    SQUARE,
    STAR,
    TRIANGLE,
    WALLS,
    Array,
    same_places,
)

DX = 1 / 40
DEPTH = 3.5 * DX
AROUND = Domain((-0.5, -0.5), (1.5, 1.5), False)


def density(at: Array, particles: Array, dx: float = DX) -> Array:
    """The sum of dx^2 W over particles, as a share of its value inside a lattice."""
    kernel = WendlandC2(h=1.5 * dx)
    k = np.arange(-4, 5) * dx
    inside = np.hypot(*np.meshgrid(k, k)).ravel()

    def total(distances: Array) -> float:
        return sum(float(kernel.shape(min(r / (1.5 * dx), 2.0), 2)) for r in distances)

    near = cKDTree(particles).query_ball_point(at, 3.0 * dx)
    return np.array([total(np.hypot(*(particles[found] - x).T)) for x, found in zip(at, near, strict=True)]) / total(
        inside
    )


def nearest_pair(particles: Array) -> float:
    distances, _ = cKDTree(particles).query(particles, 2)
    return float(np.asarray(distances)[:, 1].min())


@pytest.mark.parametrize("name", ALL)
def test_dummies_know_the_wall_that_they_stand_behind(name: str) -> None:
    shape = ALL[name]
    found = dummies(shape, DX, DEPTH, SQUARE)
    assert len(found.positions) > 20
    feet = found.positions + found.depths[:, None] * found.normals
    np.testing.assert_allclose(shape.distance(feet), 0.0, atol=1e-9)
    assert (found.depths >= -shape.distance(found.positions) - 1e-12).all()
    assert found.depths.min() > 0.25 * DX
    assert found.depths.max() < DEPTH * (1 + 1e-6)
    np.testing.assert_allclose(np.hypot(*found.normals.T), 1.0, atol=1e-12)
    np.testing.assert_array_equal(found.velocities, shape.wall_velocity(found.positions))
    if name in PRIMITIVES:
        np.testing.assert_array_equal(found.depths, -shape.distance(found.positions))


@pytest.mark.parametrize("name", ALL)
@pytest.mark.parametrize("inverted", [False, True])
def test_they_are_neither_clumped_nor_sparse(name: str, inverted: bool) -> None:
    shape = ~ALL[name] if inverted else ALL[name]
    found = dummies(shape, DX, DEPTH, AROUND).positions
    assert nearest_pair(found) > 0.49 * DX
    # no larger hole between fluid and dummies than in a lattice, but for a little
    edge = np.random.default_rng(0).uniform(0.1, 0.9, (4000, 2))
    near = edge[np.abs(shape.distance(edge)) < 1.5 * DX]
    together = np.concatenate((found, fluid_lattice(shape, DX, AROUND)))
    assert np.asarray(cKDTree(together).query(near)[0]).max(initial=0.0) < 1.25 * DX


def test_a_cavity_is_surrounded_by_its_lattice() -> None:
    found = dummies(CAVITY, DX, DEPTH, SQUARE)
    k = (np.arange(-4, 44) + 0.5) * DX
    places = np.stack(np.meshgrid(k, k), axis=2).reshape(-1, 2)
    beyond = np.hypot(*(places - np.clip(places, 0, 1)).T)
    same_places(found.positions, places[(beyond > 0) & (beyond < DEPTH + 1e-9)])
    lid = (found.positions[:, 1] > 1) & (np.abs(found.positions[:, 0] - 0.5) < 0.5)
    np.testing.assert_array_equal(found.velocities, np.where(lid[:, None], (1.0, 0.0), (0.0, 0.0)))


def test_a_rectangle_is_the_same_as_a_polygon() -> None:
    corners = Polygon([(0, 0), (1, 0), (1, 1), (0, 1)], {2: (1.0, 0.0)})
    a, b = dummies(CAVITY, DX, DEPTH, SQUARE), dummies(corners, DX, DEPTH, SQUARE)
    same_places(a.positions, b.positions)
    same_places(np.column_stack((a.positions, a.velocities)), np.column_stack((b.positions, b.velocities)))


def test_walls_along_the_axes_that_meet_share_one_lattice() -> None:
    floor = HalfPlane((0, 0), (0, 1)) & HalfPlane((0, 0), (1, 0)) & HalfPlane((1, 0), (-1, 0))
    for shape in (floor, ELL, COMPOUNDS["tee"]):
        found = dummies(shape, DX, DEPTH, SQUARE).positions
        cells = found / DX - 0.5
        np.testing.assert_allclose(cells, cells.round(), atol=1e-9)
        assert len({tuple(cell) for cell in cells.round()}) == len(found)


def test_half_planes_make_a_rectangle() -> None:
    sides = [((0, 0), (0, 1), (0, 0)), ((0, 0), (1, 0), (0, 0)), ((1, 1), (-1, 0), (0, 0)), ((1, 1), (0, -1), (1, 0))]
    walls = Intersection(*(HalfPlane(*side) for side in sides))
    a, b = dummies(CAVITY, DX, DEPTH, SQUARE), dummies(walls, DX, DEPTH, SQUARE)
    order = [np.lexsort(d.positions.round(9).T) for d in (a, b)]
    for one, other in zip(a, b, strict=True):
        np.testing.assert_allclose(one[order[0]], other[order[1]], atol=0.05)  # corners are sought among points


def test_a_block_against_a_wall_has_no_walls_between() -> None:
    ell = Polygon([(0.4, 0), (1, 0), (1, 1), (0, 1), (0, 0.3), (0.4, 0.3)])
    block = CAVITY - Rectangle((0, 0), (0.4, 0.3))
    a, b = dummies(ell, DX, DEPTH, SQUARE), dummies(block, DX, DEPTH, SQUARE)
    same_places(a.positions, b.positions)
    order = [np.lexsort(d.positions.round(9).T) for d in (a, b)]
    np.testing.assert_allclose(a.depths[order[0]], b.depths[order[1]], atol=1e-9)
    check_room(block, DX, DEPTH, SQUARE, 3 * DX)


def test_a_rectangle_that_no_whole_number_of_particles_fits() -> None:
    found = dummies(Rectangle((0, 0), (0.99, 1)), DX, DX, SQUARE)
    right = found.positions[found.positions[:, 0] > 0.99]
    np.testing.assert_allclose(right[:, 0], 0.99 + DX / 2)
    upper = found.positions[(found.positions[:, 1] > 1) & (np.abs(found.positions[:, 0] - 0.495) < 0.495)]
    np.testing.assert_allclose(np.diff(np.sort(upper[:, 0])), 0.99 / 40)


def test_a_cylinder_is_filled_down_to_its_centre() -> None:
    radius = 3 * DX
    rings = dummies(~Circle((0.5, 0.5), radius), DX, 1.0, SQUARE)
    np.testing.assert_allclose(np.unique((rings.depths / DX).round(6)), (0.5, 1.5, 2.5))
    assert len(rings.depths) == pytest.approx(np.pi * 9, abs=1.5)
    middle = dummies(~Circle((0.5, 0.5), 2.5 * DX), DX, 1.0, SQUARE)
    np.testing.assert_allclose(middle.positions[np.argmax(middle.depths)], (0.5, 0.5))


def test_dummies_repeat_with_the_period() -> None:
    window = Domain((0.0, 0.0), (1.01, 1.0), (True, False))
    shape = WALLS - Circle((0.05, 0.5), 0.2)
    found = dummies(shape, DX, DEPTH, window)
    assert (found.positions[:, 0] >= 0).all()
    assert (found.positions[:, 0] <= 1.01).all()
    np.testing.assert_array_equal(found.depths, -repeated(shape, window).distance(found.positions))
    floor = np.sort(found.positions[np.abs(found.positions[:, 1] + DX / 2) < 1e-9, 0])
    np.testing.assert_allclose(floor, (np.arange(40) + 0.5) * 1.01 / 40)
    # the same cylinder in the middle of the period
    moved = dummies(WALLS - Circle((0.55, 0.5), 0.2), DX, DEPTH, window)
    ring, other = (d.positions[np.abs(d.positions[:, 1] - 0.5) < 0.3] for d in (found, moved))
    same_places(window.wrapped(ring + np.array([0.5, 0.0])), other)
    # and across the period there are no two too near each other
    images, _ = window.with_images(found.positions, 3 * DX)
    assert nearest_pair(images) > 0.6 * DX


@pytest.mark.parametrize(
    ("shape", "window"),
    [(CAVITY, SQUARE), (ELL, SQUARE), (HalfPlane((0, 0), (0, 1)) & HalfPlane((0, 0), (1, 0)), SQUARE)],
)
def test_the_density_at_straight_walls_is_that_of_the_lattice(shape: Shape, window: Domain) -> None:
    fluid = fluid_lattice(shape, DX, window)
    together = np.concatenate((fluid, dummies(shape, DX, DEPTH, window).positions))
    at = fluid[(shape.distance(fluid) < 4 * DX) & (fluid < 0.9).all(axis=1)]
    np.testing.assert_allclose(density(at, together), 1.0, atol=1e-12)


def test_the_density_in_a_periodic_channel_is_that_of_the_lattice() -> None:
    fluid = fluid_lattice(WALLS, DX, CHANNEL)
    together = np.concatenate((fluid, dummies(WALLS, DX, DEPTH, CHANNEL).positions))
    images, _ = CHANNEL.with_images(together, 4 * DX)
    np.testing.assert_allclose(density(fluid[WALLS.distance(fluid) < 3 * DX], images), 1.0, atol=1e-12)


@pytest.mark.parametrize("cells", [30, 40, 57])
@pytest.mark.parametrize("cylinder", [CYLINDER, Circle((0.43, 0.52), 0.2), Circle((0.4, 0.4), 0.127)])
def test_the_density_at_a_cylinder_is_nearly_that_of_the_lattice(cylinder: Circle, cells: int) -> None:
    dx = 1 / cells
    shape = CAVITY - cylinder
    fluid = fluid_lattice(shape, dx, SQUARE)
    together = np.concatenate((fluid, dummies(shape, dx, 3.5 * dx, SQUARE).positions))
    around = density(fluid[cylinder.distance(fluid) > -3 * dx], together, dx)
    assert around.mean() == pytest.approx(1.0, abs=0.04)
    assert around.std() < 0.065
    assert np.quantile(np.abs(around - 1), 0.9) < 0.15
    assert np.abs(around - 1).max() < 0.25


@pytest.mark.parametrize("shape", [Circle((0.5, 0.5), 0.4), TRIANGLE, STAR, PRIMITIVES["lentil"]])
def test_the_density_in_other_shapes_is_nearly_that_of_the_lattice(shape: Shape) -> None:
    fluid = fluid_lattice(shape, DX, SQUARE)
    together = np.concatenate((fluid, dummies(shape, DX, DEPTH, SQUARE).positions))
    found = density(fluid[shape.distance(fluid) < 3 * DX], together)
    assert found.mean() == pytest.approx(1.0, abs=0.03)
    assert np.abs(found - 1).max() < 0.3


@pytest.mark.parametrize("scale", [1e-6, 1e6])
def test_lengths_have_any_unit(scale: float) -> None:
    shape = Rectangle((0, 0), (scale, scale)) - Circle((0.5 * scale, 0.5 * scale), 0.25 * scale)
    window = Domain((0, 0), (scale, scale), False)
    found = dummies(shape, DX * scale, DEPTH * scale, window)
    same_places(found.positions / scale, dummies(CAVITY - CYLINDER, DX, DEPTH, SQUARE).positions)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((CAVITY, 0.0, 1.0, SQUARE), "spacing and depth of dummy particles are positive, not 0 and 1"),
        ((CAVITY, DX, -1.0, SQUARE), "spacing and depth of dummy particles are positive"),
        ((CAVITY, float("nan"), 1.0, SQUARE), "the spacing of dummy particles is a finite number"),
        ((CAVITY, DX, DEPTH, Domain((0.0,), (1.0,), False)), "their window has 2 axes, not 1"),
        ((CAVITY, DX, DEPTH, CHANNEL), "cannot repeat along the periodic axis x"),
    ],
)
def test_mistakes_are_refused_in_one_sentence(arguments: Any, message: str) -> None:
    with pytest.raises(SphearError, match=message):
        dummies(*arguments)
