"""A box whose sides are periodic or walls: which images of particles there are beyond them."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf
from typing import Any, Literal

import numpy as np

from sphear.engine.cache import compiled
from sphear.errors import SphearError

Array = np.ndarray[Any, Any]
Side = Literal["periodic", "walls"]

PERIODIC, WALLS = 0, 1


@dataclass(frozen=True)
class Box:
    """A box, along each axis periodic or between two walls.

    Attributes:
        lower: the lower corner.
        upper: the upper corner.
        sides: "periodic" or "walls", one an axis; walls along one axis at most.
        lower_velocity: of the wall at the lower end; () is at rest.
        upper_velocity: of the wall at the upper end; () is at rest.

    Raises:
        SphearError: the corners, sides and velocities do not belong together.
    """

    lower: tuple[float, ...]
    upper: tuple[float, ...]
    sides: tuple[Side, ...]
    lower_velocity: tuple[float, ...] = ()
    upper_velocity: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        dimension = len(self.lower)
        if not len(self.upper) == len(self.sides) == dimension:
            raise SphearError(
                f"a box has as many corner coordinates as sides, not {dimension}, {len(self.upper)} and"
                f" {len(self.sides)}"
            )
        if not all(-inf < low < high < inf for low, high in zip(self.lower, self.upper, strict=True)):
            raise SphearError(f"the upper corner of a box lies beyond the lower one, not {self.upper} and {self.lower}")
        for side in self.sides:
            if side not in ("periodic", "walls"):
                raise SphearError(f"the sides of a box are 'periodic' or 'walls', not {side!r}")
        for velocity in (self.lower_velocity, self.upper_velocity):
            if velocity and len(velocity) != dimension:
                raise SphearError(f"the velocity of a wall has {dimension} components, not {len(velocity)}")
        if self.sides.count("walls") > 1:
            raise SphearError("a box has walls along one axis at most: mirror particles know no corners")

    @property
    def wall_axis(self) -> int:
        """The axis that ends at walls; -1 if none does."""
        return self.sides.index("walls") if "walls" in self.sides else -1

    def arrays(self) -> tuple[Array, Array, Array, Array]:
        """Lower and upper corner, the kinds of sides and the walls' velocities, (2, d), for compiled code."""
        kinds = np.array([WALLS if side == "walls" else PERIODIC for side in self.sides])
        at_rest = (0.0,) * len(self.lower)
        velocities = np.array([self.lower_velocity or at_rest, self.upper_velocity or at_rest], np.float64)
        return np.array(self.lower, np.float64), np.array(self.upper, np.float64), kinds, velocities


@compiled
def with_images(x, lower, upper, kinds, reach):  # type: ignore[no-untyped-def]
    """Particles (N, d), moved by whole periods into the box, and their images within `reach` beyond its sides.

    Returns:
        positions: (E, d), the particles first.
        source: (E,), the particle that each is an image of.
        wall: (E,), 0 for particles and periodic images, 1 for mirror images at the lower wall, 2 at the upper one.
        depth: (E,), how far beyond its wall a mirror image lies.
    """
    count, dimension = x.shape
    room = 2 * count + 1000
    positions = np.empty((room, dimension))
    source = np.empty(room, np.int32)
    wall = np.zeros(room, np.int8)
    depth = np.zeros(room)
    for i in range(count):
        source[i] = i
        for axis in range(dimension):
            period = upper[axis] - lower[axis]
            inside = x[i, axis]
            if kinds[axis] == 0:
                inside = lower[axis] + (inside - lower[axis]) % period
            positions[i, axis] = inside
    entries = count
    for axis in range(dimension):
        period = upper[axis] - lower[axis]
        images = int(np.ceil(reach / period)) if kinds[axis] == 0 else 1
        for e in range(entries):
            for image in range(1, images + 1):
                for side in range(2):
                    at = positions[e, axis]
                    if kinds[axis] == 0:
                        place = at + image * period if side else at - image * period
                    else:
                        place = 2.0 * upper[axis] - at if side else 2.0 * lower[axis] - at
                    beyond = place - upper[axis] if side else lower[axis] - place
                    if beyond < 0.0 or beyond >= reach:
                        continue
                    if entries == room:
                        positions = np.concatenate((positions, np.empty((room, dimension))))
                        source = np.concatenate((source, np.empty(room, np.int32)))
                        wall = np.concatenate((wall, np.zeros(room, np.int8)))
                        depth = np.concatenate((depth, np.zeros(room)))
                        room *= 2
                    for other in range(dimension):
                        positions[entries, other] = positions[e, other]
                    positions[entries, axis] = place
                    source[entries] = source[e]
                    wall[entries], depth[entries] = wall[e], depth[e]
                    if kinds[axis] != 0:
                        wall[entries], depth[entries] = 1 + side, beyond
                    entries += 1
    return positions[:entries], source[:entries], wall[:entries], depth[:entries]
