"""A function of one variable that is known at some stations."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import CubicSpline

from sphear.errors import SphearError
from sphear.names import unknown

FEW = 40  # stations of a curve, below which it is a table


@dataclass(frozen=True, eq=False)
class Curve:
    """A tabulated function of one variable.

    Args:
        stations: where it is known, increasing.
        values: its values there.
        gap: an interval within which there is no fluid; its ends are stations.
    """

    stations: NDArray[np.float64]
    values: NDArray[np.float64]
    gap: tuple[float, float] | None = None

    def __post_init__(self) -> None:
        for name in ("stations", "values"):
            array = np.array(getattr(self, name), dtype=np.float64)
            array.setflags(write=False)
            object.__setattr__(self, name, array)

    @property
    def table(self) -> bool:
        """True if nothing is known between its stations, as of published tables."""
        return len(self.stations) < FEW

    def at(self, stations: ArrayLike, kind: Literal["cubic", "linear"] = "cubic") -> NDArray[np.float64]:
        """The values at other stations; NaN within the gap.

        The computed curves are fine enough for it. The published tables are not: between their stations any
        interpolation is wrong by up to 0.03 to 0.05, so compare with them at their own stations.

        Args:
            stations: an array of any shape, within the tabulated stations.
            kind: "cubic", by splines (not-a-knot), or "linear".

        Raises:
            SphearError: a station is outside of the table, or the kind is unknown.
        """
        if kind not in ("cubic", "linear"):
            raise unknown("interpolation", kind, ("cubic", "linear"))
        x = np.asarray(stations, dtype=np.float64)
        first, last = self.stations[0], self.stations[-1]
        outside = ~((x >= first) & (x <= last))
        if outside.any():
            raise SphearError(f"the curve is known from {first:g} to {last:g} and not at {x[outside][0]:g}")
        found = np.full(x.shape, np.nan)
        ends = [(first, last)] if self.gap is None else [(first, self.gap[0]), (self.gap[1], last)]
        for start, end in ends:
            piece = (self.stations >= start) & (self.stations <= end)
            own, values = self.stations[piece], self.values[piece]
            inside = (x >= own[0]) & (x <= own[-1])
            found[inside] = (
                CubicSpline(own, values)(x[inside]) if kind == "cubic" else np.interp(x[inside], own, values)
            )
        return found
