"""A velocity component along a straight line across the flow."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from sphear.checked import number
from sphear.errors import SphearError, quoted
from sphear.names import unknown
from sphear.simulation.interpolation import interpolated
from sphear.simulation.observers.base import Observer, whole

if TYPE_CHECKING:
    from sphear.simulation.run import Run

Array = np.ndarray[Any, Any]

COMPONENTS = ("u", "v")


@dataclass
class Profile(Observer):
    """The velocity component u or v along the line x = c or y = c, at even stations that lie in the fluid.

    Between particles it is the parabola that fits those around best, exact for quadratic fields.

    Args:
        component: "u" or "v".
        x: of a line along y; or
        y: of a line along x.
        stations: how many, wall to wall.
        every, steps, when: of the looks, see `Observer`; without any, the profile at the end.
        at_start: whether to look before the first step too.

    Attributes:
        at: coordinates along the line of the stations that lie in the fluid, (stations,), in lengths.
        rows: of every look, (time, values (stations,)), the values in lengths over times.

    Raises:
        SphearError: the line is not one, or there is no such component.

    Examples:
        >>> import sphear
        >>> observer = sphear.Profile("u", x=0.5, stations=5)
        >>> cavity = sphear.Simulation(
        ...     sphear.Rectangle((0, 0), (1, 1)),
        ...     spacing=0.1,
        ...     fluid=sphear.Fluid(kinematic_viscosity=0.01),
        ...     boundaries={"upper": sphear.NoSlip(velocity=(1.0, 0.0))},
        ...     observers=[observer],
        ... )
        >>> cavity.run(until=0.1).steps
        2
        >>> print(observer.at.round(2), observer.values.shape)
        [0.17 0.33 0.5  0.67 0.83] (5,)
    """

    component: str = "u"
    x: float | None = None
    y: float | None = None
    stations: int = 65

    def __init__(
        self,
        component: str = "u",
        *,
        x: float | None = None,
        y: float | None = None,
        stations: int = 65,
        every: float | None = None,
        steps: int | None = None,
        when: Sequence[float] | None = None,
        at_start: bool = False,
    ) -> None:
        self.component, self.x, self.y, self.stations = component, x, y, stations
        self.every, self.steps, self.when, self.rows, self.at_start = every, steps, when, [], at_start
        self.at: Array = np.empty(0)
        super().__post_init__()
        if component not in COMPONENTS:
            raise unknown("velocity component", component, COMPONENTS)
        if (x is None) == (y is None):
            raise SphearError("a profile lies along x=c or y=c: give one of them")
        if np.isnan(number(x if y is None else y)):
            raise SphearError(f"a profile lies along a finite coordinate, not {quoted(x if y is None else y)}")
        if not whole(stations):
            raise SphearError(f"a profile has a positive number of stations, not {quoted(stations)}")

    def start(self, run: Run) -> None:
        """Find the stations that lie in the fluid."""
        along, points = self._line(run)
        shape, box = run.flow.problem.shape, run.flow.problem.box
        inside = ((points >= np.array(box.lower)) & (points <= np.array(box.upper))).all(axis=1)
        if shape is not None:
            inside &= shape.distance(points) > 0
        if not inside.any():
            line = f"x={self.x:g}" if self.x is not None else f"y={self.y:g}"
            raise SphearError(f"the profile of {self.component} along {line} is nowhere in the fluid")
        self.at = along[inside]

    def _line(self, run: Run) -> tuple[Array, Array]:
        """All stations, and the points (stations, 2) there."""
        box, axis = run.flow.problem.box, 1 if self.x is not None else 0
        low, high = box.lower[axis], box.upper[axis]
        along = low + (high - low) * (np.arange(self.stations) + 1) / (self.stations + 1)
        points = np.full((self.stations, 2), self.x if self.x is not None else self.y, np.float64)
        points[:, axis] = along
        return along, points

    def look(self, run: Run) -> tuple[float, Array]:
        """The time, and the values at the stations."""
        points = np.full((len(self.at), 2), self.x if self.x is not None else self.y, np.float64)
        points[:, 1 if self.x is not None else 0] = self.at
        return run.flow.time, interpolated(run.flow, points)[:, COMPONENTS.index(self.component)]

    @property
    def values(self) -> Array:
        """The velocity component at the last look, (stations,), in lengths over times; empty before it."""
        values: Array = self.rows[-1][1] if self.rows else np.empty(0)
        return values
