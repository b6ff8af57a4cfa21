"""The stiff equation of state of weakly compressible flow."""

from __future__ import annotations

from dataclasses import dataclass

from sphear.algebra import Scalar, sqrt
from sphear.equations_of_state.base import Barotropic
from sphear.errors import SphearError


@dataclass(frozen=True)
class BatchelorTait(Barotropic):
    """The equation of state of water, p = rho0 c0^2 / gamma ((rho / rho0)^gamma - 1); its speed of sound may be chosen.

    Batchelor 1967; Monaghan 1994, J. Comput. Phys. 110:399; Basa, Quinlan & Lastiwka 2009, eq. 13.

    The power gamma is an integer and part of the traced code, because a trace has whole powers only. `density` takes a
    root: it is for NumPy and plain numbers, to set up a state, and not for traces.

    Args:
        rho0: the reference density, where the pressure is zero, in kg/m^3.
        c0: the speed of sound at the reference density, in m/s.
        gamma: the power of the density, an integer of at least 1; with 1 the equation is `Linear`.

    Raises:
        SphearError: rho0 or c0 is not a positive number, or gamma not such an integer.

    Examples:
        >>> import sphear
        >>> water = sphear.BatchelorTait(rho0=1000.0, c0=10.0)
        >>> pressure = water.pressure(1010.0)
        >>> round(pressure), round(water.density(pressure)), round(water.sound_speed(1010.0), 2)
        (1031, 1010, 10.3)
    """

    gamma: int = 7

    name = "batchelor_tait"
    aliases = ("tait", "batchelor", "cole", "weakly_compressible", "13")
    formula = "p = rho0 c0^2 / gamma ((rho / rho0)^gamma - 1)"
    source = (
        "Batchelor 1967, An introduction to fluid dynamics; Monaghan 1994, Simulating free surface flows with SPH,"
        " J. Comput. Phys. 110:399; Basa, Quinlan & Lastiwka 2009, eq. 13"
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if type(self.gamma) is not int or self.gamma < 1:
            raise SphearError(f"the power gamma must be an integer of at least 1, not {self.gamma}")

    def pressure(self, density: Scalar, energy: Scalar = None) -> Scalar:
        """rho0 c0^2 / gamma ((rho / rho0)^gamma - 1)."""
        return self.rho0 * self.c0**2 / self.gamma * ((density / self.rho0) ** self.gamma - 1.0)

    def sound_speed(self, density: Scalar, energy: Scalar = None) -> Scalar:
        """c0 (rho / rho0)^((gamma - 1) / 2)."""
        return self.c0 * sqrt((density / self.rho0) ** (self.gamma - 1))

    def density(self, pressure: Scalar, energy: Scalar = None) -> Scalar:
        """rho0 (1 + gamma p / (rho0 c0^2))^(1 / gamma), of NumPy arrays and plain numbers.

        Raises:
            SphearError: a pressure is below -rho0 c0^2 / gamma, that of zero density.
        """
        import numpy as np  # takes long: equations are listed without it

        power = 1.0 + self.gamma * pressure / (self.rho0 * self.c0**2)
        if np.any(np.less(power, 0.0)):
            least = -self.rho0 * self.c0**2 / self.gamma
            raise SphearError(f"the pressure must be at least -rho0 c0^2 / gamma = {least:g}, not {np.min(pressure):g}")
        return self.rho0 * power ** (1.0 / self.gamma)
