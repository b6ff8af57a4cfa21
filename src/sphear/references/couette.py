"""Plane Couette flow from rest."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import erfc

from sphear.references.checks import check_finite, check_positive, check_time

EARLY = 0.05  # nu t / L^2 up to which the sum over images has few terms; from there on the series has
FAR = 30.0  # where erfc is zero
ROUNDING = 1e-12  # of a position, in units of L


@dataclass(frozen=True)
class PlaneCouette:
    """Flow between a wall at rest, y = 0, and one at y = L that moves at the speed U from t = 0 on.

    It solves du/dt = nu d2u/dy2 with u(0, t) = 0, u(L, t) = U and u(y, 0) = 0 (Morris, Fox & Zhu 1997, Modeling low
    Reynolds number incompressible flows using SPH, J. Comput. Phys. 136:214). All units are those of SI, or any other
    consistent ones.

    Args:
        gap: L, the distance of the walls, in m.
        kinematic_viscosity: nu, in m^2/s.
        wall_velocity: U, in m/s; its sign is that of the flow.

    Raises:
        SphearError: the gap or the viscosity is not a positive number, or the wall's velocity not a finite one.
    """

    gap: float
    kinematic_viscosity: float
    wall_velocity: float

    def __post_init__(self) -> None:
        check_positive(gap=self.gap, kinematic_viscosity=self.kinematic_viscosity)
        check_finite(wall_velocity=self.wall_velocity)

    @property
    def reynolds(self) -> float:
        """Re = |U| L / nu."""
        return abs(self.wall_velocity) * self.gap / self.kinematic_viscosity

    def steady(self, y: ArrayLike) -> NDArray[np.float64]:
        """u(y, infinity) = U y / L in m/s, at distances y in m from the wall at rest; NaN beyond the walls."""
        return self.velocity(y, math.inf)

    def velocity(self, y: ArrayLike, time: float) -> NDArray[np.float64]:
        """The velocity u(y, t) in m/s.

            u / U = y/L + sum_n 2 (-1)^n / (n pi) sin(n pi y/L) exp(-n^2 pi^2 nu t / L^2),  n = 1, 2, ...

        summed until what is left out is below rounding. At early times that would take many terms that nearly cancel;
        there it is the same solution as a sum over images of the walls:

            u / U = sum_n erfc(((2n+1) L - y) / sqrt(4 nu t)) - erfc(((2n+1) L + y) / sqrt(4 nu t)),  n = 0, 1, ...

        At t = 0 it is zero, but for U on the moving wall.

        Args:
            y: distances from the wall at rest, in m, of any shape; a position within 1e-12 L of a wall is on it,
                beyond the walls the velocity is NaN.
            time: t, in s, from 0 to infinity.

        Raises:
            SphearError: the time is negative.
        """
        check_time(time)
        s = np.asarray(y, dtype=np.float64) / self.gap
        for wall in (0.0, 1.0):
            s = np.where(np.abs(s - wall) <= ROUNDING, wall, s)
        s = np.where((s < 0.0) | (s > 1.0), np.nan, s)
        diffusion = time * self.kinematic_viscosity / self.gap**2
        profile = _early(s, diffusion) if diffusion < EARLY else _series(s, diffusion)
        return np.asarray(self.wall_velocity * profile)


def _series(s: NDArray[np.float64], diffusion: float) -> NDArray[np.float64]:
    decay = math.pi**2 * diffusion
    total = s
    for n in range(1, 2 + math.ceil(math.sqrt(40.0 / decay))):  # exp(-40) is 4e-18
        total = total + 2.0 * (-1.0) ** n / (n * math.pi) * math.exp(-(n**2) * decay) * np.sin(n * math.pi * s)
    return total


def _early(s: NDArray[np.float64], diffusion: float) -> NDArray[np.float64]:
    if diffusion == 0.0:
        return np.where(s < 1.0, 0.0 * s, s)
    unit = 0.5 / math.sqrt(diffusion)
    total = np.zeros_like(s)
    for k in range(1, 3 + math.ceil(6.0 / unit), 2):  # erfc(6) is 2e-17
        total = total + (erfc(np.minimum((k - s) * unit, FAR)) - erfc(np.minimum((k + s) * unit, FAR)))
    return total
