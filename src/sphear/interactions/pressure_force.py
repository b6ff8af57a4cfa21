"""The pressure gradient of the momentum equation, with the pressure reduced by its local mean if wanted."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

from sphear.algebra import Scalar, Vector, add, scale, where_less
from sphear.corrections import Correction
from sphear.interactions.rates import Part
from sphear.kernels import Kernel

Form = Literal["squares", "products"]


@dataclass(frozen=True)
class PressureForce(Part):
    """du_i/dt = -sum_j m_j (p_i / rho_i^2 + p_j / rho_j^2) grad W_ij, or with (p_i + p_j) / (rho_i rho_j).

    Basa, Quinlan & Lastiwka 2009, eqs. 8 and 9, j = i included, where a corrected grad W_ii is not zero. With the mean
    of the neighbours' pressures subtracted from p_i and p_j it is eq. 20: the mean is a constant of particle i, so that
    what it multiplies is summed beside the rest and subtracted in the end.

    Args:
        kernel: with its smoothing length.
        correction: of the kernel gradient.
        form: "squares" (eq. 8, with summation density) or "products" (eq. 9, with the continuity equation).
        reduced: subtract the neighbours' mean pressure.
        subtracted: a pressure, the same everywhere, that is subtracted from all; None subtracts nothing.
        prepared: the name under which the particle holds what the correction has prepared.
    """

    kernel: Kernel
    correction: Correction
    form: Form
    reduced: bool = True
    subtracted: float | None = None
    prepared: str = "prepared"

    role = "velocity"

    def _terms(self, own: Any, other: Any) -> tuple[Scalar, Scalar, Scalar]:
        """m_j or V_j / rho_i, the pressures' sum and the factor of a constant pressure, 0 where there is none."""
        constant: Scalar = 0.0
        if self.form == "squares":
            weight, pressure = other.mass, own.pressure_over_density2 + other.pressure_over_density2
            if self.reduced or self.subtracted is not None:  # else nobody need hold 1 / rho^2
                constant = own.inverse_density2 + other.inverse_density2
        else:
            weight, pressure, constant = other.volume / own.density, own.pressure + other.pressure, 2.0
        if self.subtracted is not None:
            pressure = pressure - self.subtracted * constant
        return weight, pressure, constant

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> tuple[Vector, Any]:
        """The pair's part of the force, and of what the mean pressure multiplies."""
        weight, pressure, constant = self._terms(own, other)
        gradient = scale(weight, self.correction.gradient(self.kernel, getattr(own, self.prepared, None), d, r2))
        force = scale(-pressure, gradient)
        if not self.reduced:
            return force, ()
        # counts the neighbours: lanes without one lie outside the support
        one = where_less(r2, self.kernel.radius**2, 1.0, 0.0)
        return force, (scale(constant, gradient), one * other.pressure, one)

    def finish(self, own: Any, sums: Any) -> Vector | None:
        """The mean pressure taken out, and j = i."""
        result: Vector | None = None
        mean: Scalar = 0.0
        if self.reduced:
            gradient, pressure, count = sums
            # a constant that is subtracted everywhere is part of the mean
            mean = pressure / count - (0.0 if self.subtracted is None else self.subtracted)
            result = scale(mean, gradient)
        at_zero = self.correction.gradient_at_zero(self.kernel, getattr(own, self.prepared, None), own.dimension)
        if at_zero is not None:
            weight, own_pressure, constant = self._terms(own, own)
            part = scale(-weight * (own_pressure - mean * constant), at_zero)
            result = part if result is None else add(result, part)
        return result
