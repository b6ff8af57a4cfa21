"""The energy equation of a compressible fluid."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sphear.algebra import Scalar, Vector, dot, subtract
from sphear.corrections import Correction
from sphear.interactions.pressure_force import Form
from sphear.interactions.rates import Part
from sphear.kernels import Kernel


@dataclass(frozen=True)
class InternalEnergy(Part):
    """de_i/dt = 1/2 sum_j m_j (p_i / rho_i^2 + p_j / rho_j^2) (u_i - u_j) . grad W_ij.

    Basa, Quinlan & Lastiwka 2009, eq. 14; with (p_i + p_j) / (rho_i rho_j) beside the other form of the pressure force.
    Viscous heating is left out, as there. With the pressure as it is the sum of kinetic and internal energy is
    conserved where nothing but pressure acts.

    Args:
        kernel: with its smoothing length.
        correction: of the kernel gradient.
        form: that of the pressure force.
        prepared: the name under which the particle holds what the correction has prepared.
    """

    kernel: Kernel
    correction: Correction
    form: Form
    prepared: str = "prepared"

    role = "energy"

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> tuple[Vector, Any]:
        """Half the work of the pair's pressure."""
        gradient = self.correction.gradient(self.kernel, getattr(own, self.prepared, None), d, r2)
        if self.form == "squares":
            stress = other.mass * (own.pressure_over_density2 + other.pressure_over_density2)
        else:
            stress = other.volume / own.density * (own.pressure + other.pressure)
        return (0.5 * stress * dot(subtract(own.velocity, other.velocity), gradient),), ()
