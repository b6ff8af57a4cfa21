"""The fluid on one side of a straight wall."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import product
from math import hypot, inf

import numpy as np

from sphear.boundaries.shapes.base import (
    ROUNDING,
    SLIPS,
    Array,
    Foot,
    Primitive,
    Vector,
    check_name,
    plane_vector,
    text,
)
from sphear.boundaries.shapes.rows import SLACK, behind, grid, window_ticks
from sphear.errors import SphearError
from sphear.neighbours.domain import Domain


@dataclass(frozen=True)
class HalfPlane(Primitive):
    """The fluid beyond a straight wall: s = n . (x - p).

    Args:
        point: p, any on the wall.
        inward: its normal n, into the fluid; of any length but zero, kept with length one.
        velocity: of the wall, along itself.
        slips: whether fluid slips along it.
        name: by which conditions of its walls are given.

    Raises:
        SphearError: the normal is zero, or the wall moves through itself.

    Examples:
        >>> import sphear
        >>> above = sphear.HalfPlane((0, 1), inward=(0, 2))
        >>> above.inward, above.distance([(5.0, 1.5), (5.0, 0.0)])
        ((0.0, 1.0), array([ 0.5, -1. ]))
    """

    point: Vector
    inward: Vector
    velocity: Vector = (0.0, 0.0)
    slips: bool = field(default=False, kw_only=True, repr=False)
    name: str = field(default="", kw_only=True)

    def __post_init__(self) -> None:
        check_name(self.name)
        point = plane_vector("the point of a half-plane", self.point)
        x, y = plane_vector("the normal of a half-plane", self.inward)
        velocity = plane_vector("the velocity of a half-plane", self.velocity)
        scale = max(abs(x), abs(y))
        if scale == 0.0:
            raise SphearError("the normal of a half-plane points into the fluid, and so is not zero")
        x, y = x / scale, y / scale
        length = hypot(x, y)
        x, y = x / length, y / length
        if abs(velocity[0] * x + velocity[1] * y) > ROUNDING * hypot(*velocity):
            raise SphearError(
                f"the wall of the half-plane at {text(point)} moves through itself at {text(velocity)}: a wall may"
                " move only along itself"
            )
        object.__setattr__(self, "point", point)
        object.__setattr__(self, "inward", (x, y))
        object.__setattr__(self, "velocity", velocity)

    @property
    def bounds(self) -> tuple[Vector, Vector]:
        """Infinite but for the wall, if that is along an axis."""
        low, high = [-inf, -inf], [inf, inf]
        for axis in range(2):
            if abs(self.inward[axis]) == 1.0:
                (low if self.inward[axis] > 0 else high)[axis] = self.point[axis]
        return (low[0], low[1]), (high[0], high[1])

    def repeats(self, axis: int, period: float) -> bool:
        """True if the wall is along the axis."""
        return self.inward[axis] == 0.0

    def distance_from(self, points: Array) -> Array:
        """The distance to the wall."""
        return np.asarray((points - np.array(self.point)) @ np.array(self.inward))

    def seen_from(self, points: Array) -> Foot:
        """Distance, normal and velocity of the wall."""
        distance = self.distance_from(points)
        velocity = (SLIPS, 0.0) if self.slips else self.velocity
        return Foot(distance, np.tile(self.inward, (len(points), 1)), np.tile(velocity, (len(points), 1)))

    def outline(self, step: float, window: Domain) -> Array:
        """Points on the wall, as far as the window reaches."""
        low, high = self._reach(window, 2.0 * step)
        s = np.linspace(low, high, max(2, int(np.ceil((high - low) / step)) + 1))
        return np.array(self.point) + s[:, None] * self._along()

    def rows(self, spacing: float, depth: float, window: Domain, inverted: bool) -> list[Array]:
        """Rows along the wall; behind a wall along an axis they stand on the lattice of the window."""
        below = behind(spacing, depth) * (1.0 if inverted else -1.0)
        for axis in range(2):
            if abs(self.inward[axis]) == 1.0:
                across = self.point[axis] + self.inward[axis] * below
                ticks = window_ticks(window, 1 - axis, spacing, depth)
                return [grid(across, ticks) if axis == 0 else grid(ticks, across)]
        low, high = self._reach(window, depth)
        first, last = np.ceil(low / spacing - 0.5 - SLACK), np.floor(high / spacing - 0.5 + SLACK)
        found = grid((np.arange(first, last + 1) + 0.5) * spacing, below)
        return [np.array(self.point) + found[:, :1] * self._along() + found[:, 1:] * np.array(self.inward)]

    def _along(self) -> Array:
        return np.array((self.inward[1], -self.inward[0]))

    def _reach(self, window: Domain, beyond: float) -> tuple[float, float]:
        """Where along the wall, from its point, the window and what is around it begins and ends."""
        corners = np.array(list(product(*zip(window.lower, window.upper, strict=True))))
        s = (corners - np.array(self.point)) @ self._along()
        return float(s.min()) - 2.0 * beyond, float(s.max()) + 2.0 * beyond

    def __str__(self) -> str:
        return f"half-plane from {text(self.point)} towards {text(self.inward)}"
