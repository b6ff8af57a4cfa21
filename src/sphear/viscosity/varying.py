"""A Laplacian of each component where the viscosity varies in space: the mean of two particles between them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sphear.algebra import Scalar, Vector
from sphear.corrections import Correction
from sphear.engine.preparation import Preparation
from sphear.errors import SphearError
from sphear.kernels import Kernel
from sphear.viscosity.base import LaplacianTerm, ViscousTerm


@dataclass(frozen=True, repr=False)
class MeanViscosity(LaplacianTerm):
    """div(mu grad u)_i = sum_j V_j w_ij (mu_i + mu_j) / 2 (u_j - u_i), with the weights of any Laplacian.

    With L f = sum_j V_j w_ij (f_j - f_i) the sum is (L(mu u) + mu L u - u L mu) / 2, and 1/2 (lap(mu u) + mu lap u -
    u lap mu) is div(mu grad u): it is as exact as the Laplacian is for the fields mu, u and mu u.

    Args:
        term: whose weights.
    """

    term: LaplacianTerm

    name = "mean_viscosity"
    varies_viscosity = True
    where_it_varies = "div(mu grad u)"

    def preparation(self, kernel: Kernel, correction: Correction) -> Preparation | None:
        """The preparation of the term."""
        return self.term.preparation(kernel, correction)

    def weight(self, kernel: Kernel, correction: Correction, own: Any, d: Vector, r2: Scalar) -> Scalar:
        """The weight of the term."""
        return self.term.weight(kernel, correction, own, d, r2)

    def mean_viscosity(self, own: Any, other: Any) -> Scalar:
        """(mu_i + mu_j) / 2."""
        return 0.5 * (own.dynamic_viscosity + other.dynamic_viscosity)


def takes_mean(term: ViscousTerm) -> bool:
    """True if a term without a rule for a viscosity that varies is the weights of a Laplacian, which give it one."""
    return (
        isinstance(term, LaplacianTerm)
        and type(term).acceleration is LaplacianTerm.acceleration
        and type(term).acceleration_stages is ViscousTerm.acceleration_stages
    )


def with_varying_viscosity(term: ViscousTerm) -> ViscousTerm:
    """The term where the viscosity varies: itself if it has a rule for that, else its weights with `MeanViscosity`.

    Raises:
        SphearError: the term is made for a constant viscosity.
    """
    if term.varies_viscosity:
        return term
    if isinstance(term, LaplacianTerm) and takes_mean(term):
        return MeanViscosity(term)
    raise SphearError(
        f"viscosity {term.name!r} is made for a viscosity that is constant, and dynamic_viscosity varies between"
        " particles: take another term, such as 'morris' or 'fatehi_manzari'"
    )
