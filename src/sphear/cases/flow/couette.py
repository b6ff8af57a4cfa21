"""Plane Couette flow from rest: one wall moves."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np

from sphear.boundaries import Box
from sphear.cases.flow.base import Case, Comparison, Flow, Settings
from sphear.cases.flow.initial import particles_between
from sphear.references.couette import PlaneCouette
from sphear.schemes.base import SCHEMES
from sphear.schemes.problem import Problem

Array = np.ndarray[Any, Any]

GAP, KINEMATIC_VISCOSITY, DENSITY = 1.0, 1.0, 1.0
STEADY = 1e-12


def reference(settings: Settings) -> PlaneCouette:
    """The exact flow; the wall's velocity follows from the Reynolds number U L / nu."""
    return PlaneCouette(GAP, KINEMATIC_VISCOSITY, settings.reynolds * KINEMATIC_VISCOSITY / GAP)


class Couette(Case):
    """The start-up of Couette flow between a wall at rest and one that slides."""

    name = "couette"
    defaults: ClassVar[Mapping[str, Mapping[str, Any]]] = {
        name: {"reynolds": 1.0, "resolution": 20} for name in SCHEMES
    }
    time_name = "t nu / L^2"
    horizon = float(-np.log(STEADY) / np.pi**2)

    def problem(self, settings: Settings) -> Problem:
        """A square of particles between a wall at rest below and one that moves above."""
        speed = reference(settings).wall_velocity
        box = Box((0.0, 0.0), (GAP, GAP), ("periodic", "walls"), upper_velocity=(speed, 0.0))
        positions, spacing = particles_between(box, settings)
        return Problem(
            positions=positions,
            velocities=np.zeros_like(positions),
            box=box,
            body_force=(0.0, 0.0),
            spacing=spacing,
            density=DENSITY,
            kinematic_viscosity=KINEMATIC_VISCOSITY,
            speed=speed,
            length=GAP,
        )

    def time_unit(self, settings: Settings) -> float:
        """L^2 / nu."""
        return GAP**2 / KINEMATIC_VISCOSITY

    def metrics(self, settings: Settings, flow: Flow) -> dict[str, float]:
        """The RMS error relative to the wall's velocity, and the kinetic energy over that of the steady flow."""
        along = reference(settings).velocity(flow.positions[:, 1], flow.time)
        speed = reference(settings).wall_velocity
        steady = reference(settings).steady(flow.positions[:, 1])
        return {
            "rms_error": float(np.sqrt(np.mean((flow.velocities[:, 0] - along) ** 2)) / speed),
            "kinetic_energy": float((flow.velocities**2).sum() / (steady**2).sum()),
        }

    def ended(self, settings: Settings, flow: Flow, metrics: dict[str, float]) -> str | None:
        """Steady when the slowest mode, exp(-pi^2 nu t / L^2), is below 1e-12."""
        decayed = np.exp(-(np.pi**2) * KINEMATIC_VISCOSITY * flow.time / GAP**2) < STEADY
        return "steady" if decayed else None

    def comparisons(self, settings: Settings, flow: Flow) -> dict[str, Comparison]:
        """The velocities of all particles beside the start-up series."""
        y = np.linspace(0.0, GAP, 101)
        exact = reference(settings).velocity(y, flow.time)
        return {"u": Comparison("y", flow.positions[:, 1], flow.velocities[:, 0], y, exact)}


COUETTE = Couette()
