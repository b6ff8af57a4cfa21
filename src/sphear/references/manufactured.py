"""A manufactured flow in a closed square: chosen first, and the force that drives it found from it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

Array = np.ndarray[Any, Any]


@dataclass(frozen=True)
class ClosedVortex:
    """A vortex in the unit square whose walls hold the fluid; its strength swings.

        u =  a sin^2(pi x) sin(2 pi y)      a = 1 + sin(2 pi t) / 2
        v = -a sin(2 pi x) sin^2(pi y)      p = a cos(pi x) cos(pi y) / 4

    It is free of divergence, zero on the walls, and a flow of density 1 under the force
    f = Du/Dt + grad p - nu lap u (method of manufactured solutions: Roache 1998, Verification and Validation in
    Computational Science and Engineering, chapter 3).

    Args:
        kinematic_viscosity: nu.
    """

    kinematic_viscosity: float

    def velocity(self, positions: ArrayLike, time: float) -> Array:
        """u at positions (N, 2), in sides a time."""
        (sx, _, s2x, _), (sy, _, s2y, _) = _waves(positions)
        return _strength(time) * np.stack((sx**2 * s2y, -s2x * sy**2), axis=1)

    def pressure(self, positions: ArrayLike, time: float) -> Array:
        """p (N,) at positions (N, 2); its mean over the square is zero."""
        (_, cx, _, _), (_, cy, _, _) = _waves(positions)
        return np.asarray(0.25 * _strength(time) * cx * cy)

    def force(self, positions: ArrayLike, time: float) -> Array:
        """f (N, 2) at positions (N, 2)."""
        (sx, cx, s2x, c2x), (sy, cy, s2y, c2y) = _waves(positions)
        a, rate = _strength(time), math.pi * math.cos(2.0 * math.pi * time)
        u, v = a * sx**2 * s2y, -a * s2x * sy**2
        pi = math.pi
        u_x, u_y, v_x = a * pi * s2x * s2y, a * 2.0 * pi * sx**2 * c2y, -a * 2.0 * pi * c2x * sy**2
        lap_u = a * (2.0 * pi**2 * c2x - 4.0 * pi**2 * sx**2) * s2y
        lap_v = a * (4.0 * pi**2 * sy**2 - 2.0 * pi**2 * c2y) * s2x
        along = rate / a * u + u * u_x + v * u_y - 0.25 * pi * a * sx * cy - self.kinematic_viscosity * lap_u
        across = rate / a * v + u * v_x - v * u_x - 0.25 * pi * a * cx * sy - self.kinematic_viscosity * lap_v
        return np.stack((along, across), axis=1)


def _strength(time: float) -> float:
    return 1.0 + 0.5 * math.sin(2.0 * math.pi * time)


def _waves(positions: ArrayLike) -> list[tuple[Array, Array, Array, Array]]:
    """sin and cos of pi x and of 2 pi x, and of y."""
    found = []
    for x in np.asarray(positions, np.float64).T:
        found.append((np.sin(math.pi * x), np.cos(math.pi * x), np.sin(2 * math.pi * x), np.cos(2 * math.pi * x)))
    return found
