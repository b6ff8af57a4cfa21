"""Keeping particles regular: velocities, beside that of the fluid, with which particles are moved."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sphear.algebra import Scalar, Vector, add, dot, outer, scale, sqrt, subtract, where_less
from sphear.corrections import Correction
from sphear.interactions.rates import Part
from sphear.kernels import Kernel

TENSILE = 0.2  # strength of the term that keeps pairs from sticking together (Monaghan 2000)


@dataclass(frozen=True)
class Shifting(Part):
    """The drift w_i = -2 h U a sum_j V_j (1 + 0.2 (W_ij / W(dx))^4) grad W_ij, at most U / 2.

    It moves particles down their concentration.
    Lind, Xu, Stansby & Rogers 2012, J. Comput. Phys. 231:1499, with the speed of Skillen et al. 2013, CMAME 265:163,
    as a velocity (Sun et al. 2017), so that it does not depend on the time step.

    Args:
        kernel: with its smoothing length h.
        strength: a, 1 in the sources.
        speed: U, the largest expected.
        spacing: dx.
    """

    kernel: Kernel
    strength: float
    speed: float
    spacing: float

    role = "drift"

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> tuple[Vector, Any]:
        """The pair's part of the gradient of the concentration."""
        ratio = self.kernel.value(r2, len(d)) / self.kernel.value(self.spacing * self.spacing, len(d))
        weight = other.volume * (1.0 + TENSILE * ratio**4)
        zero = tuple(0.0 for _ in d)
        return zero, scale(weight, self.kernel.gradient(d, r2))

    def finish(self, own: Any, sums: Any) -> Vector:
        """The drift, limited."""
        return self.drift(sums)

    def drift(self, gradient: Vector) -> Vector:
        """From the gradient of the concentration."""
        wanted = scale(-2.0 * self.kernel.h * self.speed * self.strength, gradient)
        size = sqrt(dot(wanted, wanted))
        most = 0.5 * self.speed
        return scale(where_less(most, size, most / where_less(most, size, size, 1.0), 1.0), wanted)


@dataclass(frozen=True)
class Advection(Part):
    """The change of the fluid's velocity by moving with the drift w: (w_i . grad) u_i, of differences u_j - u_i.

    A particle that is put elsewhere takes the velocity that the fluid has there, to first order. Constant velocities
    stay, momentum as a whole does not quite.

    Args:
        shifting: gives the drift.
        kernel: with its smoothing length.
        correction: of the kernel gradient.
        prepared: the name under which the particle holds what the correction has prepared.
    """

    shifting: Shifting
    kernel: Kernel
    correction: Correction
    prepared: str = "prepared"

    role = "velocity"

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> tuple[Vector, Any]:
        """The pair's part of the drift and of the velocity's gradient."""
        _, concentration = self.shifting.pair(own, other, d, r2)
        gradient = scale(other.volume, self.correction.gradient(self.kernel, getattr(own, self.prepared, None), d, r2))
        return tuple(0.0 for _ in d), (concentration, outer(subtract(other.velocity, own.velocity), gradient))

    def finish(self, own: Any, sums: Any) -> Vector:
        """(w . grad) u."""
        concentration, gradients = sums
        drift = self.shifting.drift(concentration)
        return tuple(dot(drift, gradient) for gradient in gradients)


@dataclass(frozen=True)
class DensityAdvection(Part):
    """The change of the density by moving with the drift w: w_i . grad rho_i, of differences rho_j - rho_i."""

    shifting: Shifting
    kernel: Kernel
    correction: Correction
    prepared: str = "prepared"

    role = "density"

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> tuple[Vector, Any]:
        """The pair's part of the drift and of the density's gradient."""
        _, concentration = self.shifting.pair(own, other, d, r2)
        gradient = scale(other.volume, self.correction.gradient(self.kernel, getattr(own, self.prepared, None), d, r2))
        return (0.0,), (concentration, scale(other.density - own.density, gradient))

    def finish(self, own: Any, sums: Any) -> Vector:
        """w . grad rho."""
        concentration, gradient = sums
        return (dot(self.shifting.drift(concentration), gradient),)


@dataclass(frozen=True)
class TransportVelocity(Part):
    """The drift w_i = -(dt/2) p_b / m_i sum_j (V_i^2 + V_j^2) grad W_ij of a background pressure p_b.

    Adami, Hu & Adams 2013, A transport-velocity formulation for SPH, J. Comput. Phys. 241:292, eqs. 13 to 15. Constant
    pressure moves particles towards regular places and leaves the fluid alone.

    Args:
        kernel: with its smoothing length.
        impulse: p_b dt / 2.
    """

    kernel: Kernel
    impulse: float

    role = "drift"

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> tuple[Vector, Any]:
        """The pair's part of the drift."""
        volumes = own.volume * own.volume + other.volume * other.volume
        return scale(-self.impulse / own.mass * volumes, self.kernel.gradient(d, r2)), ()


@dataclass(frozen=True)
class TransportStress(Part):
    """1/m_i sum_j (V_i^2 + V_j^2) (A_i + A_j) / 2 . grad W_ij with A = rho u (x) w: what the drift carries along.

    Adami, Hu & Adams 2013, eq. 8, for w the drift of the step before; equal and opposite for the two of a pair.
    """

    kernel: Kernel

    role = "velocity"

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> tuple[Vector, Any]:
        """The pair's part."""
        gradient = self.kernel.gradient(d, r2)
        volumes = own.volume * own.volume + other.volume * other.volume
        of_own = scale(own.density * dot(own.drift, gradient), own.velocity)
        of_other = scale(other.density * dot(other.drift, gradient), other.velocity)
        return scale(0.5 / own.mass * volumes, add(of_own, of_other)), ()
