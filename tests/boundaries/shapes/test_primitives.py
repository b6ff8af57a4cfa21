"""Signed distances: exact, with unit gradients that lead to the wall."""

from __future__ import annotations

from math import inf, pi
from typing import Any, cast

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sphear import SphearError
from sphear.boundaries.shapes import Circle, HalfPlane, Polygon, Rectangle, Shape
from sphear.neighbours.domain import Domain
from tests.boundaries.shapes.examples import ALL, CAVITY, ELL, LID, PRIMITIVES, STAR, Array, points

EVERYWHERE = Domain((-3.0, -3.0), (4.0, 4.0), False)
STEP = 2e-3


@pytest.mark.parametrize("name", PRIMITIVES)
def test_distances_are_those_of_the_nearest_points_of_the_outline(name: str) -> None:
    shape = PRIMITIVES[name]
    x = np.random.default_rng(1).uniform(-0.5, 1.5, (300, 2))
    outline = shape.outline(STEP, EVERYWHERE)
    np.testing.assert_allclose(shape.distance(outline), 0.0, atol=1e-14)
    nearest = np.array([np.hypot(*(outline - place).T).min() for place in x])
    exact = np.abs(shape.distance(x))
    assert (exact <= nearest + 1e-12).all()
    # a point of the outline lies within half a step of the foot, and the circle bends away
    np.testing.assert_array_less(nearest, np.hypot(exact, 0.5 * STEP) + STEP**2)


@given(points, st.sampled_from(sorted(PRIMITIVES)))
def test_the_normal_leads_to_the_wall(x: Array, name: str) -> None:
    shape = PRIMITIVES[name]
    foot = x - shape.distance(x)[:, None] * shape.normal(x)
    np.testing.assert_allclose(shape.distance(foot), 0.0, atol=1e-12)


@given(points, st.sampled_from(sorted(ALL)))
def test_normals_are_unit_vectors_and_distances_lipschitz(x: Array, name: str) -> None:
    shape = ALL[name]
    np.testing.assert_allclose(np.hypot(*shape.normal(x).T), 1.0, atol=1e-12)
    distance, apart = shape.distance(x), np.hypot(*(x[:, None] - x[None]).T)
    assert (np.abs(distance[:, None] - distance[None]) <= apart + 1e-12).all()


@pytest.mark.parametrize("name", ALL)
def test_the_normal_is_the_gradient_of_the_distance(name: str) -> None:
    shape = ALL[name]
    x = np.random.default_rng(2).uniform(-0.5, 1.5, (400, 2))
    e = 1e-7
    gradient = np.column_stack([(shape.distance(x + d) - shape.distance(x - d)) / (2 * e) for d in e * np.eye(2)])
    smooth = np.abs(np.hypot(*gradient.T) - 1) < 1e-6  # not across a medial axis
    assert smooth.mean() > 0.98
    np.testing.assert_allclose(gradient[smooth], shape.normal(x)[smooth], atol=1e-5)


@pytest.mark.parametrize(
    ("shape", "x", "normal"),
    [
        (CAVITY, (0.0, 0.0), (1, 1)),
        (CAVITY, (1.0, 1.0), (-1, -1)),
        (CAVITY, (0.5, 1.0), (0, -1)),
        (CAVITY, (1.0 + 1e-18, 0.5), (-1, 0)),
        (ELL, (0.5, 0.5), (-1, -1)),
        (ELL, (1.0, 0.0), (-1, 1)),
        (ELL, (0.2, 0.0), (0, 1)),
        (~ELL, (0.2, 0.0), (0, -1)),
    ],
)
def test_walls_and_corners_have_normals(shape: Shape, x: Any, normal: Any) -> None:
    np.testing.assert_allclose(shape.normal([x])[0], np.array(normal) / np.hypot(*normal), atol=1e-9)


def test_the_centre_of_a_circle_has_a_normal() -> None:
    circle = PRIMITIVES["circle"]
    foot = circle.foot([circle.centre])
    assert foot.distance[0] == circle.radius
    assert np.hypot(*foot.normal[0]) == 1.0


def test_the_lid_ends_at_its_corners() -> None:
    cavity = Rectangle((0, 0), (1, 1), velocities={"upper": (2.0, 0.0), "right": (0.0, -1.0)})
    places = [(0.3, 1.2), (0.3, 0.9), (-0.1, 1.1), (0.0, 1.3), (1.1, 1.3), (1.2, 0.5), (0.5, -1.0), (-0.2, 0.99)]
    expected = [(2, 0), (2, 0), (0, 0), (0, 0), (0, -1), (0, -1), (0, 0), (0, 0)]
    np.testing.assert_array_equal(cavity.wall_velocity(places), expected)


