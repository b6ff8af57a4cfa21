"""Polygons of many edges and compounds of many shapes, against sums over all of them."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from sphear.boundaries.shapes import Circle, Polygon, Union, compound
from sphear.errors import SphearError

Array = np.ndarray[Any, Any]

POINTS = np.random.default_rng(0).uniform(-1.5, 1.5, (500, 2))


def star(count: int) -> list[tuple[float, float]]:
    angles = 2 * np.pi * np.arange(count) / count
    radii = 1 + 0.3 * np.sin(5 * angles)
    return [(float(r * np.cos(a)), float(r * np.sin(a))) for r, a in zip(radii, angles, strict=True)]


def signed_distance(vertices: list[tuple[float, float]], points: Array) -> Array:
    """By all edges, and by the angle that the polygon is seen under."""
    starts, ends = np.array(vertices), np.roll(np.array(vertices), -1, axis=0)
    along, to = ends - starts, points[:, None] - starts
    share = np.clip((to * along).sum(-1) / (along**2).sum(-1), 0, 1)
    distance = np.linalg.norm(to - share[..., None] * along, axis=-1).min(axis=1)
    a, b = starts - points[:, None], ends - points[:, None]
    angle = np.arctan2(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0], (a * b).sum(-1)).sum(axis=1)
    return np.asarray(np.where(np.abs(angle) > np.pi, distance, -distance))


@pytest.mark.parametrize("count", [5, 16, 17, 33, 400])
def test_the_distance_from_a_polygon_is_that_from_all_its_edges(count: int) -> None:
    np.testing.assert_allclose(Polygon(star(count)).distance(POINTS), signed_distance(star(count), POINTS), atol=1e-11)


@pytest.mark.parametrize("far", [20, 150, 250])
def test_of_many_edges_any_two_that_meet_are_found(far: int) -> None:
    vertices = star(400)
    vertices[far] = (5.0, 0.1) if far > 100 else (-5.0, 0.1)
    with pytest.raises(SphearError, match="a polygon meets itself nowhere"):
        Polygon(vertices)


@pytest.mark.parametrize("joined", [lambda a: Union(*a), lambda a: ~Union(*a)])
def test_many_shapes_are_looked_at_for_some_points_after_the_others(
    joined: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    shape = joined([Circle((0.1 * k, 0.03 * k), 0.04, spin=k) for k in range(-12, 13)])
    whole = shape.foot(POINTS)
    monkeypatch.setattr(compound, "MOST", 1000)
    for mine, all_at_once in zip(shape.foot(POINTS), whole, strict=True):
        np.testing.assert_array_equal(mine, all_at_once)
    np.testing.assert_array_equal(shape.distance(POINTS), whole.distance)


@pytest.mark.parametrize("edge", [0.0, 1.5, True, "0", -1, 3])
def test_an_edge_is_a_whole_number(edge: Any) -> None:
    with pytest.raises(SphearError, match="numbered 0 to 2, not"):
        Polygon(((0.4, 0.4), (0.6, 0.4), (0.5, 0.6)), {edge: (1, 0)})
