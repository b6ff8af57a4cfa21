"""The base of all equations of state: pressure and speed of sound from the density, and the way back."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from sphear.algebra import Scalar
from sphear.errors import SphearError, quoted
from sphear.positive import is_positive


@dataclass(frozen=True)
class EquationOfState:
    """The pressure p of a fluid of density rho, and of specific internal energy e where `uses_energy` says so.

    Densities are in kg/m^3, pressures in Pa, energies in J/kg and speeds in m/s, or in any other consistent units.

    Examples:
        >>> import sphear
        >>> air = sphear.IdealGas(gamma=1.4)
        >>> isinstance(air, sphear.EquationOfState), air.uses_energy
        (True, True)
        >>> round(air.pressure(1.2, 2.1e5)), round(air.sound_speed(1.2, 2.1e5), 1)
        (100800, 342.9)
    """

    name: ClassVar[str] = "unnamed"
    aliases: ClassVar[tuple[str, ...]] = ()
    formula: ClassVar[str] = "not stated"
    source: ClassVar[str] = "not stated"
    uses_energy: ClassVar[bool] = False  # else the pressure is a function of the density alone

    def pressure(self, density: Scalar, energy: Scalar = None) -> Scalar:
        """The pressure p."""
        raise NotImplementedError

    def sound_speed(self, density: Scalar, energy: Scalar = None) -> Scalar:
        """The speed of sound c, with c^2 = dp/drho at constant entropy."""
        raise NotImplementedError

    def density(self, pressure: Scalar, energy: Scalar = None) -> Scalar:
        """The rho that has this pressure."""
        raise NotImplementedError


@dataclass(frozen=True)
class Barotropic(EquationOfState):
    """A pressure that the density alone decides, zero at the reference density; an energy is ignored.

    Args:
        rho0: the reference density, where the pressure is zero, in kg/m^3.
        c0: the speed of sound at the reference density, in m/s.

    Raises:
        SphearError: rho0 or c0 is not a positive number.

    Examples:
        >>> import sphear
        >>> class Quadratic(sphear.Barotropic):
        ...     def pressure(self, density, energy=None):
        ...         return self.c0**2 * (density**2 - self.rho0**2) / (2 * self.rho0)
        ...
        ...     def sound_speed(self, density, energy=None):
        ...         return self.c0 * (density / self.rho0) ** 0.5
        ...
        >>> Quadratic(rho0=1000.0, c0=10.0).pressure(1010.0)
        1005.0
    """

    rho0: float
    c0: float

    def __post_init__(self) -> None:
        for what, value in (("reference density rho0", self.rho0), ("speed of sound c0", self.c0)):
            if not is_positive(value):
                raise SphearError(f"the {what} must be positive, not {quoted(value)}")
