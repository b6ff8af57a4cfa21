"""A polygon of fluid, whose edges may slide."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import hypot

import numpy as np

from sphear.boundaries.shapes.base import (
    ROUNDING,
    SLIPS,
    Array,
    Foot,
    Primitive,
    Vector,
    by_name,
    check_name,
    plane_vector,
    text,
)
from sphear.boundaries.shapes.contours import contour_rows
from sphear.boundaries.shapes.edges import edge_rows
from sphear.boundaries.shapes.nearest_edge import blocks, first_crossing, nearest_edges
from sphear.errors import SphearError, quoted
from sphear.neighbours.domain import Domain

SHORT = 2.0  # spacings: with shorter edges a polygon is a curve, whose rows run on around it


@dataclass(frozen=True)
class Polygon(Primitive):
    """The fluid in a simple polygon: s = min |x - edge_i|, negative outside.

    At a corner, and where its two edges are equally near, the slower one's velocity counts.

    Args:
        vertices: three or more, in either orientation.
        velocities: of the edges that slide, each along itself, by number: edge i begins at vertex i.
        slips: edges that fluid slips along, by number.
        name: by which conditions of its walls are given.

    Raises:
        SphearError: the vertices make no polygon, its edges meet elsewhere, or an edge moves through itself.

    Examples:
        >>> import sphear
        >>> triangle = sphear.Polygon([(0, 0), (1, 0), (0, 1)], velocities={0: (1.0, 0.0)})
        >>> distance, normal, velocity = triangle.foot([(0.25, 0.125)])
        >>> print(distance, velocity)
        [0.125] [[1. 0.]]
    """

    vertices: Sequence[Vector]
    velocities: Mapping[int, Vector] | tuple[tuple[int, Vector], ...] = ()
    slips: tuple[int, ...] = field(default=(), kw_only=True, repr=False)
    name: str = field(default="", kw_only=True)

    def __post_init__(self) -> None:
        check_name(self.name)
        given: object = self.vertices
        if not isinstance(given, Sequence | np.ndarray) or len(given) < 3:
            raise SphearError(f"a polygon has three or more vertices, not {quoted(given)}")
        vertices = tuple(plane_vector("a vertex of a polygon", vertex) for vertex in self.vertices)
        object.__setattr__(self, "vertices", vertices)
        starts, ends = self._edges()
        if meeting := first_crossing(starts, ends):
            i, j = meeting
            raise SphearError(
                f"a polygon meets itself nowhere: its edges from {text(vertices[i])} and from {text(vertices[j])} do"
                if i != j
                else f"a polygon has no two equal vertices beside each other, as {text(vertices[i])}"
            )
        kept = []
        for edge, value in by_name("the velocities of the edges of a polygon", self.velocities).items():
            if not isinstance(edge, int | np.integer) or isinstance(edge, bool) or edge not in range(len(vertices)):
                raise SphearError(f"the edges of the polygon are numbered 0 to {len(vertices) - 1}, not {quoted(edge)}")
            velocity = plane_vector(f"the velocity of edge {edge} of a polygon", value)
            along = ends[edge] - starts[edge]
            through = velocity[0] * along[1] - velocity[1] * along[0]
            if abs(through) > ROUNDING * hypot(*velocity) * hypot(*along):
                raise SphearError(
                    f"edge {edge} of the polygon moves through the wall at {text(velocity)}: a wall may move only"
                    " along itself"
                )
            kept.append((int(edge), velocity))
        object.__setattr__(self, "velocities", tuple(sorted(kept)))

    @property
    def bounds(self) -> tuple[Vector, Vector]:
        """The least and greatest coordinates of the vertices."""
        xs, ys = zip(*self.vertices, strict=True)
        return (min(xs), min(ys)), (max(xs), max(ys))

    def seen_from(self, points: Array) -> Foot:
        """Distance, normal and velocity of the nearest edge."""
        starts, ends = self._edges()
        inward = self._inward(starts, ends)
        speeds = np.zeros((len(starts), 2))
        for edge, velocity in dict(self.velocities).items():
            speeds[edge] = velocity
        speeds[list(self.slips)] = SLIPS, 0.0
        count = len(points)
        nearest, to_foot = np.empty(count), np.zeros((count, 2))
        facing, slow = np.zeros((count, 2)), np.zeros((count, 2))
        within = np.empty(count, bool)
        tiny = ROUNDING * float(np.abs(starts).max())
        nearest_edges(
            np.ascontiguousarray(points), starts, ends, blocks(starts, ends), inward, speeds, tiny,
            nearest, to_foot, facing, slow, within,
        )  # fmt: skip
        sign = np.where(within, 1.0, -1.0)
        on = nearest <= tiny  # there the bisecting normal of all edges that meet
        length = np.hypot(facing[:, 0], facing[:, 1])
        facing = np.where((length > 1e-9)[:, None], facing / np.maximum(length, 1e-9)[:, None], inward[0])
        away = -sign[:, None] * to_foot / np.where(on, 1.0, nearest)[:, None]
        return Foot(sign * nearest, np.where(on[:, None], facing, away), slow)

    def outline(self, step: float, window: Domain) -> Array:
        """Points on the edges, vertices among them."""
        found = []
        for start, end in zip(*self._edges(), strict=True):
            count = max(1, int(np.ceil(np.hypot(*(end - start)) / step)))
            found.append(start + (np.arange(count) / count)[:, None] * (end - start))
        return np.concatenate(found)

    def rows(self, spacing: float, depth: float, window: Domain, inverted: bool) -> list[Array]:
        """Rows behind each edge that share the corners, or contours of the distance if the edges are short."""
        starts, ends = self._edges()
        if np.hypot(*(ends - starts).T).min() < SHORT * spacing:
            return contour_rows(self, spacing, depth, inverted)
        behind = self._inward(starts, ends) * (1.0 if inverted else -1.0)
        return edge_rows(starts, ends, behind, lambda x: np.abs(self.distance(x)), spacing, depth)

    def _edges(self) -> tuple[Array, Array]:
        starts = np.array(self.vertices)
        return starts, np.roll(starts, -1, axis=0)

    def _inward(self, starts: Array, ends: Array) -> Array:
        """The unit vector into the polygon of each edge."""
        along = ends - starts
        anticlockwise = (starts[:, 0] * ends[:, 1] - starts[:, 1] * ends[:, 0]).sum() > 0
        left = np.column_stack((-along[:, 1], along[:, 0])) / np.hypot(*along.T)[:, None]
        return np.asarray(left if anticlockwise else -left)

    def __str__(self) -> str:
        return f"polygon of {len(self.vertices)} vertices from {text(self.vertices[0])}"
