"""The ideal gas."""

from __future__ import annotations

from dataclasses import dataclass

from sphear.algebra import Scalar, sqrt
from sphear.equations_of_state.base import EquationOfState
from sphear.errors import SphearError, quoted
from sphear.positive import as_number


@dataclass(frozen=True)
class IdealGas(EquationOfState):
    """An ideal gas of constant heat capacities: p = rho R T with R T = (gamma - 1) e.

    Basa, Quinlan & Lastiwka 2009, eq. 12, with the energy of eq. 14.

    Args:
        gamma: the ratio of the heat capacities, more than 1; 1.4 is that of air.

    Raises:
        SphearError: gamma is not a finite number above 1; or, from each method, no energy is given.

    Examples:
        >>> import sphear
        >>> air = sphear.IdealGas(gamma=1.4)
        >>> round(air.pressure(1.2, energy=2.1e5)), round(air.sound_speed(1.2, energy=2.1e5), 1)
        (100800, 342.9)
    """

    gamma: float = 1.4

    name = "ideal_gas"
    aliases = ("perfect_gas", "gas", "compressible", "12")
    formula = "p = rho R T = (gamma - 1) rho e"
    source = "Basa, Quinlan & Lastiwka 2009, eq. 12, with the energy of eq. 14"
    uses_energy = True

    def __post_init__(self) -> None:
        if not as_number(self.gamma) > 1:
            raise SphearError(f"the ratio of heat capacities gamma must be a number above 1, not {quoted(self.gamma)}")

    def pressure(self, density: Scalar, energy: Scalar = None) -> Scalar:
        """(gamma - 1) rho e."""
        return (self.gamma - 1.0) * density * _given(energy)

    def sound_speed(self, density: Scalar, energy: Scalar = None) -> Scalar:
        """sqrt(gamma p / rho) = sqrt(gamma (gamma - 1) e)."""
        return sqrt(self.gamma * (self.gamma - 1.0) * _given(energy))

    def density(self, pressure: Scalar, energy: Scalar = None) -> Scalar:
        """p / ((gamma - 1) e)."""
        return pressure / ((self.gamma - 1.0) * _given(energy))

    def energy(self, density: Scalar, pressure: Scalar) -> Scalar:
        """p / ((gamma - 1) rho), the e of an initial state."""
        return pressure / ((self.gamma - 1.0) * density)


def _given(energy: Scalar) -> Scalar:
    if energy is None:
        raise SphearError("an ideal gas has no pressure, density or speed of sound without its specific energy")
    return energy
