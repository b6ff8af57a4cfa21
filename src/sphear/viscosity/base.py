"""The base of all viscous terms: how they act on velocities and, where they can, on scalar fields."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

from sphear.algebra import Scalar, Vector, scale, subtract
from sphear.corrections import Correction, NoCorrection
from sphear.engine.formula import Interaction
from sphear.engine.preparation import Preparation
from sphear.errors import SphearError, quoted
from sphear.interactions import Laplacian, ViscousAcceleration
from sphear.kernels import Kernel
from sphear.positive import as_number


@dataclass(frozen=True, repr=False)
class ViscousTerm:
    """A published way to compute the viscous acceleration (1/rho) div tau from particles.

    Where the viscosity varies div tau is div(2 mu D) = div(mu grad u) + (grad u)^T grad mu of a flow that is free of
    divergence; `where_it_varies` says what of it the term has, `viscosity/varying.py` what one without a rule does.

    In its formulas a particle has the attributes `velocity`, `volume`, `density` and `dynamic_viscosity`, and `own`
    has, as `prepared`, what `preparation` has summed up for it.

    Examples:
        >>> import sphear
        >>> term = sphear.VISCOSITY["D"]
        >>> isinstance(term, sphear.ViscousTerm), term.name, term.radial
        (True, 'cleary', True)
        >>> print(term.where_it_varies)
        div(mu grad u) + (grad u)^T grad mu
    """

    name: ClassVar[str] = "unnamed"
    aliases: ClassVar[tuple[str, ...]] = ()
    formula: ClassVar[str] = "not stated"
    source: ClassVar[str] = "not stated"
    radial: ClassVar[bool] = False  # the pair force has a part along the line of centres: no Laplacian of a scalar
    own_correction: ClassVar[bool] = False  # carries a correction of its own and takes no other
    uses_second_derivatives: ClassVar[bool] = False
    varies_viscosity: ClassVar[bool] = False  # the formula has a rule for a viscosity that varies in space
    where_it_varies: ClassVar[str] = ""  # the limit of that rule, where the flow is free of divergence

    def __post_init__(self) -> None:
        eta = getattr(self, "eta", None)
        if eta is not None and not as_number(eta) >= 0:
            raise SphearError(f"eta of viscosity {self.name!r} must be zero or positive, not {quoted(eta)}")

    def __repr__(self) -> str:
        """The card of the term: its formula, its source and what was measured of it."""
        from sphear.viscosity.card import card

        return card(self).text()

    @property
    def homogeneous(self) -> bool:
        """True if the term is linear in velocity and in viscosity and has no constant with a unit: units cancel."""
        return True

    def preparation(self, kernel: Kernel, correction: Correction) -> Preparation | None:
        """The interaction that sums up what the term needs of a particle's neighbourhood; None if nothing."""
        return correction.preparation(kernel, self.uses_second_derivatives)

    def acceleration(
        self, kernel: Kernel, correction: Correction, own: Any, other: Any, d: Vector, r2: Scalar
    ) -> Vector:
        """The pair's part of du/dt of `own`."""
        raise NotImplementedError

    def own_acceleration(self, kernel: Kernel, correction: Correction, own: Any) -> Vector | None:
        """The particle's part of its own du/dt; None if nothing."""
        return None

    def acceleration_stages(self, kernel: Kernel, correction: Correction) -> tuple[Interaction, ...]:
        """The sweeps that give the viscous acceleration; each knows the result of the one before as `before`."""
        return (ViscousAcceleration(self, kernel, correction),)


@dataclass(frozen=True, repr=False)
class LaplacianTerm(ViscousTerm):
    """A viscous term that is the Laplacian of each component: lap f_i = sum_j V_j w_ij (f_j - f_i).

    Examples:
        >>> import sphear
        >>> isinstance(sphear.Morris(), sphear.LaplacianTerm), isinstance(sphear.Violeau(), sphear.LaplacianTerm)
        (True, False)
    """

    def weight(self, kernel: Kernel, correction: Correction, own: Any, d: Vector, r2: Scalar) -> Scalar:
        """The weight w_ij of lap f_i = sum_j V_j w_ij (f_j - f_i)."""
        raise NotImplementedError

    def of_differences(self, correction: Correction) -> bool:
        """True if the sum is over f_j - f_i; else over f_j, with the particle itself (`weight_at_zero`)."""
        return True

    def weight_at_zero(self, kernel: Kernel, correction: Correction, own: Any) -> Scalar:
        """The weight w_ii of the particle itself, for sums over f_j."""
        raise NotImplementedError

    def mean_viscosity(self, own: Any, other: Any) -> Scalar:
        """The viscosity between two particles: that of `own`, unless the term's source has another rule."""
        return own.dynamic_viscosity

    def laplacian_stages(self, kernel: Kernel, correction: Correction) -> tuple[Interaction, ...]:
        """The sweeps that give the Laplacian of the field `values`; each knows the one before as `before`."""
        return (Laplacian(self, kernel, correction),)

    def acceleration(
        self, kernel: Kernel, correction: Correction, own: Any, other: Any, d: Vector, r2: Scalar
    ) -> Vector:
        """(mu / rho_i) V_j w_ij (u_j - u_i)."""
        factor = other.volume * self.mean_viscosity(own, other) / own.density
        difference = subtract(other.velocity, own.velocity)
        return scale(factor * self.weight(kernel, correction, own, d, r2), difference)


def regularised(r2: Scalar, eta: float | None, kernel: Kernel) -> Scalar:
    """r^2 + eta^2, with eta given in smoothing lengths; r^2 where eta is None."""
    return r2 if eta is None else r2 + (eta * kernel.h) ** 2


def uncorrected(term: ViscousTerm) -> tuple[ViscousTerm, Correction]:
    """The stand-in for a term where its correction cannot be computed: itself without, or Morris's."""
    from sphear.viscosity.morris import Morris

    return (Morris() if term.own_correction else term), NoCorrection()
