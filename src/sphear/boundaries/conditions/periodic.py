"""A flow that repeats."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Periodic:
    """The flow repeats along an axis, "x" or "y", with the extent of the region as its period.

    Examples:
        >>> import sphear
        >>> boundaries = {"x": sphear.Periodic(), "lower": sphear.FreeSlip(), "upper": sphear.FreeSlip()}
        >>> region, fluid = sphear.Rectangle((0, 0), (1, 1)), sphear.Fluid(kinematic_viscosity=0.01)
        >>> channel = sphear.Simulation(region, spacing=0.1, fluid=fluid, boundaries=boundaries, velocity=(1.0, 0.0))
        >>> print(channel.run(until=0.5).positions[:, 0].max() < 1.0)  # what leaves at the right enters at the left
        True
    """
