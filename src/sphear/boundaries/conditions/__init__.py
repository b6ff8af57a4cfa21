"""Conditions at the sides and walls of a region: what happens there, not how it is computed."""

from sphear.boundaries.conditions.free_slip import FreeSlip
from sphear.boundaries.conditions.no_slip import NoSlip
from sphear.boundaries.conditions.periodic import Periodic

__all__ = ["Condition", "FreeSlip", "NoSlip", "Periodic", "WallCondition"]

WallCondition = NoSlip | FreeSlip
Condition = WallCondition | Periodic
