"""The momentum equation with the pressure reduced by its local mean."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from sphear.algebra import Scalar, Vector, add, scale, where_less
from sphear.corrections import Correction
from sphear.kernels import Kernel

if TYPE_CHECKING:
    from sphear.viscosity.base import ViscousTerm


@dataclass(frozen=True)
class ReducedMomentum:
    """du_i/dt = -sum_j m_j ((p_i - p_mean) / rho_i^2 + (p_j - p_mean) / rho_j^2) grad W_ij + viscous term.

    Basa, Quinlan & Lastiwka 2009, eq. 20, j = i included, where a corrected grad W_ii is not zero; p_mean is the mean
    of the neighbours' pressures. It is a constant of particle i, so that sum_j m_j (1 / rho_i^2 + 1 / rho_j^2)
    grad W_ij is summed beside the rest and subtracted in the end.

    Args:
        term: the viscous term; None leaves it out.
        kernel: with its smoothing length.
        correction: of the kernel gradient.
        reduced: else eq. 8, without p_mean.
    """

    term: ViscousTerm | None
    kernel: Kernel
    correction: Correction
    reduced: bool = True

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> Any:
        """The pair's part of the force, and of what the mean pressure multiplies."""
        gradient = scale(other.mass, self.correction.gradient(self.kernel, own.prepared, d, r2))
        pressure = own.pressure_over_density2 + other.pressure_over_density2
        force = scale(-pressure, gradient)
        if self.term is not None:
            force = add(force, self.term.acceleration(self.kernel, self.correction, own, other, d, r2))
        if not self.reduced:
            return (force,)
        weight = own.inverse_density2 + other.inverse_density2
        # counts the neighbours: lanes without one lie outside the support
        one = where_less(r2, self.kernel.radius**2, 1.0, 0.0)
        return force, scale(weight, gradient), one * other.pressure, one

    def finish(self, own: Any, total: Any) -> Vector:
        """The force with the mean pressure taken out, and what the viscous term adds by itself."""
        force = total[0]
        mean: Scalar = 0.0
        if self.reduced:
            _, gradient, pressure, count = total
            mean = pressure / count
            force = add(force, scale(mean, gradient))
        at_zero = self.correction.gradient_at_zero(self.kernel, own.prepared, own.dimension)
        if at_zero is not None:
            excess = own.pressure_over_density2
            if self.reduced:
                excess = excess - mean * own.inverse_density2
            force = add(force, scale(-2.0 * own.mass * excess, at_zero))
        itself = None if self.term is None else self.term.own_acceleration(self.kernel, self.correction, own)
        return force if itself is None else add(force, itself)
