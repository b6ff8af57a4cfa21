"""A shape that goes on along the periodic axes of a window."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import reduce
from itertools import product
from math import isfinite

import numpy as np

from sphear.boundaries.shapes.base import Array, Foot, Primitive, Shape, Vector
from sphear.errors import SphearError
from sphear.neighbours.domain import Domain


@dataclass(frozen=True)
class Repeated(Shape):
    """The images of a primitive in all periods of a window; the nearest wall of any of them counts.

    Images do not overlap, so that it is the wall of the image that a point lies in, or of the nearest.

    Args:
        shape: its walls are each less than a period long along a periodic axis, or go on along it for ever.
        window: with the periodic axes.

    Raises:
        SphearError: the shape cannot repeat along a periodic axis.
    """

    shape: Primitive
    window: Domain

    def __post_init__(self) -> None:
        for axis in self.window.periodic_axes:
            low, high = self.window.lower[axis], self.window.upper[axis]
            name = "xy"[axis]
            if not self.shape.repeats(axis, high - low):
                raise SphearError(
                    f"the {self.shape} cannot repeat along the periodic axis {name}: its walls must lie within one"
                    f" period of {high - low:g}, or go on along the axis for ever"
                )
            ends = self.shape.bounds[0][axis], self.shape.bounds[1][axis]
            if all(map(isfinite, ends)) and not low <= 0.5 * (ends[0] + ends[1]) <= high:
                raise SphearError(
                    f"the {self.shape} lies outside the period of {name} from {low:g} to {high:g}: move it by whole"
                    " periods into it"
                )

    @property
    def parts(self) -> tuple[Shape, ...]:
        """The shape that repeats."""
        return (self.shape,)

    @property
    def bounds(self) -> tuple[Vector, Vector]:
        """Infinite along the periodic axes."""
        (x0, y0), (x1, y1) = self.shape.bounds
        px, py = (axis in self.window.periodic_axes for axis in range(2))
        inf = float("inf")
        return (-inf if px else x0, -inf if py else y0), (inf if px else x1, inf if py else y1)

    def primitives(self, inverted: bool = False) -> tuple[tuple[Primitive, bool], ...]:
        """The primitives of one image."""
        return self.shape.primitives(inverted)

    def distance_from(self, points: Array) -> Array:
        """The distance to the nearest of the images in the window and in the periods beside it."""
        first, *others = (self.shape.distance_from(image) for image in self._images(points))
        return reduce(lambda best, other: np.where(np.abs(other) < np.abs(best), other, best), others, first)

    def seen_from(self, points: Array) -> Foot:
        """The foot on the nearest of the images in the window and in the periods beside it."""
        best: Foot | None = None
        for image in self._images(points):
            foot = self.shape.seen_from(image)
            if best is None:
                best = foot
                continue
            nearer = np.abs(foot.distance) < np.abs(best.distance)
            best = Foot(
                np.where(nearer, foot.distance, best.distance),
                np.where(nearer[:, None], foot.normal, best.normal),
                np.where(nearer[:, None], foot.velocity, best.velocity),
            )
        assert best is not None
        return best

    def _images(self, points: Array) -> Iterator[Array]:
        """Points as each image sees them, (N, 2), that in the window first."""
        inside = self.window.wrapped(points)
        periods = np.array(self.window.upper) - np.array(self.window.lower)
        steps = [(0, -1, 1) if axis in self.window.periodic_axes else (0,) for axis in range(2)]
        return (inside - np.array(shift) * periods for shift in product(*steps))

    def __str__(self) -> str:
        return f"{self.shape}, repeated"


def repeated(shape: Shape, window: Domain) -> Shape:
    """The shape itself where nothing is periodic, else that which the images of its primitives make.

    Raises:
        SphearError: the window is not in the plane, or the shape cannot repeat along a periodic axis.
    """
    if window.dimension != 2:
        raise SphearError(f"shapes lie in the plane: their window has 2 axes, not {window.dimension}")
    if not window.periodic_axes:
        return shape
    if isinstance(shape, Primitive):
        return Repeated(shape, window)
    return type(shape)(*(repeated(part, window) for part in shape.parts))
