"""No shifting: particles move with the fluid alone."""

from __future__ import annotations

from dataclasses import dataclass

from sphear.interactions import Part
from sphear.kernels import Kernel
from sphear.shifting.base import ShiftingMethod


@dataclass(frozen=True)
class NoShifting(ShiftingMethod):
    """Particles move with the fluid alone.

    Examples:
        >>> import sphear
        >>> print(sphear.Incompressible(shifting=sphear.NoShifting()))
        Incompressible(shifting='none')
    """

    name = "none"
    aliases = ("no_shifting",)
    formula = "w_i = 0"
    source = "Monaghan 2005, Rep. Prog. Phys. 68:1703"

    def drift(self, kernel: Kernel, speed: float, spacing: float) -> Part | None:
        """None."""
        return None
