"""A flow to be computed: fluid, box, forces and scales."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from sphear.boundaries import Box

Array = np.ndarray[Any, Any]

DENSITY_VARIATION = 0.01


@dataclass(frozen=True)
class Problem:
    """A flow to be computed.

    Attributes:
        positions: (N, d), at the start, of particles that fill the box `spacing` apart.
        velocities: (N, d), at the start.
        box: its sides.
        body_force: on a unit of mass, (d,).
        spacing: of the particles.
        density: at rest.
        kinematic_viscosity: of the fluid.
        speed: the largest speed that is expected.
        length: the length that the Reynolds number is made with.
    """

    positions: Array
    velocities: Array
    box: Box
    body_force: tuple[float, ...]
    spacing: float
    density: float
    kinematic_viscosity: float
    speed: float
    length: float

    def time_step_limits(self, h: float, sound_speed: float, radial: bool = False) -> dict[str, float]:
        """The time steps that the CFL, viscous and body-force conditions allow (Morris, Fox & Zhu 1997).

        Args:
            h: the smoothing length.
            sound_speed: at rest.
            radial: whether the viscous term acts along the line of centres: it contains the gradient of the
                divergence, so that waves along their own direction feel up to three times the viscosity.
        """
        force, nu = math.hypot(*self.body_force), self.kinematic_viscosity
        return {
            "cfl": 0.25 * h / (sound_speed + self.speed),
            "viscous": (1 / 12 if radial else 1 / 8) * h**2 / nu if nu > 0 else math.inf,
            "body_force": 0.25 * math.sqrt(h / force) if force > 0 else math.inf,
        }


def morris_sound_speed(problem: Problem) -> float:
    """c0^2 = max(U0^2, nu U0 / L, F L) / delta with delta = 0.01 (Morris, Fox & Zhu 1997, eq. 21)."""
    force = math.hypot(*problem.body_force)
    return math.sqrt(
        max(
            problem.speed**2,
            problem.kinematic_viscosity * problem.speed / problem.length,
            force * problem.length,
        )
        / DENSITY_VARIATION
    )
