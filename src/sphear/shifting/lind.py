"""Down the gradient of the particles' concentration (Lind et al. 2012)."""

from __future__ import annotations

from dataclasses import dataclass

from sphear.interactions import Part, Shifting
from sphear.kernels import Kernel
from sphear.shifting.base import ShiftingMethod, check_strength

STABLE = 0.25  # smoothing lengths a step and strength: half as much again makes particles clump


@dataclass(frozen=True)
class Lind(ShiftingMethod):
    """The drift w_i = -2 h U a sum_j V_j (1 + 0.2 (W_ij / W(dx))^4) grad W_ij, at most U / 2.

    Args:
        strength: a, 1 in the sources; half of it keeps particles as regular and costs half the energy.

    Raises:
        SphearError: the strength is not a positive number.

    Examples:
        >>> import sphear
        >>> print(sphear.Incompressible(shifting=sphear.Lind(strength=1.0)))
        Incompressible(shifting_strength=1.0)
    """

    strength: float = 0.5

    name = "lind"
    aliases = ("fick", "skillen")
    formula = "w_i = -2 h U a sum_j V_j (1 + 0.2 (W_ij / W(dx))^4) grad W_ij, |w_i| <= U / 2"
    source = "Lind, Xu, Stansby & Rogers 2012, J. Comput. Phys. 231:1499; Skillen et al. 2013, CMAME 265:163"

    def __post_init__(self) -> None:
        check_strength(self.strength)

    def drift(self, kernel: Kernel, speed: float, spacing: float) -> Part:
        """The drift, in length over time."""
        return Shifting(kernel, self.strength, speed, spacing)

    def stable_step(self, h: float, speed: float) -> float:
        """0.25 h / (a U): the concentration spreads explicitly."""
        return STABLE * h / (self.strength * speed)
