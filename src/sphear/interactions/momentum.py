"""Pressure gradient and viscosity in one sweep: the right-hand side of the momentum equation."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from sphear.algebra import Scalar, Vector, add, scale
from sphear.corrections import Correction
from sphear.kernels import Kernel

if TYPE_CHECKING:
    from sphear.viscosity.base import ViscousTerm


@dataclass(frozen=True)
class Momentum:
    """du_i/dt = -sum_j m_j (p_i / rho_i^2 + p_j / rho_j^2) grad W_ij + viscous term.

    Basa, Quinlan & Lastiwka 2009, eq. 8, j = i included, where a corrected grad W_ii is not zero. The field
    `pressure_over_density2` is p / rho^2, held once a particle instead of divided once a pair.
    """

    term: ViscousTerm
    kernel: Kernel
    correction: Correction

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> Vector:
        """The pair's part of du_i/dt."""
        pressure = other.mass * (own.pressure_over_density2 + other.pressure_over_density2)
        gradient = self.correction.gradient(self.kernel, own.prepared, d, r2)
        viscous = self.term.acceleration(self.kernel, self.correction, own, other, d, r2)
        return add(viscous, scale(-pressure, gradient))

    def finish(self, own: Any, total: Vector) -> Vector:
        """The sum, with what the particle adds itself."""
        viscous = self.term.own_acceleration(self.kernel, self.correction, own)
        gradient = self.correction.gradient_at_zero(self.kernel, own.prepared, own.dimension)
        if viscous is not None:
            total = add(total, viscous)
        if gradient is not None:
            total = add(total, scale(-2.0 * own.mass * own.pressure_over_density2, gradient))
        return total
