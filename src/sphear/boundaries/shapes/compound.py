"""Shapes made of shapes: union, intersection, difference and complement."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass
from functools import reduce
from math import inf

import numpy as np

from sphear.boundaries.shapes.base import ROUNDING, Array, Foot, Primitive, Shape, Vector, slowest
from sphear.errors import SphearError, quoted

MOST = 1_000_000  # points times parts that are looked at in one go


@dataclass(frozen=True, init=False)
class Compound(Shape):
    """A shape made of others; where several of their walls are equally near, the slowest one's velocity counts."""

    shapes: tuple[Shape, ...]

    def __init__(self, *shapes: Shape) -> None:
        for shape in shapes:
            if not isinstance(shape, Shape):
                raise SphearError(f"only shapes can be joined to shapes, not {quoted(shape)}")
        if not shapes:
            raise SphearError(f"{self.word.format('a shape')} needs at least one")
        object.__setattr__(self, "shapes", shapes)

    word = "a compound of {}"

    @property
    def parts(self) -> tuple[Shape, ...]:
        """The shapes that this one is made of."""
        return self.shapes

    def primitives(self, inverted: bool = False) -> tuple[tuple[Primitive, bool], ...]:
        """The primitives of all its parts."""
        return tuple(found for part in self.parts for found in part.primitives(inverted))

    def seen_from(self, points: Array) -> Foot:
        """The foot of the part that counts, some points after the others where they and the parts are many."""
        tiny, count = ROUNDING * float(np.abs(points).max(initial=0.0)), max(1, MOST // len(self.parts))
        if len(points) <= count:
            return self._foot(points, tiny)
        found = [self._foot(points[first : first + count], tiny) for first in range(0, len(points), count)]
        return Foot(*(np.concatenate(arrays) for arrays in zip(*found, strict=True)))

    @abstractmethod
    def _foot(self, points: Array, tiny: float) -> Foot:
        """The foot of the part that counts, where distances that differ by less than tiny are equal."""

    def _corners(self) -> tuple[Array, Array]:
        low, high = zip(*(part.bounds for part in self.parts), strict=True)
        return np.array(low), np.array(high)

    def __str__(self) -> str:
        return self.word.format(", ".join(map(str, self.parts)))


def deciding_foot(feet: list[Foot], tiny: float, sign: float) -> Foot:
    """Choose for each point the foot of the smallest distance, or the largest if the sign is -1; equal within tiny."""
    distances = sign * np.stack([foot.distance for foot in feet], axis=1)
    best = np.argmin(distances, axis=1)
    rows = np.arange(len(best))
    nearest = distances[rows, best]
    velocities = np.stack([foot.velocity for foot in feet], axis=1)
    velocity = slowest(distances <= nearest[:, None] + tiny, velocities)
    return Foot(sign * nearest, np.stack([foot.normal for foot in feet], axis=1)[rows, best], velocity)


@dataclass(frozen=True, init=False)
class Union(Compound):
    """Fluid where any of the shapes has it: s = max(s_1, s_2, ...).

    Exact behind the walls; in the fluid no more than the distance, because a wall inside the fluid of another shape,
    which is none, still counts.
    """

    word = "union of {}"

    @property
    def bounds(self) -> tuple[Vector, Vector]:
        """The smallest box around all shapes."""
        low, high = self._corners()
        return _pair(low.min(axis=0)), _pair(high.max(axis=0))

    def distance_from(self, points: Array) -> Array:
        """The largest of the distances."""
        return reduce(np.maximum, (part.distance_from(points) for part in self.parts))

    def _foot(self, points: Array, tiny: float) -> Foot:
        """The foot of the shape whose fluid the point is in the deepest."""
        return deciding_foot([part.seen_from(points) for part in self.parts], tiny, -1.0)


@dataclass(frozen=True, init=False)
class Intersection(Compound):
    """Fluid where all of the shapes have it: s = min(s_1, s_2, ...).

    Exact in the fluid; behind a corner of two shapes the depth is no more than the distance.
    """

    word = "intersection of {}"

    @property
    def bounds(self) -> tuple[Vector, Vector]:
        """The intersection of the boxes of all shapes."""
        low, high = self._corners()
        return _pair(low.max(axis=0)), _pair(high.min(axis=0))

    def distance_from(self, points: Array) -> Array:
        """The smallest of the distances."""
        return reduce(np.minimum, (part.distance_from(points) for part in self.parts))

    def _foot(self, points: Array, tiny: float) -> Foot:
        """The foot of the shape whose wall is the nearest, or which the point is behind the farthest."""
        return deciding_foot([part.seen_from(points) for part in self.parts], tiny, 1.0)


@dataclass(frozen=True, init=False)
class Difference(Compound):
    """Fluid of the first shape without the others: s = min(s_1, -s_2, -s_3, ...), as for obstacles in a box.

    The solids of a difference (what is outside the first shape, and each of the others) must not overlap; bodies that
    do are joined first, as in a - (b | c).
    """

    word = "difference of {}"

    @property
    def bounds(self) -> tuple[Vector, Vector]:
        """The box of the first shape."""
        return self.parts[0].bounds

    def primitives(self, inverted: bool = False) -> tuple[tuple[Primitive, bool], ...]:
        """The primitives of the first shape, and of the others with fluid and solid exchanged."""
        others = (found for part in self.parts[1:] for found in part.primitives(not inverted))
        return (*self.parts[0].primitives(inverted), *others)

    def distance_from(self, points: Array) -> Array:
        """The smallest of the distances, the others' with the opposite sign."""
        first, *others = self.parts
        others_from = (-part.distance_from(points) for part in others)
        return reduce(np.minimum, others_from, first.distance_from(points))

    def _foot(self, points: Array, tiny: float) -> Foot:
        """The foot of the nearest wall of any."""
        others = [negated(part.seen_from(points)) for part in self.parts[1:]]
        return deciding_foot([self.parts[0].seen_from(points), *others], tiny, 1.0)


@dataclass(frozen=True, init=False)
class Complement(Compound):
    """Fluid where the shape has none: s = -s_1."""

    word = "complement of {}"

    def __init__(self, shape: Shape) -> None:
        super().__init__(shape)

    @property
    def bounds(self) -> tuple[Vector, Vector]:
        """The whole plane."""
        return (-inf, -inf), (inf, inf)

    def primitives(self, inverted: bool = False) -> tuple[tuple[Primitive, bool], ...]:
        """The primitives of the shape, with fluid and solid exchanged."""
        return self.parts[0].primitives(not inverted)

    def distance_from(self, points: Array) -> Array:
        """The distance from the shape with the opposite sign."""
        return -self.parts[0].distance_from(points)

    def _foot(self, points: Array, tiny: float) -> Foot:
        """The foot of the shape, from the other side."""
        return negated(self.parts[0].seen_from(points))


def negated(foot: Foot) -> Foot:
    """The same wall, with fluid and solid exchanged."""
    return Foot(-foot.distance, -foot.normal, foot.velocity)


def _pair(corner: Array) -> Vector:
    return float(corner[0]), float(corner[1])
