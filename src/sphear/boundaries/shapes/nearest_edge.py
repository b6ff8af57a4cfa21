"""The nearest edge of a polygon, of many points and many edges, and whether its edges meet elsewhere; compiled."""

from __future__ import annotations

import numpy as np

from sphear.boundaries.shapes.base import Array
from sphear.engine.cache import compiled

BLOCK = 16  # edges that are passed over together where all are too far away


def blocks(starts: Array, ends: Array) -> Array:
    """(B, 4), the lower and upper corners of boxes around `BLOCK` edges each, in their order."""
    firsts = np.arange(0, len(starts), BLOCK)
    low, high = np.minimum(starts, ends), np.maximum(starts, ends)
    return np.column_stack((np.minimum.reduceat(low, firsts), np.maximum.reduceat(high, firsts)))


@compiled
def nearest_edges(points, starts, ends, boxes, inward, speeds, tiny, nearest, to_foot, facing, slow, within):  # type: ignore[no-untyped-def]
    """Of each point (N, 2) the nearest edge (E), in order; of edges equally near within `tiny`, all.

    Args:
        points: (N, 2).
        starts: (E, 2), of the edges.
        ends: (E, 2).
        boxes: of the edges' `blocks`.
        inward: (E, 2), unit normals.
        speeds: (E, 2), of the edges.
        tiny: by which two distances differ that are equal.
        nearest: (N,), becomes the distance.
        to_foot: (N, 2), becomes the way to the nearest point of the first.
        facing: (N, 2), becomes the sum of the normals of all.
        slow: (N, 2), becomes the velocity of the slowest.
        within: (N,), becomes whether the point is in the polygon.
    """
    for i in range(len(points)):
        x, y = points[i, 0], points[i, 1]
        best, inside = np.inf, False
        bound = np.inf  # of the distance: that of some corners
        for edge in range(0, len(starts), BLOCK):
            bound = min(bound, (starts[edge, 0] - x) ** 2 + (starts[edge, 1] - y) ** 2)
        reach = (np.sqrt(bound) * (1.0 + 1e-9) + tiny) ** 2
        for block in range(len(boxes)):
            away_x = max(boxes[block, 0] - x, 0.0, x - boxes[block, 2])
            away_y = max(boxes[block, 1] - y, 0.0, y - boxes[block, 3])
            near = away_x * away_x + away_y * away_y <= reach
            beside = away_y == 0.0 and x <= boxes[block, 2]
            if not near and not beside:
                continue
            for edge in range(block * BLOCK, min(len(starts), (block + 1) * BLOCK)):
                start_x, start_y = starts[edge, 0], starts[edge, 1]
                end_x, end_y = ends[edge, 0], ends[edge, 1]
                along_x, along_y = end_x - start_x, end_y - start_y
                if beside and along_y != 0.0 and (start_y > y) != (end_y > y):
                    inside ^= x < start_x + (y - start_y) * (along_x / along_y)
                if not near:
                    continue
                share = ((x - start_x) * along_x + (y - start_y) * along_y) / (along_x * along_x + along_y * along_y)
                share = min(max(share, 0.0), 1.0)
                to_x = (1.0 - share) * start_x + share * end_x - x
                to_y = (1.0 - share) * start_y + share * end_y - y
                distance = np.hypot(to_x, to_y)
                better = distance < best - tiny
                if better or abs(distance - best) <= tiny:
                    square = speeds[edge, 0] ** 2 + speeds[edge, 1] ** 2
                    if better or square < slow[i, 0] ** 2 + slow[i, 1] ** 2:
                        slow[i, 0], slow[i, 1] = speeds[edge, 0], speeds[edge, 1]
                    if better:
                        best = distance
                        to_foot[i, 0], to_foot[i, 1] = to_x, to_y
                        facing[i, 0], facing[i, 1] = inward[edge, 0], inward[edge, 1]
                    else:
                        facing[i, 0] += inward[edge, 0]
                        facing[i, 1] += inward[edge, 1]
        nearest[i], within[i] = best, inside


@compiled
def _turn(a, b, c):  # type: ignore[no-untyped-def]
    """Twice the area of the triangle a b c: positive where it turns to the left."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


@compiled
def _between(first, last, point):  # type: ignore[no-untyped-def]
    """True if a point of the line through two is between them."""
    return min(first[0], last[0]) <= point[0] <= max(first[0], last[0]) and min(first[1], last[1]) <= point[1] <= max(
        first[1], last[1]
    )


@compiled
def crossing(starts, ends):  # type: ignore[no-untyped-def]
    """The first two edges that meet elsewhere than at their shared corner; (i, i) if one has no length, or (-1, -1)."""
    count = len(starts)
    for i in range(count):
        if starts[i, 0] == ends[i, 0] and starts[i, 1] == ends[i, 1]:
            return i, i
    for i in range(count - 1):
        a, b = starts[i], ends[i]
        for j in range(i + 1, count):
            c, d = starts[j], ends[j]
            if j == i + 1 or (i == 0 and j == count - 1):  # neighbours share a corner, and may only not turn back
                other = b if j == i + 1 else a
                mine, theirs = (a, d) if j == i + 1 else (b, c)
                way = (mine[0] - other[0]) * (theirs[0] - other[0]) + (mine[1] - other[1]) * (theirs[1] - other[1])
                if _turn(mine, other, theirs) == 0 and way > 0:
                    return i, j
                continue
            if max(c[0], d[0]) < min(a[0], b[0]) or min(c[0], d[0]) > max(a[0], b[0]):
                continue
            abc, abd, cda, cdb = _turn(a, b, c), _turn(a, b, d), _turn(c, d, a), _turn(c, d, b)
            if np.sign(abc) != np.sign(abd) and np.sign(cda) != np.sign(cdb):
                return i, j
            if (abc == 0 and _between(a, b, c)) or (abd == 0 and _between(a, b, d)):
                return i, j
            if (cda == 0 and _between(c, d, a)) or (cdb == 0 and _between(c, d, b)):
                return i, j
    return -1, -1


def first_crossing(starts: Array, ends: Array) -> tuple[int, int] | None:
    """The first two edges (E, 2) that meet elsewhere than at the corner they share; (i, i) for one without length."""
    i, j = crossing(np.ascontiguousarray(starts), np.ascontiguousarray(ends))
    return None if i < 0 else (int(i), int(j))
