"""Where particles are: open space, or a box that is periodic along some axes."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from sphear.errors import SphearError
from sphear.neighbours.limits import refuse_images

FloatArray = np.ndarray[Any, np.dtype[np.float64]]


@dataclass(frozen=True)
class Domain:
    """A box, periodic along the axes that say so and open along the others.

    Args:
        lower: the lower corner, one number an axis.
        upper: the upper corner.
        periodic: for each axis whether the flow repeats; a single bool holds for all axes.

    Raises:
        SphearError: the corners span no box of 1 to 3 axes, or periodic has another number of them.

    Examples:
        >>> import numpy as np
        >>> import sphear
        >>> domain = sphear.Domain((0, 0), (1, 1), periodic=(True, False))
        >>> domain.periodic_axes, domain.wrapped(np.array([(1.25, 0.5)]))
        ((0,), array([[0.25, 0.5 ]]))
    """

    lower: tuple[float, ...]
    upper: tuple[float, ...]
    periodic: tuple[bool, ...] | bool = True

    def __post_init__(self) -> None:
        try:
            lower, upper = (tuple(float(x) for x in corner) for corner in (self.lower, self.upper))
        except (TypeError, ValueError):
            raise SphearError(
                f"a domain needs a number for each axis of its corners, not {self.lower!r} and {self.upper!r}"
            ) from None
        flags = (
            tuple(map(bool, self.periodic))
            if isinstance(self.periodic, Iterable)
            else (bool(self.periodic),) * len(lower)
        )
        if not len(lower) == len(upper) == len(flags) or not 1 <= len(lower) <= 3:
            raise SphearError(
                f"a domain needs one lower bound, upper bound and periodic flag for each of 1 to 3 axes, "
                f"not {len(lower)}, {len(upper)} and {len(flags)}"
            )
        for axis, (low, high) in enumerate(zip(lower, upper, strict=True)):
            if not (np.isfinite(low) and np.isfinite(high) and low < high):
                raise SphearError(f"a domain must extend along axis {axis}: {low:g} to {high:g} does not")
        object.__setattr__(self, "lower", lower)
        object.__setattr__(self, "upper", upper)
        object.__setattr__(self, "periodic", flags)

    @property
    def dimension(self) -> int:
        """The number of axes."""
        return len(self.lower)

    @property
    def periodic_axes(self) -> tuple[int, ...]:
        """The axes along which the flow repeats."""
        assert isinstance(self.periodic, tuple)
        return tuple(axis for axis, flag in enumerate(self.periodic) if flag)

    def wrapped(self, positions: FloatArray) -> FloatArray:
        """The positions (N, d), moved by whole periods into the box along the periodic axes."""
        if not self.periodic_axes:
            return positions
        inside = positions.copy()
        for axis in self.periodic_axes:
            low, period = self.lower[axis], self.upper[axis] - self.lower[axis]
            inside[:, axis] = low + np.mod(inside[:, axis] - low, period)
        return inside

    def shortest(self, ways: FloatArray) -> FloatArray:
        """Differences of positions (N, d) as those to the nearest periodic image."""
        found = ways.copy()
        for axis in self.periodic_axes:
            period = self.upper[axis] - self.lower[axis]
            found[:, axis] -= period * np.rint(found[:, axis] / period)
        return found

    def with_images(self, positions: FloatArray, reach: float) -> tuple[FloatArray, np.ndarray[Any, Any]]:
        """Positions and the periodic images within `reach` of the box, and the particle that each one is of.

        Images are particles like any other to everything that follows, so no sweep knows of periods; a period shorter
        than the reach simply takes more images.

        Raises:
            SphearError: they would take more than half of the free memory.
        """
        if self.periodic_axes:
            periods = np.subtract(self.upper, self.lower)[list(self.periodic_axes)]
            refuse_images(len(positions), periods, reach)
        inside = self.wrapped(positions)
        source = np.arange(len(positions), dtype=np.int32)
        for axis in self.periodic_axes:
            low, high = self.lower[axis], self.upper[axis]
            period = high - low
            parts, sources = [inside], [source]
            for image in range(1, int(np.ceil(reach / period)) + 1):
                for shift in (image * period, -image * period):
                    moved = inside[:, axis] + shift
                    near = (moved > low - reach) & (moved < high + reach)
                    copies = inside[near]
                    copies[:, axis] = moved[near]
                    parts.append(copies)
                    sources.append(source[near])
            inside, source = np.concatenate(parts), np.concatenate(sources)
        return inside, source
