"""The base of all shapes: signed distance, normal and velocity of the nearest wall."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from math import inf, isfinite, nan
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from sphear.errors import SphearError, quoted
from sphear.neighbours.domain import Domain

Array = np.ndarray[Any, Any]
Vector = tuple[float, float]

ROUNDING = 1e-12  # relative to the coordinates: two distances that differ by less are equal


SLIPS = 1e140  # the first component of the "velocity" of a wall that fluid slips along: no wall is as fast


class Foot(NamedTuple):
    """The nearest point of a wall, seen from N points.

    Attributes:
        distance: (N,), to it, negative in the solid.
        normal: (N, 2), the unit vector into the fluid.
        velocity: (N, 2), of the wall there; `SLIPS` and 0 where fluid slips along it, so that beside others, which are
            slower, it never counts.
    """

    distance: Array
    normal: Array
    velocity: Array


class Shape(ABC):
    """A region of fluid in the plane, given by the signed distance s(x) to its walls: positive in the fluid.

    Shapes are joined with `|` (fluid of either), `&` (fluid of both), `-` (fluid without) and `~` (fluid and solid
    exchanged). Lengths are in any one unit.

    Examples:
        >>> import sphear
        >>> region = sphear.Rectangle((0, 0), (4, 1)) - sphear.Circle((1, 0.5), 0.2)
        >>> isinstance(region, sphear.Shape), region.bounds
        (True, ((0.0, 0.0), (4.0, 1.0)))
        >>> region.distance([(1.0, 0.5), (1.0, 0.8), (3.0, 0.5)]).round(2)  # in the solid, near it, amid the fluid
        array([-0.2,  0.1,  0.5])
    """

    @property
    def parts(self) -> tuple[Shape, ...]:
        """The shapes that this one is made of; none for a primitive."""
        return ()

    @property
    @abstractmethod
    def bounds(self) -> tuple[Vector, Vector]:
        """The lower and upper corner of a box that holds the fluid, infinite where the fluid is."""

    @abstractmethod
    def seen_from(self, points: Array) -> Foot:
        """Distance, normal and velocity of the nearest wall for points (N, 2) of float64."""

    @abstractmethod
    def primitives(self, inverted: bool = False) -> tuple[tuple[Primitive, bool], ...]:
        """The primitives that it is made of, each with whether its inside is solid."""

    def distance_from(self, points: Array) -> Array:
        """The signed distances (N,) alone of points (N, 2) of float64: asked for in every step, so without the rest."""
        return self.seen_from(points).distance

    def foot(self, points: ArrayLike) -> Foot:
        """Distance, normal and velocity of the nearest wall in one go.

        Args:
            points: (N, 2).

        Raises:
            SphearError: the points are not in the plane.
        """
        return self.seen_from(_in_the_plane(points))

    def distance(self, points: ArrayLike) -> Array:
        """The signed distance s (N,) to the nearest wall, positive in the fluid, of points (N, 2)."""
        return self.distance_from(_in_the_plane(points))

    def normal(self, points: ArrayLike) -> Array:
        """The unit vectors grad s (N, 2) into the fluid at the nearest wall, of points (N, 2)."""
        return self.foot(points).normal

    def wall_velocity(self, points: ArrayLike) -> Array:
        """The velocities (N, 2) of the nearest wall points, of points (N, 2)."""
        return self.foot(points).velocity

    def __or__(self, other: Shape) -> Shape:
        from sphear.boundaries.shapes.compound import Union

        return Union(*(self.parts if isinstance(self, Union) else (self,)), other)

    def __and__(self, other: Shape) -> Shape:
        from sphear.boundaries.shapes.compound import Intersection

        return Intersection(*(self.parts if isinstance(self, Intersection) else (self,)), other)

    def __sub__(self, other: Shape) -> Shape:
        from sphear.boundaries.shapes.compound import Difference

        return Difference(*(self.parts if isinstance(self, Difference) else (self,)), other)

    def __invert__(self) -> Shape:
        from sphear.boundaries.shapes.compound import Complement

        return self.parts[0] if isinstance(self, Complement) else Complement(self)


def _in_the_plane(points: ArrayLike) -> Array:
    x = np.asarray(points, dtype=np.float64)
    if x.ndim != 2 or x.shape[1] != 2:
        raise SphearError(f"shapes lie in the plane: points have shape (N, 2), not {x.shape}")
    return x


class Primitive(Shape):
    """A shape with walls of its own."""

    @abstractmethod
    def outline(self, step: float, window: Domain) -> Array:
        """Points (M, 2) on its walls at most a step apart, those of unbounded walls near the window only."""

    @abstractmethod
    def rows(self, spacing: float, depth: float, window: Domain, inverted: bool) -> list[Array]:
        """Places of particles behind its walls, in parts that each are evenly spaced.

        Args:
            spacing: of the particles.
            depth: up to which rows stand behind the wall, at (k + 1/2) spacing.
            window: the box of interest.
            inverted: whether the solid is inside instead of outside.
        """

    def primitives(self, inverted: bool = False) -> tuple[tuple[Primitive, bool], ...]:
        """The shape itself, with its sign."""
        return ((self, inverted),)

    def repeats(self, axis: int, period: float) -> bool:
        """True if it goes on unchanged along an axis, or ends within one period."""
        low, high = self.bounds[0][axis], self.bounds[1][axis]
        return (low, high) == (-inf, inf) or high - low < period


def plane_vector(what: str, value: object, finite: bool = True) -> Vector:
    """Two numbers; raises SphearError for anything else, naming what was given."""
    if isinstance(value, Sequence | np.ndarray) and not isinstance(value, str) and len(value) == 2:
        try:
            x, y = (number("a coordinate", each, finite) for each in value)
        except SphearError:
            pass
        else:
            return x, y
    raise SphearError(
        f"shapes lie in the plane: {what} has two{' finite' if finite else ''} numbers, not {quoted(value)}"
    )


def number(what: str, value: object, finite: bool = True) -> float:
    """A number, which may be infinite only if said so; raises SphearError for anything else, naming what was given."""
    if isinstance(value, int | float | np.number) and not isinstance(value, bool):
        try:
            number = float(value)
        except (OverflowError, TypeError):  # of whole numbers beyond all others, and of complex ones
            number = nan
        if isfinite(number) or (not finite and number == number):
            return number
    raise SphearError(f"{what} is a finite number, not {quoted(value)}")


def text(vector: Sequence[float]) -> str:
    """Two numbers as they are read."""
    return f"({vector[0]:g}, {vector[1]:g})"


def by_name(what: str, value: object) -> dict[Any, Any]:
    """A mapping, or the pairs that it is kept as; raises SphearError for anything else, naming what was given."""
    if isinstance(value, Mapping):
        return dict(value)
    if isinstance(value, tuple) and all(
        isinstance(pair, tuple) and len(pair) == 2 and isinstance(pair[0], int | str) for pair in value
    ):
        return dict(value)
    raise SphearError(f"{what} are given by name, as {{'upper': (1, 0)}} or {{0: (1, 0)}}, not {quoted(value)}")


def slowest(allowed: Array, velocities: Array) -> Array:
    """The slowest of the chosen velocities.

    Args:
        allowed: (N, M), which may be taken.
        velocities: (M, 2) or (N, M, 2).
    """
    velocities = np.broadcast_to(velocities, (*allowed.shape, 2))
    best = np.argmin(np.where(allowed, (velocities**2).sum(axis=-1), inf), axis=1)
    return np.asarray(velocities[np.arange(len(best)), best])


def slipping(velocities: Array) -> Array:
    """True for walls, of velocities (N, 2), that the fluid slips along, (N,)."""
    slips: Array = velocities[:, 0] == SLIPS
    return slips


def check_name(name: object) -> None:
    """Refuse a shape's name that is no text."""
    if not isinstance(name, str):
        raise SphearError(f"the name of a shape is a text, not {quoted(name)}")
