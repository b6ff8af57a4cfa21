"""The Laplacian of each component of a field, by any viscous term that is one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from sphear.algebra import Scalar, Vector, add, scale, subtract
from sphear.corrections import Correction
from sphear.kernels import Kernel

if TYPE_CHECKING:
    from sphear.viscosity.base import LaplacianTerm


@dataclass(frozen=True)
class Laplacian:
    """lap f_i = sum_j V_j w_ij (f_j - f_i), or with f_j in place of the difference."""

    term: LaplacianTerm
    kernel: Kernel
    correction: Correction

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> Vector:
        """V_j w_ij (f_j - f_i)."""
        weight = other.volume * self.term.weight(self.kernel, self.correction, own, d, r2)
        if self.term.of_differences(self.correction):
            return scale(weight, subtract(other.values, own.values))
        return scale(weight, other.values)

    def finish(self, own: Any, total: Vector) -> Vector:
        """The sum, with V_i w_ii f_i where it is over values."""
        if self.term.of_differences(self.correction):
            return total
        weight = own.volume * self.term.weight_at_zero(self.kernel, self.correction, own)
        return add(total, scale(weight, own.values))
