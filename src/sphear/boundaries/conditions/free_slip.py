"""Fluid that slips along a wall."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class FreeSlip:
    """Fluid slips along the wall and does not pass it: u . n = 0, and no shear stress, t . tau . n = 0.

    So is a plane of symmetry. The wall may be of any shape, and stays where it is.

    Example:
        >>> import sphear
        >>> boundaries = {"x": sphear.Periodic(), "upper": sphear.FreeSlip()}
    """
