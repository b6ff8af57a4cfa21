"""Copies of all particles in memory."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from sphear.simulation.observers.base import Observer

if TYPE_CHECKING:
    from sphear.simulation.run import Run

Array = np.ndarray[Any, Any]


class Snapshot(NamedTuple):
    """All particles at one time.

    Attributes:
        time: of the flow.
        positions: places of the particles, (N, d), in lengths.
        velocities: (N, d), in lengths over times.
        density: (N,), in masses over volumes.
        pressure: at the particles, (N,), in forces over areas.
    """

    time: float
    positions: Array
    velocities: Array
    density: Array
    pressure: Array


@dataclass
class Snapshots(Observer):
    """Copies of all particles at every look, as `rows` of `Snapshot`.

    Args:
        every, steps, when: of the looks, see `Observer`.

    Examples:
        >>> import sphear
        >>> observer = sphear.Snapshots(steps=1)
        >>> cavity = sphear.Simulation(
        ...     sphear.Rectangle((0, 0), (1, 1)),
        ...     spacing=0.1,
        ...     fluid=sphear.Fluid(kinematic_viscosity=0.01),
        ...     boundaries={"upper": sphear.NoSlip(velocity=(1.0, 0.0))},
        ...     observers=[observer],
        ... )
        >>> cavity.run(until=0.1).steps
        2
        >>> len(observer.rows), observer.rows[-1].positions.shape
        (3, (100, 2))
    """

    def look(self, run: Run) -> Snapshot:
        """The particles as they are."""
        flow = run.flow
        return Snapshot(
            flow.time, flow.positions.copy(), flow.velocities.copy(), flow.density.copy(), flow.pressure.copy()
        )
