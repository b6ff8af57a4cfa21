"""The fluid of a simulation."""

from __future__ import annotations

from dataclasses import dataclass

from sphear.checked import number
from sphear.errors import SphearError, quoted


@dataclass(frozen=True, kw_only=True)
class Fluid:
    """A Newtonian fluid of constant viscosity: stress tau = mu (grad u + grad u^T), mu = rho nu.

    Give the kinematic or the dynamic viscosity; the other follows. Units are any that belong together.

    Args:
        density: rho, at rest, in mass over volume.
        kinematic_viscosity: nu, in length squared over time.
        dynamic_viscosity: mu, in mass over length and time.

    Raises:
        SphearError: density is not positive, viscosity negative, or not one of the two viscosities is given.

    Examples:
        >>> import sphear
        >>> sphear.Fluid(density=1000.0, dynamic_viscosity=1e-3)
        Fluid(density=1000, kinematic_viscosity=1e-06)
    """

    density: float = 1.0
    kinematic_viscosity: float | None = None
    dynamic_viscosity: float | None = None

    def __post_init__(self) -> None:
        density = number(self.density)
        if not density > 0:
            raise SphearError(f"the density of a fluid is a positive number, not {quoted(self.density)}")
        if (self.kinematic_viscosity is None) == (self.dynamic_viscosity is None):
            raise SphearError("a fluid has a kinematic_viscosity or a dynamic_viscosity: give one of them")
        name = "kinematic_viscosity" if self.dynamic_viscosity is None else "dynamic_viscosity"
        given = number(getattr(self, name))
        if not given >= 0:
            raise SphearError(
                f"the {name.replace('_', ' ')} of a fluid is a number that is not negative, not"
                f" {quoted(getattr(self, name))}"
            )
        kinematic = given if self.dynamic_viscosity is None else given / density
        object.__setattr__(self, "density", density)
        object.__setattr__(self, "kinematic_viscosity", kinematic)
        object.__setattr__(self, "dynamic_viscosity", kinematic * density)

    @property
    def nu(self) -> float:
        """The kinematic viscosity, in length squared over time."""
        assert self.kinematic_viscosity is not None
        return self.kinematic_viscosity

    def __repr__(self) -> str:
        """The fluid as it is written."""
        return f"Fluid(density={self.density:g}, kinematic_viscosity={self.kinematic_viscosity:g})"
