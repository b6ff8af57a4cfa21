"""The Taylor-Green vortex in a periodic box."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np

from sphear.boundaries import Box
from sphear.cases.flow.base import Case, Comparison, Flow, Settings
from sphear.cases.flow.initial import particles_between
from sphear.references.taylor_green import TaylorGreen
from sphear.schemes.base import SCHEMES
from sphear.schemes.problem import Problem
from sphear.simulation.whole_flow import kinetic_energy

Array = np.ndarray[Any, Any]

SIDE, SPEED, DENSITY = 1.0, 1.0, 1.0
LEAST_DECAY = 1e-12  # of the exact velocities: below, rounding of the start is all that is left to compare


def reference(settings: Settings) -> TaylorGreen:
    """The exact flow; the viscosity follows from the Reynolds number U L / nu."""
    return TaylorGreen(SPEED * SIDE / settings.reynolds, SIDE, SPEED, DENSITY)


def gone(settings: Settings, flow: Flow) -> bool:
    """True if the exact flow has decayed so far that nothing is relative to it."""
    return reference(settings).decay(flow.time) < LEAST_DECAY


class TaylorGreenVortices(Case):
    """Decaying Taylor-Green vortices in a periodic square."""

    name = "taylor-green"
    defaults: ClassVar[Mapping[str, Mapping[str, Any]]] = {
        name: {"reynolds": 100.0, "resolution": 50, "until": 0.5} for name in SCHEMES
    }
    time_name = "t U / L"
    headline = "l2_error"

    def problem(self, settings: Settings) -> Problem:
        """A lattice of particles with the exact velocities."""
        box = Box((0.0, 0.0), (SIDE, SIDE), ("periodic", "periodic"))
        positions, spacing = particles_between(box, settings)
        return Problem(
            positions=positions,
            velocities=np.ascontiguousarray(reference(settings).velocity(positions, 0.0)),
            box=box,
            body_force=(0.0, 0.0),
            spacing=spacing,
            density=DENSITY,
            kinematic_viscosity=SPEED * SIDE / settings.reynolds,
            speed=SPEED,
            length=SIDE,
        )

    def time_unit(self, settings: Settings) -> float:
        """L / U."""
        return SIDE / SPEED

    def metrics(self, settings: Settings, flow: Flow) -> dict[str, float]:
        """L2 error over the exact velocity, kinetic energy, and it over the exact one; NaN where that has decayed."""
        energy = kinetic_energy(flow)
        if gone(settings, flow):
            return {"l2_error": math.nan, "kinetic_energy": energy, "kinetic_energy_ratio": math.nan}
        velocity = np.asarray(reference(settings).velocity(flow.positions, flow.time))
        return {
            "l2_error": float(np.linalg.norm(flow.velocities - velocity) / np.linalg.norm(velocity)),
            "kinetic_energy": energy,
            "kinetic_energy_ratio": energy / reference(settings).kinetic_energy(flow.time),
        }

    def ended(self, settings: Settings, flow: Flow, metrics: dict[str, float]) -> str | None:
        """Never before its time."""
        return None

    def summary(self, settings: Settings, flow: Flow) -> dict[str, Any]:
        """From when on nothing is relative to the exact flow, where that time has come."""
        if not gone(settings, flow):
            return {}
        last = -math.log(LEAST_DECAY) * settings.reynolds / (8.0 * math.pi**2)
        return {
            "reference_missing": f"the exact flow is below {LEAST_DECAY:g} of its start from t U / L = {last:.4g} on,"
            " and no error is relative to it"
        }

    def comparisons(self, settings: Settings, flow: Flow) -> dict[str, Comparison]:
        """The velocities of the particles near the line x = L / 4 beside the decaying vortices."""
        y = np.linspace(0.0, SIDE, 101)
        line = np.stack((np.full_like(y, 0.25 * SIDE), y), axis=1)
        near = np.abs(flow.positions[:, 0] - 0.25 * SIDE) < 0.5 * flow.problem.spacing
        exact = np.asarray(reference(settings).velocity(line, flow.time))
        places, velocities = flow.positions[near, 1], flow.velocities[near]
        return {
            name: Comparison("y", places, velocities[:, component], y, exact[:, component])
            for component, name in enumerate(("u near x = L / 4", "v near x = L / 4"))
        }


TAYLOR_GREEN = TaylorGreenVortices()
