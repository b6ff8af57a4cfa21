"""A box whose sides are periodic or walls: which images of particles there are beyond them and on them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf
from typing import Any, Literal

import numpy as np

from sphear.checked import numbers
from sphear.engine.cache import compiled, inlined
from sphear.errors import SphearError, quoted

Array = np.ndarray[Any, Any]
Side = Literal["periodic", "walls"]

PERIODIC, MIRRORS, OPEN = 0, 1, 2
LEAST_LENGTH, LARGEST_LENGTH = 1e-50, 1e50
ON_WALL = 64  # the bit of entries that stand on a wall


@dataclass(frozen=True)
class Box:
    """A box, along each axis periodic or between two walls.

    Attributes:
        lower: the lower corner.
        upper: the upper corner.
        sides: "periodic" or "walls", one an axis.
        lower_velocity: of the wall at the lower end of the last axis that has walls; () is at rest.
        upper_velocity: of the wall at its upper end; () is at rest.
        free_slip: walls that fluid slips along, as pairs of axis and end, 0 the lower and 1 the upper one.

    Raises:
        SphearError: the corners, sides and velocities do not belong together.
    """

    lower: tuple[float, ...]
    upper: tuple[float, ...]
    sides: tuple[Side, ...]
    lower_velocity: tuple[float, ...] = ()
    upper_velocity: tuple[float, ...] = ()
    free_slip: tuple[tuple[int, int], ...] = ()

    def __post_init__(self) -> None:
        for name in ("lower", "upper"):
            corner = getattr(self, name)
            if not 1 <= len(found := numbers(corner, finite=False)) <= 3:
                raise SphearError(
                    f"the {name} corner of a box has one to three numbers, one an axis, not {quoted(corner)}"
                )
            object.__setattr__(self, name, found)
        sides: object = self.sides
        if isinstance(sides, str) or not isinstance(sides, Sequence):
            raise SphearError(
                f"the sides of a box are given one an axis, as in ('periodic', 'walls'), not {quoted(sides)}"
            )
        object.__setattr__(self, "sides", tuple(sides))
        dimension = len(self.lower)
        if not len(self.upper) == len(self.sides) == dimension:
            raise SphearError(
                f"a box has as many corner coordinates as sides, not {dimension}, {len(self.upper)} and"
                f" {len(self.sides)}"
            )
        if not all(-inf < low < high < inf for low, high in zip(self.lower, self.upper, strict=True)):
            raise SphearError(f"the upper corner of a box lies beyond the lower one, not {self.upper} and {self.lower}")
        extents = [high - low for low, high in zip(self.lower, self.upper, strict=True)]
        if not LEAST_LENGTH <= min(extents) <= max(extents) <= LARGEST_LENGTH:
            raise SphearError(
                f"the sides of a box are from {LEAST_LENGTH:g} to {LARGEST_LENGTH:g} long, or powers of them vanish or"
                f" overflow, not {' and '.join(f'{extent:g}' for extent in extents)}"
            )
        for side in self.sides:
            if side not in ("periodic", "walls"):
                raise SphearError(f"the sides of a box are 'periodic' or 'walls', not {quoted(side)}")
        for name in ("lower", "upper"):
            object.__setattr__(self, f"{name}_velocity", self._wall_velocity(name))

    def _wall_velocity(self, name: str) -> tuple[float, ...]:
        """The velocity of a wall, checked."""
        velocity = getattr(self, f"{name}_velocity")
        if isinstance(velocity, tuple | list) and not len(velocity):
            return ()
        found, dimension = numbers(velocity), len(self.lower)
        if hasattr(velocity, "__len__") and not isinstance(velocity, str) and len(velocity) != dimension:
            raise SphearError(f"the velocity of a wall has {dimension} components, not {len(velocity)}")
        if not found:
            raise SphearError(f"the velocity of a wall has {dimension} finite numbers, not {quoted(velocity)}")
        if not any(found):
            return found
        if not self.wall_axes:
            raise SphearError(
                f"the {name} velocity of a box is that of a wall, and this box has none: {quoted(velocity)} would move"
                " nothing"
            )
        axis = self.wall_axes[-1]
        if found[axis]:
            raise SphearError(
                f"the {name} wall of a box, across the axis {'xyz'[axis]}, would move through itself at"
                f" {quoted(velocity)}: a wall may move only along itself"
            )
        return found

    @property
    def periodic(self) -> tuple[bool, ...]:
        """True for each axis along which the box repeats, (d,)."""
        return tuple(side == "periodic" for side in self.sides)

    @property
    def wall_axes(self) -> tuple[int, ...]:
        """The axes that end at walls."""
        return tuple(axis for axis, side in enumerate(self.sides) if side == "walls")

    def arrays(self, mirrored: bool = True) -> tuple[Array, Array, Array, Array]:
        """Lower and upper corner, the kinds of sides and the walls' velocities, (d, 2, d + 1), for compiled code.

        Behind a wall's velocity is 1 where fluid slips along it, else 0.

        Args:
            mirrored: whether particles have mirror images at walls; else there is nothing beyond them.
        """
        dimension = len(self.lower)
        kinds = np.array([(MIRRORS if mirrored else OPEN) if side == "walls" else PERIODIC for side in self.sides])
        velocities = np.zeros((dimension, 2, dimension + 1))
        for axis in self.wall_axes[-1:]:
            for side, velocity in enumerate((self.lower_velocity, self.upper_velocity)):
                velocities[axis, side, :dimension] = velocity or 0.0
        for axis, side in self.free_slip:
            velocities[axis, side, dimension] = 1.0
        return np.array(self.lower, np.float64), np.array(self.upper, np.float64), kinds, velocities


@inlined
def fill_images(x, lower, upper, kinds, reach, on_wall, positions, source, wall):  # type: ignore[no-untyped-def]
    """Write the entries of `with_images`; their number, or -1 if the arrays have no room for all."""
    count, dimension = x.shape
    for i in range(count):
        source[i], wall[i] = i, 0
        for axis in range(dimension):
            inside = x[i, axis]
            if kinds[axis] == 0 and not lower[axis] <= inside < upper[axis]:  # a remainder takes its time
                inside = lower[axis] + (inside - lower[axis]) % (upper[axis] - lower[axis])
            positions[i, axis] = inside
    entries = count
    for axis in range(dimension):
        if kinds[axis] == 2:
            continue
        low, high = lower[axis], upper[axis]
        period = high - low
        for e in range(entries):
            at = positions[e, axis]
            for side in range(2):
                # how far beyond a side its first image is: that of the other side's particles, or of its own
                beyond = at - low if (kinds[axis] == 0) == (side == 1) else high - at
                image = 1
                # a particle on its way through a mirror has its image before it
                while beyond < reach and (beyond >= 0.0 or image < 3) and (kinds[axis] == 0 or image < 3):
                    place = high + beyond if side else low - beyond
                    on = image == 2 and kinds[axis] == 1
                    if on:
                        place = high if side else low
                    if not on or abs(at - place) < on_wall:
                        if entries == len(source):
                            return -1
                        for other in range(dimension):
                            positions[entries, other] = positions[e, other]
                        positions[entries, axis] = place
                        source[entries] = source[e]
                        wall[entries] = wall[e]
                        if kinds[axis] == 1:
                            wall[entries] |= (1 << (2 * axis + side)) | (64 if on else 0)
                        entries += 1
                    image += 1
                    if kinds[axis] == 0:
                        beyond += period
    return entries


@compiled
def with_images(x, lower, upper, kinds, reach, on_wall):  # type: ignore[no-untyped-def]
    """Particles (N, d), moved by whole periods into the box, and their images within `reach` beyond its sides.

    Args:
        x: positions of the particles.
        lower: the lower corner.
        upper: the upper corner.
        kinds: of the sides, one an axis.
        reach: how far beyond its sides images are wanted.
        on_wall: particles nearer to a mirroring wall than this have an image on the wall too; 0 for none.

    Returns:
        positions: (E, d), the particles first.
        source: (E,), the particle that each is an image of.
        wall: (E,), the walls that an image was reflected at, bit 2 axis + side, with bit 6 for images on a wall.
    """
    count, dimension = x.shape
    room = count + count // 4 + 100
    while True:
        # anew for each attempt: an array that a loop replaces is counted at each of its turns
        positions, source, wall = np.empty((room, dimension)), np.empty(room, np.int32), np.empty(room, np.uint8)
        entries = fill_images(x, lower, upper, kinds, reach, on_wall, positions, source, wall)
        if entries >= 0:
            return positions[:entries], source[:entries], wall[:entries]
        room *= 2
