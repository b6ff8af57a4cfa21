"""Plane Poiseuille flow from rest: Basa, Quinlan & Lastiwka 2009, section 6.1."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import erf, erfc

from sphear.errors import SphearError
from sphear.references.checks import check_finite, check_positive, check_time

EARLY = 0.05  # nu t / d^2 up to which the sum over images has few terms; from there on the series has
FAR = 30.0  # where erfc and exp(-x^2) are zero
ROUNDING = 1e-12  # of a position, in units of d


@dataclass(frozen=True)
class PlanePoiseuille:
    """Flow between two walls at rest, y = -d and y = d, that a uniform body force drives from rest.

    It solves dU/dt = f + nu d2U/dy2 with U(-d, t) = U(d, t) = 0 and U(y, 0) = 0. All units are those of SI, or any
    other consistent ones.

    Args:
        half_width: d, half of the channel's width, in m.
        kinematic_viscosity: nu = mu / rho, in m^2/s.
        body_force: f, the force on a unit of mass, in m/s^2; its sign is that of the flow.

    Raises:
        SphearError: the half width or the viscosity is not a positive number, or the body force not a finite one.
    """

    half_width: float
    kinematic_viscosity: float
    body_force: float

    def __post_init__(self) -> None:
        check_positive(half_width=self.half_width, kinematic_viscosity=self.kinematic_viscosity)
        check_finite(body_force=self.body_force)

    @classmethod
    def of_reynolds(cls, reynolds: float, half_width: float = 0.5, kinematic_viscosity: float = 1.0) -> PlanePoiseuille:
        """The flow of a Reynolds number Re = U0 d / nu, by f = 2 nu^2 Re / d^3; in the paper d = 0.5 m, nu = 1 m^2/s.

        Raises:
            SphearError: a parameter is not a positive number.
        """
        check_positive(Reynolds_number=reynolds)
        flow = cls(half_width, kinematic_viscosity, 0.0)  # which checks them before they divide
        return replace(flow, body_force=2.0 * kinematic_viscosity**2 * reynolds / half_width**3)

    @property
    def centreline_velocity(self) -> float:
        """U0 = f d^2 / (2 nu), the steady velocity at y = 0, in m/s."""
        return 0.5 * self.body_force * self.half_width**2 / self.kinematic_viscosity

    @property
    def reynolds(self) -> float:
        """Re = |U0| d / nu."""
        return abs(self.centreline_velocity) * self.half_width / self.kinematic_viscosity

    def dimensionless_time(self, time: float) -> float:
        """t* = pi^2 nu t / (4 d^2) of a time t in s (eq. 39): in units of the slowest mode's decay."""
        return time * math.pi**2 * self.kinematic_viscosity / (4.0 * self.half_width**2)

    def time(self, dimensionless_time: float) -> float:
        """The time t in s of a t* (eq. 39)."""
        return dimensionless_time / self.dimensionless_time(1.0)

    def steady(self, y: ArrayLike) -> NDArray[np.float64]:
        """U(y, infinity) = f / (2 nu) (d^2 - y^2) in m/s, at distances y in m from the centreline (eq. 37).

        NaN beyond the walls.
        """
        return self.velocity(y, math.inf)

    def velocity(self, y: ArrayLike, time: float) -> NDArray[np.float64]:
        """The velocity U(y, t) in m/s.

            U / U0 = 1 - (y/d)^2 - (32/pi^3) sum_n (-1)^n / (2n+1)^3 cos((2n+1) pi y / (2d)) exp(-(2n+1)^2 t*)

        This is eq. 36 of the source, which is printed there with (y/d)^2 as a factor of the sum. It is summed until
        what is left out is below rounding. At early times that would take many terms that nearly cancel; there it is
        the same solution as a sum over images of the walls, whose relative error is small as well: with
        F(x) = 4 i2erfc(x), the distance s from the nearer wall, and lengths in units of sqrt(4 nu t),

            U / (f t) = 1 - sum_n (-1)^n (F(2 n d + s) + F(2 (n+1) d - s)).

        Exactly zero at t = 0 and on the walls.

        Args:
            y: distances from the centreline, in m, of any shape; a position within 1e-12 d of a wall is on it, beyond
                the walls the velocity is NaN.
            time: t, in s, from 0 to infinity.

        Raises:
            SphearError: the time is negative.
        """
        check_time(time)
        s = 1.0 - np.abs(np.asarray(y, dtype=np.float64)) / self.half_width  # from the nearer wall, in units of d
        s = np.where(np.abs(s) <= ROUNDING, 0.0, np.where(s < 0.0, np.nan, s))
        diffusion = time * self.kinematic_viscosity / self.half_width**2
        profile = _early(s, diffusion) if diffusion < EARLY else _series(s, diffusion)
        return np.asarray(self.centreline_velocity * profile)


