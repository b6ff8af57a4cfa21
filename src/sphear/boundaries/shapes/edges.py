"""Rows of particles behind the edges of a polygon."""

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
