"""The methods that all ways of shifting have."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from sphear.errors import SphearError, quoted
from sphear.interactions import Part
from sphear.kernels import Kernel
from sphear.positive import is_positive


@dataclass(frozen=True)
class ShiftingMethod:
    """A velocity, beside that of the fluid, with which particles are moved so that they stay evenly spread.

    A class of one's own defines `drift`, and `stable_step` where too long a step makes particles clump. Where it has a
    field `strength`, the setting `shifting_strength` is that.

    Examples:
        >>> import sphear
        >>> isinstance(sphear.Lind(), sphear.ShiftingMethod)
        True
        >>> print(sphear.Lind.formula)
        w_i = -2 h U a sum_j V_j (1 + 0.2 (W_ij / W(dx))^4) grad W_ij, |w_i| <= U / 2
    """

    name: ClassVar[str] = "unnamed"
    aliases: ClassVar[tuple[str, ...]] = ()
    formula: ClassVar[str] = "not stated"
    source: ClassVar[str] = "not stated"

    def drift(self, kernel: Kernel, speed: float, spacing: float) -> Part | None:
        """The sum over neighbours that gives the drift (d,) of a particle, a `Part` of the role "drift"; None is none.

        Args:
            kernel: with its smoothing length, in units of length.
            speed: the largest expected, in length over time.
            spacing: of the particles, in units of length.
        """
        raise NotImplementedError

    def stable_step(self, h: float, speed: float) -> float:
        """The longest time step that keeps particles regular; inf where any does.

        Args:
            h: the smoothing length, in units of length.
            speed: the largest expected, in length over time.
        """
        return math.inf


def check_strength(strength: object) -> None:
    """Refuse a strength that is no positive number.

    Raises:
        SphearError: it is none.
    """
    if not is_positive(strength):
        raise SphearError(f"the strength of shifting must be a positive number, not {quoted(strength)}")