def _series(s: NDArray[np.float64], diffusion: float) -> NDArray[np.float64]:
    """U / U0 by eq. 36, with (-1)^n cos((2n+1) pi y / (2d)) as a sine of the distance from the wall."""
    decay = 0.25 * math.pi**2 * diffusion
    total = s * (2.0 - s)
    for k in range(1, 4 + math.ceil(math.sqrt(40.0 / decay)), 2):  # exp(-40) is 4e-18
        total = total - 32.0 / (math.pi * k) ** 3 * math.exp(-(k**2) * decay) * np.sin(0.5 * math.pi * k * s)
    return total


def _early(s: NDArray[np.float64], diffusion: float) -> NDArray[np.float64]:
    """U / U0 = 2 nu t / d^2 (U / (f t)) by images of the walls, in pairs that cancel exactly on a wall."""
    if diffusion == 0.0:
        return 0.0 * s
    unit = 0.5 / math.sqrt(diffusion)
    x = np.minimum(s * unit, FAR)
    total = erf(x) - 2.0 * x**2 * erfc(x) + 2.0 / math.sqrt(math.pi) * x * np.exp(-(x**2))  # 1 - F(x)
    for n in range(1, 2 + math.ceil(3.0 / unit)):  # F(6) is 2e-18
        total = total + (-1.0) ** n * (_image((2 * n - s) * unit) - _image((2 * n + s) * unit))
    return np.asarray(2.0 * diffusion * total)


def _image(x: NDArray[np.float64]) -> NDArray[np.float64]:
    """F(x) = 4 i2erfc(x), which is 1 at x = 0 and 0 at infinity."""
    x = np.minimum(x, FAR)
    return np.asarray((1.0 + 2.0 * x**2) * erfc(x) - 2.0 / math.sqrt(math.pi) * x * np.exp(-(x**2)))


def rms_error(computed: ArrayLike, exact: ArrayLike) -> float:
    """The root of the mean of ((u - U) / U)^2 over the particles (Basa, Quinlan & Lastiwka 2009, eq. 38).

    Particles whose analytic velocity is zero, those on a wall and all at t = 0, are left out of the mean and of the
    number it is divided by. If that leaves none, the error is 0 where all computed velocities are zero too, else
    infinite. It is infinite as well where a velocity is not finite or a particle is beyond a wall, where the analytic
    velocity is NaN: a run that has lost a particle has failed.

    Args:
        computed: u, the particles' velocities along the channel.
        exact: U, the analytic velocities at their places, in the same units.

    Raises:
        SphearError: the two have different shapes, or there are no particles.
    """
    u, reference = (np.asarray(x, dtype=np.float64) for x in (computed, exact))
    if u.shape != reference.shape or u.size == 0:
        raise SphearError(f"an error needs as many computed as exact velocities, not {u.shape} and {reference.shape}")
    if not (np.isfinite(u).all() and np.isfinite(reference).all()):
        return math.inf
    moving = reference != 0.0
    if not moving.any():
        return math.inf if u.any() else 0.0
    return float(np.sqrt(np.mean((u[moving] / reference[moving] - 1.0) ** 2)))
