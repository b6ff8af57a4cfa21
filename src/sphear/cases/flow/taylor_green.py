"""The Taylor-Green vortex in a periodic box."""

from __future__ import annotations

from typing import Any

import numpy as np

from sphear.boundaries import Box
from sphear.cases.flow.base import FlowCase
from sphear.cases.flow.lattice import staggered_from_walls
from sphear.references.taylor_green import TaylorGreen
from sphear.schemes.settings import FlowSettings
from sphear.schemes.flow import Flow
from sphear.schemes.problem import Problem

Array = np.ndarray[Any, Any]

SIDE, SPEED, DENSITY = 1.0, 1.0, 1.0


def reference(settings: FlowSettings) -> TaylorGreen:
    """The exact flow; the viscosity follows from the Reynolds number U L / nu."""
    return TaylorGreen(SPEED * SIDE / settings.reynolds, SIDE, SPEED, DENSITY)


def problem(settings: FlowSettings) -> Problem:
    """A lattice of particles with the exact velocities."""
    positions, spacing = staggered_from_walls(settings.resolution, SIDE, centred=False)
    return Problem(
        positions=positions,
        velocities=np.ascontiguousarray(reference(settings).velocity(positions, 0.0)),
        box=Box((0.0, 0.0), (SIDE, SIDE), ("periodic", "periodic")),
        body_force=(0.0, 0.0),
        spacing=spacing,
        density=DENSITY,
        kinematic_viscosity=SPEED * SIDE / settings.reynolds,
        speed=SPEED,
        length=SIDE,
    )


def exact(settings: FlowSettings, positions: Array, time: float) -> Array:
    """The decaying vortices."""
    return np.asarray(reference(settings).velocity(positions, time))


def metrics(settings: FlowSettings, flow: Flow) -> dict[str, float]:
    """L2 error over the exact velocity, kinetic energy, and it over the exact one."""
    velocity = exact(settings, flow.positions, flow.time)
    energy = float(0.5 * (flow.velocities**2).sum() * flow.problem.spacing**2 * DENSITY)
    return {
        "l2_error": float(np.linalg.norm(flow.velocities - velocity) / np.linalg.norm(velocity)),
        "kinetic_energy": energy,
        "kinetic_energy_ratio": energy / reference(settings).kinetic_energy(flow.time),
    }


def ended(settings: FlowSettings, flow: Flow, found: dict[str, float]) -> str | None:
    """Never before its time."""
    return None


TAYLOR_GREEN = FlowCase(
    name="taylor-green",
    defaults={"reynolds": 100.0, "resolution": 50, "until": 0.5},
    problem=problem,
    exact=exact,
    time_unit=lambda settings: SIDE / SPEED,
    time_name="t U / L",
    metrics=metrics,
    ended=ended,
)
