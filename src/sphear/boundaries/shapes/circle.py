"""A circle of fluid, or a cylinder where it is taken away."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from sphear.boundaries.shapes.base import SLIPS, Array, Foot, Primitive, Vector, check_name, number, plane_vector, text
from sphear.boundaries.shapes.rows import behind
from sphear.errors import SphearError
from sphear.neighbours.domain import Domain

FASTEST = 1e100  # beyond, squares overflow


@dataclass(frozen=True)
class Circle(Primitive):
    """The fluid in a circle: s = R - |x - c|; its wall turns with u = spin (-(y - c_y), x - c_x).

    Args:
        centre: c.
        radius: R.
        spin: angular velocity of the wall about its centre, anticlockwise, in radians a time.
        slips: whether fluid slips along its wall.
        name: by which conditions of its walls are given.

    Raises:
        SphearError: there is no such circle, or its wall is too fast.

    Examples:
        >>> import sphear
        >>> drum = sphear.Circle((0, 0), 1.0, spin=2.0)
        >>> distance, normal, velocity = drum.foot([(0.75, 0.0)])
        >>> print(distance, normal, abs(velocity))
        [0.25] [[-1. -0.]] [[0. 2.]]
    """

    centre: Vector
    radius: float
    spin: float = 0.0
    slips: bool = field(default=False, kw_only=True, repr=False)
    name: str = field(default="", kw_only=True)

    def __post_init__(self) -> None:
        check_name(self.name)
        object.__setattr__(self, "centre", plane_vector("the centre of a circle", self.centre))
        object.__setattr__(self, "radius", number("the radius of a circle", self.radius))
        object.__setattr__(self, "spin", number("the spin of a circle", self.spin))
        if self.radius <= 0:
            raise SphearError(f"the radius of a circle is positive, not {self.radius:g}")
        if abs(self.spin * self.radius) > FASTEST:
            raise SphearError(
                f"the wall of the {self} turns too fast to be computed with, with a spin of {self.spin:g}"
            )

    @property
    def bounds(self) -> tuple[Vector, Vector]:
        """The square around it."""
        (x, y), r = self.centre, self.radius
        return (x - r, y - r), (x + r, y + r)

    def distance_from(self, points: Array) -> Array:
        """The distance to the circle."""
        (x, y), (a, b) = points.T, self.centre
        return np.asarray(self.radius - np.hypot(x - a, y - b))

    def seen_from(self, points: Array) -> Foot:
        """Distance, normal and velocity of the nearest point of the circle; the centre sees its right end."""
        from_centre = points - np.array(self.centre)
        r = np.hypot(from_centre[:, 0], from_centre[:, 1])
        apart = r > 0
        outward = np.where(apart[:, None], from_centre / np.where(apart, r, 1.0)[:, None], np.array([1.0, 0.0]))
        turning = self.spin * self.radius * np.column_stack((-outward[:, 1], outward[:, 0]))
        if self.slips:
            turning[:] = SLIPS, 0.0
        return Foot(self.radius - r, -outward, turning)

    def outline(self, step: float, window: Domain) -> Array:
        """Points around it."""
        return self._ring(self.radius, max(16, int(np.ceil(2 * np.pi * self.radius / step))), 0.0)

    def rows(self, spacing: float, depth: float, window: Domain, inverted: bool) -> list[Array]:
        """Rings one spacing apart, every second one turned by half a particle."""
        found = [np.empty((0, 2))]
        for k, below in enumerate(behind(spacing, depth)):
            r = self.radius - below if inverted else self.radius + below
            if r < -1e-9 * spacing:
                break
            count = max(1, round(2 * np.pi * r / spacing))
            found.append(self._ring(r if count > 1 else 0.0, count, 0.5 * (k % 2)))
        return [np.concatenate(found)]

    def _ring(self, radius: float, count: int, first: float) -> Array:
        angles = 2 * np.pi * (np.arange(count) + first) / count
        return np.array(self.centre) + radius * np.column_stack((np.cos(angles), np.sin(angles)))

    def __str__(self) -> str:
        return f"circle at {text(self.centre)} of radius {self.radius:g}"
