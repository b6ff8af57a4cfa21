"""Numbers of the whole flow against time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from sphear.simulation.observers.base import Observer
from sphear.simulation.whole_flow import greatest_speed, kinetic_energy

if TYPE_CHECKING:
    from sphear.simulation.run import Run

Array = np.ndarray[Any, Any]


@dataclass
class History(Observer):
    """Time, steps, kinetic energy, greatest speed and what the scheme says of itself, at every look.

    Args:
        every, steps, when: of the looks, see `Observer`.

    Examples:
        >>> import sphear
        >>> observer = sphear.History(steps=1)
        >>> cavity = sphear.Simulation(
        ...     sphear.Rectangle((0, 0), (1, 1)),
        ...     spacing=0.1,
        ...     fluid=sphear.Fluid(kinematic_viscosity=0.01),
        ...     boundaries={"upper": sphear.NoSlip(velocity=(1.0, 0.0))},
        ...     observers=[observer],
        ... )
        >>> history = cavity.run(until=0.1).history
        >>> history["steps"], history["kinetic_energy"].shape
        (array([0., 1., 2.]), (3,))
    """

    def look(self, run: Run) -> dict[str, float]:
        """A row of numbers by name."""
        flow = run.flow
        return {
            "time": flow.time,
            "steps": flow.steps,
            "kinetic_energy": kinetic_energy(flow),
            "greatest_speed": greatest_speed(flow),
            **(flow.metrics() if flow.steps else {}),
        }

    @property
    def table(self) -> dict[str, Array]:
        """The numbers of all looks by name, (looks,) each; NaN where a look has none."""
        names = dict.fromkeys(name for row in self.rows for name in row)
        return {name: np.array([row.get(name, np.nan) for row in self.rows], np.float64) for name in names}
