"""Unions, intersections, differences and complements: where there is fluid, and how fast its walls are."""

from __future__ import annotations

from math import inf
from typing import Any, cast

import numpy as np
import pytest
from hypothesis import given

from sphear import SphearError
from sphear.boundaries.shapes import Circle, Complement, Difference, HalfPlane, Intersection, Rectangle, Union, repeated
from tests.boundaries.shapes.examples import CAVITY, CHANNEL, CYLINDER, TRIANGLE, WALLS, Array, points


@given(points)
def test_fluid_is_where_logic_says(x: Array) -> None:
    a, b = CYLINDER.distance(x) > 0, TRIANGLE.distance(x) > 0
    np.testing.assert_array_equal((CYLINDER | TRIANGLE).distance(x) > 0, a | b)
    np.testing.assert_array_equal((CYLINDER & TRIANGLE).distance(x) > 0, a & b)
    np.testing.assert_array_equal((CYLINDER - TRIANGLE).distance(x) > 0, a & (TRIANGLE.distance(x) < 0))
    np.testing.assert_array_equal((~CYLINDER).distance(x) > 0, CYLINDER.distance(x) < 0)


def test_operators_build_flat_compounds() -> None:
    other = Circle((0.2, 0.2), 0.1)
    assert CAVITY - CYLINDER - other == Difference(CAVITY, CYLINDER, other)
    assert CAVITY | CYLINDER | other == Union(CAVITY, CYLINDER, other)
    assert CAVITY & CYLINDER & other == Intersection(CAVITY, CYLINDER, other)
    assert Complement(CAVITY) == ~CAVITY
    assert ~~CAVITY == CAVITY
    assert len({CAVITY - CYLINDER, CAVITY - CYLINDER, CAVITY | CYLINDER}) == 2


@given(points)
def test_the_distance_in_front_of_obstacles_is_exact(x: Array) -> None:
    shape = CAVITY - CYLINDER
    foot = x - shape.distance(x)[:, None] * shape.normal(x)
    np.testing.assert_allclose(shape.distance(foot), 0.0, atol=1e-12)


def test_the_slower_of_two_equally_near_walls_counts() -> None:
    lid, wall = HalfPlane((0, 1), (0, -1), (1.0, 0.0)), HalfPlane((0, 0), (1, 0))
    for shape in (lid & wall, wall & lid):
        np.testing.assert_array_equal(
            shape.wall_velocity([(0.0, 1.0), (-0.5, 1.5), (0.5, 1.1)]), [(0, 0), (0, 0), (1, 0)]
        )


def test_bounds() -> None:
    assert (CAVITY - CYLINDER).bounds == CAVITY.bounds
    assert (CAVITY | Circle((1, 1), 1)).bounds == ((0, 0), (2, 2))
    assert (WALLS & Circle((1, 1), 1)).bounds == ((0, 0), (2, 1))
    assert (~CAVITY).bounds == ((-inf, -inf), (inf, inf))


def test_names_are_read_in_messages() -> None:
    assert str(CAVITY - CYLINDER) == (
        "difference of rectangle from (0, 0) to (1, 1), circle at (0.5, 0.5) of radius 0.25"
    )


@given(points)
def test_repeated_shapes_repeat(x: Array) -> None:
    shape = repeated(WALLS - Circle((0.05, 0.5), 0.2), CHANNEL)
    np.testing.assert_allclose(shape.distance(x), shape.distance(x + np.array([3.0, 0.0])), atol=1e-12)
    images = [Circle((0.05 + k, 0.5), 0.2) for k in range(-2, 4)]
    np.testing.assert_allclose(shape.distance(x), (Difference(WALLS, *images)).distance(x), atol=1e-12)
    assert shape.bounds == ((-inf, 0), (inf, 1))


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: CAVITY - cast(Any, 1), "only shapes can be joined to shapes, not 1"),
        (lambda: Union(), "union of a shape needs at least one"),
        (lambda: repeated(CAVITY, CHANNEL), "cannot repeat along the periodic axis x: .* one period of 1"),
        (lambda: repeated(WALLS - Circle((0.5, 0.5), 0.5), CHANNEL), "the circle .* cannot repeat"),
        (lambda: repeated(HalfPlane((0, 0), (1, 1)), CHANNEL), "the half-plane .* cannot repeat"),
        (lambda: repeated(Rectangle((0, 0), (inf, 1)), CHANNEL), "cannot repeat along the periodic axis x"),
        (lambda: repeated(WALLS - Circle((1.5, 0.5), 0.1), CHANNEL), "lies outside the period of x from 0 to 1"),
    ],
)
def test_mistakes_are_refused_in_one_sentence(make: Any, message: str) -> None:
    with pytest.raises(SphearError, match=message):
        make()
