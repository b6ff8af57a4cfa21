"""The velocity at one point against time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from sphear.checked import numbers
from sphear.errors import SphearError, quoted
from sphear.simulation.interpolation import interpolated
from sphear.simulation.observers.base import Observer

if TYPE_CHECKING:
    from sphear.simulation.run import Run

Array = np.ndarray[Any, Any]


@dataclass
class Probe(Observer):
    """The velocity at a point that stays where it is, by the parabola that fits the particles around it best.

    Args:
        point: (2,).
        every, steps, when: of the looks, see `Observer`.

    Attributes:
        rows: of every look, (time, velocity (2,)).

    Raises:
        SphearError: the point is none.

    Examples:
        >>> import sphear
        >>> observer = sphear.Probe((0.5, 0.9), steps=1)
        >>> cavity = sphear.Simulation(
        ...     sphear.Rectangle((0, 0), (1, 1)),
        ...     spacing=0.1,
        ...     fluid=sphear.Fluid(kinematic_viscosity=0.01),
        ...     boundaries={"upper": sphear.NoSlip(velocity=(1.0, 0.0))},
        ...     observers=[observer],
        ... )
        >>> cavity.run(until=0.1).steps
        2
        >>> time, velocity = observer.rows[-1]
        >>> round(time, 2), velocity.shape
        (0.13, (2,))
    """

    point: tuple[float, ...] = ()

    def __init__(
        self,
        point: Sequence[float],
        *,
        every: float | None = None,
        steps: int | None = None,
        when: Sequence[float] | None = None,
    ) -> None:
        self.point, self.every, self.steps, self.when, self.rows = numbers(point), every, steps, when, []
        super().__post_init__()
        if len(self.point) != 2:
            raise SphearError(f"a probe stands at a point of two numbers, not at {quoted(point)}")

    def look(self, run: Run) -> tuple[float, Array]:
        """The time, and the velocity there."""
        return run.flow.time, interpolated(run.flow, np.array([self.point]))[0]

    @property
    def times(self) -> Array:
        """The times of the looks, (looks,)."""
        return np.array([time for time, _ in self.rows])

    @property
    def velocities(self) -> Array:
        """The velocities at the point, (looks, 2), in lengths over times."""
        return np.array([velocity for _, velocity in self.rows]).reshape(-1, 2)
