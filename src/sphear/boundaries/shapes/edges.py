"""Rows of particles behind the edges of a polygon, and whether its edges cross."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from sphear.boundaries.shapes.base import Array
from sphear.boundaries.shapes.rows import SLACK, along, behind, grid


def edge_rows(
    starts: Array, ends: Array, normals: Array, distance: Callable[[Array], Array], spacing: float, depth: float
) -> list[Array]:
    """Rows behind each edge, at (k + 1/2) spacing, continued beyond its ends around corners.

    Where the nearest point of the polygon is a corner, the edge whose line a place is the farther behind has it; so the
    two edges meet at the bisecting line, and rows at right angles make one lattice.

    Args:
        starts: (E, 2), of the edges.
        ends: (E, 2).
        normals: (E, 2), unit vectors into the solid.
        distance: from the polygon, of points (N, 2).
        spacing: of the particles.
        depth: up to which rows stand behind the edges.
    """
    count, tiny = len(starts), SLACK * spacing
    found = []
    for i in range(count):
        length = float(np.hypot(*(ends[i] - starts[i])))
        tangent = (ends[i] - starts[i]) / length
        local = grid(along(length, spacing, depth), behind(spacing, depth))
        places = starts[i] + local[:, :1] * tangent + local[:, 1:] * normals[i]
        nearest = distance(places)
        own = (local[:, 0] >= 0) & (local[:, 0] <= length) & (np.abs(nearest - local[:, 1]) <= tiny)
        for corner, other, past in (
            (starts[i], (i - 1) % count, local[:, 0] < 0),
            (ends[i], (i + 1) % count, local[:, 0] > length),
        ):
            to_corner = np.hypot(*(places - corner).T)
            behind_other = (places - corner) @ normals[other]
            own |= past & (np.abs(nearest - to_corner) <= tiny) & (local[:, 1] >= behind_other - tiny)
        found.append(places[own & (nearest <= depth + tiny)])
    return found


def first_crossing(starts: Array, ends: Array) -> tuple[int, int] | None:
    """The first two edges that meet elsewhere than at the corner they share; (i, i) for an edge without length."""
    count = len(starts)
    for i in range(count):
        if (starts[i] == ends[i]).all():
            return i, i
    for i in range(count - 1):
        later = np.arange(i + 1, count)
        a, b, c, d = starts[i], ends[i], starts[later], ends[later]
        turns = [np.sign(_turn(*three)) for three in ((a, b, c), (a, b, d), (c, d, a), (c, d, b))]
        meet = (turns[0] != turns[1]) & (turns[2] != turns[3])
        for turn, first, last, point in (
            (turns[0], a, b, c),
            (turns[1], a, b, d),
            (turns[2], c, d, a),
            (turns[3], c, d, b),
        ):
            low, high = np.minimum(first, last), np.maximum(first, last)
            meet |= (turn == 0) & ((low <= point) & (point <= high)).all(axis=-1)
        for j, other in ((i + 1, b), ((i - 1) % count, a)):  # neighbours share a corner, and may only not turn back
            if j > i:
                mine, theirs = (a, ends[j]) if other is b else (b, starts[j])
                back = _turn(mine, other, theirs) == 0 and (mine - other) @ (theirs - other) > 0
                meet[j - i - 1] = bool(back)
        if meet.any():
            return i, int(later[np.argmax(meet)])
    return None


def _turn(a: Array, b: Array, c: Array) -> Array:
    """Twice the area of the triangles a b c: positive where they turn to the left."""
    u, v = b - a, c - a
    return np.asarray(u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0])