def test_edges_of_a_polygon_slide_like_the_sides_of_a_rectangle() -> None:
    polygon = Polygon([(0, 0), (0, 1), (1, 1), (1, 0)], velocities={1: (1.0, 0.0)})
    x = np.random.default_rng(3).uniform(-1, 2, (500, 2))
    corners = np.array([(-0.3, 1.3), (1.0, 1.4), (0.0, 1.0)])
    x = np.concatenate((x, corners))
    for of_polygon, of_cavity in zip(polygon.foot(x), CAVITY.foot(x), strict=True):
        np.testing.assert_allclose(of_polygon, of_cavity, atol=1e-12)


def test_a_spinning_circle_turns_anticlockwise() -> None:
    circle = Circle((1.0, 2.0), 0.5, spin=3.0)
    np.testing.assert_allclose(circle.wall_velocity([(2.0, 2.0), (1.0, 2.1)]), [(0, 1.5), (-1.5, 0)], atol=1e-12)


def test_bounds() -> None:
    assert CAVITY.bounds == ((0, 0), (1, 1))
    assert Circle((1, 2), 0.5).bounds == ((0.5, 1.5), (1.5, 2.5))
    assert HalfPlane((0, 0.5), (0, -2)).bounds == ((-inf, -inf), (inf, 0.5))
    assert HalfPlane((0, 0.5), (1, -2)).bounds == ((-inf, -inf), (inf, inf))
    assert STAR.bounds[1][0] == pytest.approx(0.95)


def test_shapes_are_values() -> None:
    assert hash(CAVITY) == hash(Rectangle((0, 0), (1, 1), velocities=LID))
    assert Rectangle((0, 0), (1, 1), velocities=CAVITY.velocities) == CAVITY
    assert hash(ELL) == hash(Polygon(list(ELL.vertices)))
    assert Polygon(np.array(ELL.vertices).tolist()) == ELL
    assert HalfPlane((0, 0), (0, 5)) == HalfPlane((0, 0), (0, 1))


@given(st.floats(0, 2 * pi), st.floats(1e-150, 1e150))
def test_normals_of_half_planes_have_any_length(angle: float, length: float) -> None:
    wall = HalfPlane((0, 0), (length * np.cos(angle), length * np.sin(angle)))
    np.testing.assert_allclose(wall.normal([(3.0, 4.0)])[0], (np.cos(angle), np.sin(angle)), atol=1e-12)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Rectangle(cast(Any, (0, 0, 0)), (1, 1)), "the lower corner of a rectangle has two numbers, not"),
        (lambda: Rectangle((0, 0), (1, -1)), "needs its upper corner beyond its lower one"),
        (lambda: Rectangle((0, 0), (1, float("nan"))), "the upper corner of a rectangle has two numbers"),
        (lambda: Rectangle((0, 0), (1, 1), {"upper": (1, 0.5)}), r"moves through the wall at \(1, 0.5\)"),
        (lambda: Rectangle((0, 0), (1, 1), {"right": (1, 0)}), "the right side of the rectangle moves through"),
        (lambda: Rectangle((0, 0), (1, 1), {"top": (1, 0)}), "no side of a rectangle named 'top'"),
        (lambda: Rectangle((0, 0), (1, 1), cast(Any, (1.0, 0.0))), "sides of a rectangle are given by name"),
        (lambda: Polygon([(0, 0), (1, 0), (0, 1)], cast(Any, 3.0)), "edges of a polygon are given by name"),
        (lambda: Circle((0, 0), 0), "radius of a circle is positive"),
        (lambda: Circle((0, 0), inf), "radius of a circle is a finite number"),
        (lambda: Circle(cast(Any, (0, 0, 0)), 1), "the centre of a circle has two finite numbers"),
        (lambda: HalfPlane((0, 0), (0, 0)), "not zero"),
        (lambda: HalfPlane((0, 0), (0, 1), (1, 1)), r"moves through itself at \(1, 1\)"),
        (lambda: HalfPlane((0, inf), (0, 1)), "the point of a half-plane has two finite numbers"),
        (lambda: Polygon([(0, 0), (1, 0)]), "three or more vertices"),
        (lambda: Polygon([(0, 0), (1, 1), (1, 0), (0, 1)]), "meets itself nowhere"),
        (lambda: Polygon([(0, 0), (1, 0), (2, 0)]), "meets itself nowhere"),
        (lambda: Polygon([(0, 0), (2, 0), (2, 1), (1, 0), (0, 1)]), "meets itself nowhere"),
        (lambda: Polygon([(0, 0), (1, 0), (1, 0), (0, 1)]), "no two equal vertices"),
        (lambda: Polygon([(0, 0), (1, 0), (0, 1)], {0: (0, 1)}), "edge 0 of the polygon moves through the wall"),
        (lambda: Polygon([(0, 0), (1, 0), (0, 1)], {3: (0, 1)}), "edges of the polygon are numbered 0 to 2"),
        (lambda: CAVITY.distance(np.zeros((4, 3))), r"points have shape \(N, 2\), not \(4, 3\)"),
    ],
)
def test_mistakes_are_refused_in_one_sentence(make: Any, message: str) -> None:
    with pytest.raises(SphearError, match=message):
        make()
