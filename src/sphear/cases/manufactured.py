"""The manufactured flow as a problem, and how far an incompressible flow is from an exact one."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from sphear.boundaries import Box
from sphear.schemes.problem import Problem

if TYPE_CHECKING:
    from sphear.references.manufactured import ClosedVortex
    from sphear.schemes.incompressible.flow import IncompressibleFlow

Array = np.ndarray[Any, Any]

FASTEST = 1.5  # of the flow, sides a time


class Exact(Protocol):
    """An exact flow of density 1."""

    def velocity(self, positions: Array, time: float) -> Array:
        """The exact velocity (N, d) at positions (N, d)."""

    def pressure(self, positions: Array, time: float) -> Array:
        """The exact pressure (N,) at positions (N, d)."""


def manufactured(exact: ClosedVortex, count: int) -> Problem:
    """The flow under its force from its velocities at the start, on a lattice of `count` particles a side."""
    dx = 1.0 / count
    ticks = (np.arange(count) + 0.5) * dx
    x = np.stack(np.meshgrid(ticks, ticks, indexing="ij"), axis=-1).reshape(-1, 2)
    return Problem(
        positions=x,
        velocities=exact.velocity(x, 0.0),
        box=Box((0.0, 0.0), (1.0, 1.0), ("walls", "walls")),
        body_force=(0.0, 0.0),
        spacing=dx,
        density=1.0,
        kinematic_viscosity=exact.kinematic_viscosity,
        speed=FASTEST,
        length=1.0,
        force=exact.force,
    )


def relative_errors(flow: IncompressibleFlow, exact: Exact) -> tuple[float, float]:
    """Errors of velocity and pressure: the norm of the difference over that of the exact one, pressures without means.

    Each of the time that it belongs to.
    """
    velocity = np.asarray(exact.velocity(flow.positions, flow.time))
    pressure = np.asarray(exact.pressure(flow.positions, flow.pressure_time))
    off = flow.pressure - flow.pressure.mean() - pressure + pressure.mean()
    return (
        float(np.linalg.norm(flow.velocities - velocity) / np.linalg.norm(velocity)),
        float(np.linalg.norm(off) / np.linalg.norm(pressure)),
    )
