"""The Taylor-Green vortices of two dimensions."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from sphear.errors import SphearError
from sphear.references.checks import check_positive


@dataclass(frozen=True)
class TaylorGreen:
    """Four vortices that decay in a periodic box of side L, without changing their form.

    An exact solution of the incompressible Navier-Stokes equations (Taylor & Green 1937, Mechanism of the production of
    small eddies from large ones, Proc. R. Soc. A 158:499). With k = 2 pi / L and the decay D = exp(-2 nu k^2 t):

        u = -U cos(kx) sin(ky) D,  v = U sin(kx) cos(ky) D,  p = -rho U^2 / 4 (cos(2kx) + cos(2ky)) D^2

    All units are those of SI, or any other consistent ones.

    Args:
        kinematic_viscosity: nu, in m^2/s.
        side: L, the period in x and y, in m.
        speed: U, the largest velocity at t = 0, in m/s.
        density: rho, in kg/m^3.

    Raises:
        SphearError: a parameter is not a positive number.
    """

    kinematic_viscosity: float
    side: float = 1.0
    speed: float = 1.0
    density: float = 1.0

    def __post_init__(self) -> None:
        check_positive(**vars(self))

    @property
    def reynolds(self) -> float:
        """Re = U L / nu."""
        return self.speed * self.side / self.kinematic_viscosity

    def decay(self, time: float) -> float:
        """D = exp(-8 pi^2 nu t / L^2), what is left of the velocities at the time t in s."""
        return math.exp(-8.0 * math.pi**2 * self.kinematic_viscosity * time / self.side**2)

    def velocity(self, positions: ArrayLike, time: float) -> NDArray[np.float64]:
        """The velocities (u, v) in m/s.

        Args:
            positions: (x, y) in m, shape (..., 2), anywhere in the plane.
            time: t in s.

        Returns:
            An array of the shape of `positions`.
        """
        x, y = self._phases(positions)
        size = self.speed * self.decay(time)
        return np.stack([-size * np.cos(x) * np.sin(y), size * np.sin(x) * np.cos(y)], axis=-1)

    def pressure(self, positions: ArrayLike, time: float) -> NDArray[np.float64]:
        """The pressure p in Pa, whose mean is zero, at positions and a time as for `velocity`; shape (...)."""
        x, y = self._phases(positions)
        size = 0.25 * self.density * (self.speed * self.decay(time)) ** 2
        return np.asarray(-size * (np.cos(2.0 * x) + np.cos(2.0 * y)))

    def kinetic_energy(self, time: float) -> float:
        """E = rho U^2 L^2 / 4 exp(-16 pi^2 nu t / L^2), that of one box and a unit of depth, in J/m."""
        return 0.25 * self.density * (self.speed * self.side * self.decay(time)) ** 2

    def _phases(self, positions: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        places = np.asarray(positions, dtype=np.float64)
        if places.ndim == 0 or places.shape[-1] != 2:
            raise SphearError(f"positions must have two components, shape (..., 2), not {places.shape}")
        phases = 2.0 * math.pi / self.side * places
        return phases[..., 0], phases[..., 1]
