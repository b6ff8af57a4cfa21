"""The continuity equation, and the density diffusion that smooths its pressure."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sphear.algebra import Scalar, Vector, add, dot, scale, subtract
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
        velocity: the name of u: "velocity", or "slip_velocity", whose component along a wall is the same on both sides.
    """

    kernel: Kernel
    correction: Correction
    prepared: str = "prepared"
    velocity: str = "velocity"

    role = "density"

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> tuple[Vector, Any]:
        """m_j (u_i - u_j) . grad W_ij."""
        gradient = self.correction.gradient(self.kernel, getattr(own, self.prepared, None), d, r2)
        difference = subtract(getattr(own, self.velocity), getattr(other, self.velocity))
        return (other.mass * dot(difference, gradient),), ()


@dataclass(frozen=True)
class DensityDiffusion(Part):
    """d rho_i/dt = delta h c0 sum_j 2 V_j psi_ij (r_ij . grad W_ij) / r_ij^2, with psi_ij = rho_i - rho_j.

    Molteni & Colagrossi 2009, A simple procedure to improve the pressure evaluation in hydrodynamic context using the
    SPH, Comput. Phys. Comm. 180:861; what it takes from one particle of a pair it gives to the other. With gradients it
    leaves linear densities alone, and smooth ones nearly: psi_ij = rho_i - rho_j - 1/2 (grad rho_i + grad rho_j) .
    r_ij, Antuono, Colagrossi, Marrone & Molteni 2010, Comput. Phys. Comm. 181:532.

    Args:
        kernel: with its smoothing length h.
        delta: the strength, 0.1 in the sources.
        sound_speed: c0.
        gradients: subtract what the densities' gradients explain.
    """

    kernel: Kernel
    delta: float
    sound_speed: float
    gradients: bool = False

    role = "density"

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> tuple[Vector, Any]:
        """A Laplacian of the density, its weight that of Morris's term: negative, so that rho_i - rho_j spreads."""
        strength = 2.0 * self.delta * self.kernel.h * self.sound_speed
        factor = strength * other.volume * self.kernel.gradient_factor(r2, len(d))
        difference = own.density - other.density
        if self.gradients:
            difference = difference - 0.5 * dot(add(own.density_gradient, other.density_gradient), d)
        return (factor * difference,), ()


@dataclass(frozen=True)
class DensityGradient(Part):
    """sum_j V_j (rho_j - rho_i) grad W_ij: what `DensityDiffusion` knows of the step before.

    Args:
        kernel: with its smoothing length.
        correction: of the kernel gradient.
        prepared: the name under which the particle holds what the correction has prepared.
    """

    kernel: Kernel
    correction: Correction
    prepared: str = "prepared"

    role = "density_gradient"

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> tuple[Vector, Any]:
        """V_j (rho_j - rho_i) grad W_ij."""
        gradient = self.correction.gradient(self.kernel, getattr(own, self.prepared, None), d, r2)
        return scale(other.volume * (other.density - own.density), gradient), ()
