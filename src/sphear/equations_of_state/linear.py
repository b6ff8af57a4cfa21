"""The linear equation of state."""

from __future__ import annotations

from dataclasses import dataclass

from sphear.algebra import Scalar
from sphear.equations_of_state.base import Barotropic


@dataclass(frozen=True)
class Linear(Barotropic):
    """The tangent of `BatchelorTait` at the reference density, p = c0^2 (rho - rho0): one speed of sound.

    Morris, Fox & Zhu 1997, J. Comput. Phys. 136:214.

    Args:
        rho0: the reference density, where the pressure is zero, in kg/m^3.
        c0: the speed of sound, in m/s.

    Raises:
        SphearError: rho0 or c0 is not a positive number.

    Examples:
        >>> import sphear
        >>> equation = sphear.Linear(rho0=1000.0, c0=10.0)
        >>> equation.pressure(1010.0), equation.sound_speed(1010.0)
        (1000.0, 10.0)
    """

    name = "linear"
    aliases = ("linearised", "linearized", "acoustic")
    formula = "p = c0^2 (rho - rho0)"
    source = (
        "Morris, Fox & Zhu 1997, Modeling low Reynolds number incompressible flows using SPH, J. Comput. Phys. 136:214,"
        " where p = c0^2 rho, with the pressure counted from that of rho0"
    )

    def pressure(self, density: Scalar, energy: Scalar = None) -> Scalar:
        """c0^2 (rho - rho0)."""
        return self.c0**2 * (density - self.rho0)

    def sound_speed(self, density: Scalar, energy: Scalar = None) -> Scalar:
        """c0, one number for all densities."""
        return self.c0

    def density(self, pressure: Scalar, energy: Scalar = None) -> Scalar:
        """rho0 + p / c0^2."""
        return self.rho0 + pressure / self.c0**2
