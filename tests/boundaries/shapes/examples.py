"""Shapes that the tests share."""

from __future__ import annotations

from math import cos, inf, pi, sin
from typing import Any

import numpy as np
from hypothesis import strategies as st

from sphear.boundaries.shapes import Circle, HalfPlane, Polygon, Rectangle, Shape
from sphear.neighbours.domain import Domain

Array = np.ndarray[Any, Any]

SQUARE = Domain((0.0, 0.0), (1.0, 1.0), False)
CHANNEL = Domain((0.0, 0.0), (1.0, 1.0), (True, False))
LID = {"upper": (1.0, 0.0)}
CAVITY = Rectangle((0.0, 0.0), (1.0, 1.0), velocities=LID)
CYLINDER = Circle((0.5, 0.5), 0.25)
TRIANGLE = Polygon([(0.1, 0.1), (0.95, 0.2), (0.4, 0.9)])
ELL = Polygon([(0.0, 0.0), (1.0, 0.0), (1.0, 0.5), (0.5, 0.5), (0.5, 1.0), (0.0, 1.0)])
STAR = Polygon([(0.5 + r * cos(k * pi / 5), 0.5 + r * sin(k * pi / 5)) for k, r in enumerate((0.45, 0.2) * 5)][::-1])
LENTIL = Polygon(
    [(0.5 + 0.4 * cos(t), 0.5 + 0.3 * sin(t)) for t in np.linspace(0, 2 * pi, 100, endpoint=False).tolist()]
)
WALLS = Rectangle((-inf, 0.0), (inf, 1.0))
PRIMITIVES: dict[str, Any] = {
    "cavity": CAVITY,
    "channel": WALLS,
    "quadrant": Rectangle((0.2, 0.3), (inf, inf)),
    "circle": Circle((0.4, 0.5), 0.3, spin=2.0),
    "half-plane": HalfPlane((0.2, 0.3), (1.0, 2.0), (2.0, -1.0)),
    "triangle": TRIANGLE,
    "ell": ELL,
    "star": STAR,
    "lentil": LENTIL,
}
COMPOUNDS: dict[str, Shape] = {
    "cavity and cylinder": CAVITY - CYLINDER,
    "tank": HalfPlane((0.0, 0.0), (1.0, 0.0)) & HalfPlane((0.0, 0.0), (0.0, 1.0)) & HalfPlane((1.0, 0.0), (-1.0, -0.3)),
    "tee": Rectangle((0.0, 0.0), (1.0, 0.4)) | Rectangle((0.3, 0.0), (0.7, 1.0)),
    "bodies": Circle((0.5, 0.5), 0.45) - (Circle((0.45, 0.5), 0.1) | Circle((0.58, 0.5), 0.1)),
    "around a triangle": ~TRIANGLE,
}
ALL: dict[str, Any] = {**PRIMITIVES, **COMPOUNDS}
coordinates = st.floats(-0.5, 1.5, allow_subnormal=False)
points = st.lists(st.tuples(coordinates, coordinates), min_size=1, max_size=20).map(np.array)


def same_places(a: Array, b: Array) -> None:
    """Assert that two sets of places are the same up to rounding and order."""
    a, b = a.round(9) + 0.0, b.round(9) + 0.0
    np.testing.assert_allclose(a[np.lexsort(a.T)], b[np.lexsort(b.T)], atol=1e-9)
