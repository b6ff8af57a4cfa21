"""The viscous acceleration of a velocity field, by any viscous term."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from sphear.algebra import Scalar, Vector, add
from sphear.corrections import Correction
from sphear.interactions.rates import Part
from sphear.kernels import Kernel

if TYPE_CHECKING:
    from sphear.viscosity.base import ViscousTerm


@dataclass(frozen=True)
class ViscousAcceleration:
    """(1/rho) div tau, the sum of the term's pair accelerations."""

    term: ViscousTerm
    kernel: Kernel
    correction: Correction

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> Vector:
        """The term's acceleration of `own` by `other`."""
        return self.term.acceleration(self.kernel, self.correction, own, other, d, r2)

    def finish(self, own: Any, total: Vector) -> Vector:
        """The sum, with what the particle adds itself."""
        itself = self.term.own_acceleration(self.kernel, self.correction, own)
        return total if itself is None else add(total, itself)


@dataclass(frozen=True)
class ViscousForce(Part):
    """`ViscousAcceleration` as a part of the momentum equation."""

    term: ViscousTerm
    kernel: Kernel
    correction: Correction

    role = "velocity"

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> tuple[Vector, Any]:
        """The term's acceleration of `own` by `other`."""
        return self.term.acceleration(self.kernel, self.correction, own, other, d, r2), ()

    def finish(self, own: Any, sums: Any) -> Vector | None:
        """The particle's own part."""
        return self.term.own_acceleration(self.kernel, self.correction, own)
