"""The weights of a Laplacian, pair by pair: what a row of the pressure equation is made of."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from sphear.algebra import Scalar, Vector
from sphear.corrections import Correction
from sphear.engine.formula import Weights
from sphear.kernels import Kernel

if TYPE_CHECKING:
    from sphear.viscosity.base import LaplacianTerm


@dataclass(frozen=True)
class LaplacianWeights(Weights):
    """V_j w_ij of lap f_i = sum_j V_j w_ij (f_j - f_i), by any viscous term that is a Laplacian of each component.

    With `morris` it is eq. 14 of Zheng, Ma & Shao (2018) for constant density.
    """

    term: LaplacianTerm
    kernel: Kernel
    correction: Correction

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> Vector:
        """V_j w_ij."""
        return (other.volume * self.term.weight(self.kernel, self.correction, own, d, r2),)
