"""The continuity equation, and the density diffusion that smooths its pressure."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sphear.algebra import Scalar, Vector, dot, subtract
from sphear.corrections import Correction
from sphear.interactions.rates import Part
from sphear.kernels import Kernel


@dataclass(frozen=True)
class Continuity(Part):
    """d rho_i/dt = sum_j m_j (u_i - u_j) . grad W_ij (Basa, Quinlan & Lastiwka 2009, eq. 10).

    Args:
        kernel: with its smoothing length.
        correction: of the kernel gradient.
        prepared: the name under which the particle holds what the correction has prepared.
    """

    kernel: Kernel
    correction: Correction
    prepared: str = "prepared"

    role = "density"

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> tuple[Vector, Any]:
        """m_j (u_i - u_j) . grad W_ij."""
        gradient = self.correction.gradient(self.kernel, getattr(own, self.prepared, None), d, r2)
        return (other.mass * dot(subtract(own.velocity, other.velocity), gradient),), ()


@dataclass(frozen=True)
class DensityDiffusion(Part):
    """d rho_i/dt = delta h c0 sum_j 2 V_j (rho_i - rho_j) (r_ij . grad W_ij) / r_ij^2.

    Molteni & Colagrossi 2009, A simple procedure to improve the pressure evaluation in hydrodynamic context using the
    SPH, Comput. Phys. Comm. 180:861; what it takes from one particle of a pair it gives to the other.

    Args:
        kernel: with its smoothing length h.
        delta: the strength, 0.1 in the source.
        sound_speed: c0.
    """

    kernel: Kernel
    delta: float
    sound_speed: float

    role = "density"

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> tuple[Vector, Any]:
        """A Laplacian of the density, its weight that of Morris's term: negative, so that rho_i - rho_j spreads."""
        strength = 2.0 * self.delta * self.kernel.h * self.sound_speed
        factor = strength * other.volume * self.kernel.gradient_factor(r2, len(d))
        return (factor * (own.density - other.density),), ()
