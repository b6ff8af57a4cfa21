"""A rectangle of fluid, whose sides may slide."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import inf, isfinite

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
    slowest,
    text,
)
from sphear.boundaries.shapes.rows import behind, grid, inside, window_ticks
from sphear.errors import SphearError
from sphear.names import unknown
from sphear.neighbours.domain import Domain

SIDES = ("left", "right", "lower", "upper")
NORMALS = np.array([(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)])


@dataclass(frozen=True)
class Rectangle(Primitive):
    """The fluid between two corners: s = min(x - x_l, x_u - x, y - y_l, y_u - y) inside, -|x - nearest| outside.

    Where two walls are equally near, at a corner and beyond it, the slower one's velocity counts.

    Args:
        lower: the lower corner; -inf where there is no wall.
        upper: the upper corner; inf where there is no wall.
        velocities: of the sides "left", "right", "lower" and "upper" that slide, each along itself.
        slips: sides that fluid slips along.
        name: by which conditions of its walls are given.

    Raises:
        SphearError: the corners do not span a rectangle, or a side moves through itself.

    Examples:
        >>> import sphear
        >>> channel = sphear.Rectangle((0, 0), (4, 1), velocities={"upper": (1.0, 0.0)})
        >>> distance, normal, velocity = channel.foot([(2.0, 0.75)])
        >>> print(distance, velocity)
        [0.25] [[1. 0.]]
    """

    lower: Vector
    upper: Vector
    velocities: Mapping[str, Vector] | tuple[tuple[str, Vector], ...] = ()
    slips: tuple[str, ...] = field(default=(), kw_only=True, repr=False)
    name: str = field(default="", kw_only=True)

    def __post_init__(self) -> None:
        check_name(self.name)
        lower = plane_vector("the lower corner of a rectangle", self.lower, finite=False)
        upper = plane_vector("the upper corner of a rectangle", self.upper, finite=False)
        if not all(low < high and low < inf and high > -inf for low, high in zip(lower, upper, strict=True)):
            raise SphearError(f"a rectangle needs its upper corner beyond its lower one, not {upper} and {lower}")
        given = by_name("the velocities of the sides of a rectangle", self.velocities)
        kept = []
        for side, value in given.items():
            if side not in SIDES:
                raise unknown("side of a rectangle", side, SIDES)
            velocity = plane_vector(f"the velocity of the {side} side of a rectangle", value)
            if velocity[SIDES.index(side) // 2] != 0.0:
                raise SphearError(
                    f"the {side} side of the rectangle moves through the wall at {text(velocity)}: a wall may move"
                    " only along itself"
                )
            kept.append((side, velocity))
        for side in self.slips:
            if side not in SIDES:
                raise unknown("side of a rectangle", side, SIDES)
        object.__setattr__(self, "lower", lower)
        object.__setattr__(self, "upper", upper)
        object.__setattr__(self, "velocities", tuple(sorted(kept, key=lambda pair: SIDES.index(pair[0]))))

    @property
    def bounds(self) -> tuple[Vector, Vector]:
        """Its corners."""
        return self.lower, self.upper

    def distance_from(self, points: Array) -> Array:
        """The distance to the nearest side."""
        (left, lower), (right, upper) = self.lower, self.upper
        x, y = points.T
        across, up = np.minimum(x - left, right - x), np.minimum(y - lower, upper - y)
        inner: Array = np.minimum(across, up)
        out = np.flatnonzero(inner < 0)
        inner[out] = -np.hypot(np.minimum(across[out], 0.0), np.minimum(up[out], 0.0))
        return inner

    def seen_from(self, points: Array) -> Foot:
        """Distance, normal and velocity of the nearest side."""
        low, high = np.array(self.lower), np.array(self.upper)
        to_sides = np.stack((points - low, high - points), axis=2).reshape(len(points), 4)  # in the order of SIDES
        inner = to_sides.min(axis=1)
        into = np.clip(points, low, high) - points  # zero inside
        outer = np.hypot(into[:, 0], into[:, 1])
        corners = [abs(c) for c in (*self.lower, *self.upper) if isfinite(c)]
        tiny = ROUNDING * max(corners, default=0.0)
        near = to_sides <= np.maximum(inner, 0.0)[:, None] + tiny
        normal = NORMALS[np.argmin(to_sides, axis=1)]
        on = np.abs(inner) <= tiny  # at a corner the bisecting one
        both = near[on] @ NORMALS
        length = np.hypot(both[:, 0], both[:, 1])[:, None]
        normal[on] = np.where(length > 0.5, both / np.maximum(length, 0.5), normal[on])
        out = (outer > tiny) & (inner < 0)
        normal[out] = into[out] / outer[out, None]
        moving = dict(self.velocities)
        free = dict.fromkeys(self.slips, (SLIPS, 0.0))
        speeds = np.array([{**moving, **free}.get(side, (0.0, 0.0)) for side in SIDES])
        return Foot(np.where(inner < 0, -outer, inner), normal, slowest(near, speeds))

    def outline(self, step: float, window: Domain) -> Array:
        """Points on the sides, corners among them."""
        beyond = 2.0 * step
        ends = [
            (low if isfinite(low) else window.lower[k] - beyond, high if isfinite(high) else window.upper[k] + beyond)
            for k, (low, high) in enumerate(zip(self.lower, self.upper, strict=True))
        ]
        found = []
        for axis in range(2):
            count = max(2, int(np.ceil((ends[axis][1] - ends[axis][0]) / step)) + 1)
            along = np.linspace(*ends[axis], count)
            for wall in (self.lower[1 - axis], self.upper[1 - axis]):
                if isfinite(wall):
                    pair = (along, np.full(count, wall))
                    found.append(np.column_stack(pair if axis == 0 else pair[::-1]))
        return np.concatenate(found) if found else np.empty((0, 2))

    def rows(self, spacing: float, depth: float, window: Domain, inverted: bool) -> list[Array]:
        """The lattice of the inside, or the one that continues it outside, corners included."""
        ticks, within = [], []
        for axis, (low, high) in enumerate(zip(self.lower, self.upper, strict=True)):
            before = low - behind(spacing, depth)[::-1] if isfinite(low) else np.empty(0)
            after = high + behind(spacing, depth) if isfinite(high) else np.empty(0)
            if isfinite(low) and isfinite(high):
                between = low + inside(high - low, spacing)
            elif isfinite(low):
                between = low + behind(spacing, max(0.0, window.upper[axis] + depth - low))
            elif isfinite(high):
                between = high - behind(spacing, max(0.0, high - window.lower[axis] + depth))[::-1]
            else:
                between = window_ticks(window, axis, spacing, depth)
            ticks.append(np.concatenate((before, between, after)))
            within.append((ticks[-1] > low) & (ticks[-1] < high))
        inner = np.outer(*within).ravel()
        return [grid(*ticks)[inner if inverted else ~inner]]

    def __str__(self) -> str:
        return f"rectangle from {text(self.lower)} to {text(self.upper)}"
