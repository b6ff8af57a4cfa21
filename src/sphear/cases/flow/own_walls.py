"""A case with walls of the user's own: a solid in its fluid."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from sphear.boundaries.shapes import Shape, fastest, fitted, fluid_lattice, repeated, written
from sphear.cases.flow.base import FlowCase, FlowInTime, Settings, kinetic_energy
from sphear.errors import SphearError
from sphear.schemes.incompressible.region import fluid_of
from sphear.schemes.incompressible.settings import IncompressibleSettings
from sphear.schemes.problem import Problem


def opened(case: FlowCase, settings: Settings) -> FlowCase:
    """The case around the solid of its settings; without one, the case as it is.

    Particles in the solid are left out, those nearer to it than a quarter of a spacing moved away. What the case
    compares with and stops at holds without the solid only: its kinetic energy and the greatest speed are observed
    instead, until its end.
    """
    if not isinstance(settings, IncompressibleSettings) or settings.solid == "none":
        return case
    solid = written(settings.solid)

    def ended(settings: Settings, flow: FlowInTime, found: dict[str, float]) -> str | None:
        horizon = case.horizon if settings.until is None else None
        return "time" if horizon is not None and flow.time >= horizon * case.time_unit(settings) else None

    return replace(
        case,
        problem=lambda settings: around(case.problem(settings), solid),
        comparisons=lambda settings, flow: {},
        metrics=lambda settings, flow: motion(flow),
        ended=ended,
        summary=lambda settings, flow: {},
        profiles=lambda settings, flow: {},
        headline="kinetic_energy",
        known=lambda settings: None,
    )


def motion(flow: FlowInTime) -> dict[str, float]:
    """Kinetic energy, of a unit of depth, and the greatest speed."""
    greatest = float(np.sqrt((flow.velocities**2).sum(axis=1).max()))
    return {"kinetic_energy": kinetic_energy(flow), "greatest_speed": greatest}


def around(problem: Problem, solid: Shape) -> Problem:
    """The problem with a solid in its fluid.

    Raises:
        SphearError: the solid cannot repeat as the box does, is not where fluid can be, or leaves no particle.
    """
    fluid = fluid_of(problem)
    shape = ~solid if fluid is None else fluid & ~solid  # which may stand on a wall
    window = problem.window
    if not _touched(problem, fluid, repeated(solid, window)):
        raise SphearError(f"the {solid} is nowhere in the fluid: its coordinates are those of the flow")
    positions, kept = fitted(problem.positions, repeated(shape, window), problem.spacing)
    if not len(kept):
        raise SphearError(f"the {solid} leaves no particle of the fluid")
    speed = max(problem.speed, fastest(solid, problem.spacing, window))
    return replace(problem, positions=positions, velocities=problem.velocities[kept], shape=shape, speed=speed)


def _touched(problem: Problem, fluid: Shape | None, solid: Shape) -> bool:
    """Whether a solid is anywhere that fluid can be."""
    places = problem.positions if fluid is None else fluid_lattice(fluid, problem.spacing, problem.window)
    return bool((solid.distance(places) > -problem.spacing).any())
