"""Conditions at the sides and walls of a region: what happens there, not how it is computed."""

from sphear.boundaries.conditions.no_slip import NoSlip
from sphear.boundaries.conditions.periodic import Periodic

__all__ = ["Condition", "NoSlip", "Periodic"]

Condition = NoSlip | Periodic
