"""Fluid that slips along a wall."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class FreeSlip:
    """Fluid slips along the wall and does not pass it: u . n = 0, and no shear stress, t . tau . n = 0.

    So is a plane of symmetry. The wall may be of any shape, and stays where it is.

    Examples:
        >>> import sphear
        >>> boundaries = {"x": sphear.Periodic(), "lower": sphear.FreeSlip(), "upper": sphear.FreeSlip()}
        >>> region, fluid = sphear.Rectangle((0, 0), (1, 1)), sphear.Fluid(kinematic_viscosity=0.01)
        >>> channel = sphear.Simulation(region, spacing=0.1, fluid=fluid, boundaries=boundaries, velocity=(1.0, 0.0))
        >>> print(channel.run(until=0.5).velocities[:, 0].min().round(2))  # walls do not slow it down
        1.0
    """
