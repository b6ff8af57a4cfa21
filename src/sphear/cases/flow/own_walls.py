"""A case with walls of the user's own: a solid in its fluid."""

from __future__ import annotations

from dataclasses import replace

from sphear.boundaries.shapes import Shape, fastest, fitted, fluid_lattice, repeated, written
from sphear.cases.flow.base import Case, Flow, Settings
from sphear.errors import SphearError
from sphear.schemes.incompressible.region import fluid_of
from sphear.schemes.problem import Problem
from sphear.simulation.whole_flow import greatest_speed, kinetic_energy

SHARED = ("name", "defaults", "time_name", "horizon", "kinds", "presets")  # with the case without the solid


class AroundSolid(Case):
    """A case around a solid of the user's own.

    Particles in the solid are left out, those nearer to it than a quarter of a spacing moved away. What the case
    compares with and stops at holds without the solid only: its kinetic energy and the greatest speed are observed
    instead, until its end.

    Args:
        case: without the solid.
        solid: that is no fluid.
    """

    headline = "kinetic_energy"

    def __init__(self, case: Case, solid: Shape) -> None:
        self.case, self.solid = case, solid
        vars(self).update({name: getattr(case, name) for name in SHARED})

    def problem(self, settings: Settings) -> Problem:
        """The problem of the case with the solid in its fluid."""
        return around(self.case.problem(settings), self.solid)

    def time_unit(self, settings: Settings) -> float:
        """The time unit of the case."""
        return self.case.time_unit(settings)

    def metrics(self, settings: Settings, flow: Flow) -> dict[str, float]:
        """Kinetic energy, of a unit of depth, and the greatest speed."""
        return {"kinetic_energy": kinetic_energy(flow), "greatest_speed": greatest_speed(flow)}

    def ended(self, settings: Settings, flow: Flow, metrics: dict[str, float]) -> str | None:
        """At the horizon of the case, where nothing says until when."""
        horizon = self.case.horizon if settings.until is None else None
        return "time" if horizon is not None and flow.time >= horizon * self.time_unit(settings) else None


def opened(case: Case, settings: Settings) -> Case:
    """The case around the solid of its settings; without one, the case as it is."""
    return case if settings.solid == "none" else AroundSolid(case, written(settings.solid))


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
    """True if a solid is anywhere that fluid can be."""
    places = problem.positions if fluid is None else fluid_lattice(fluid, problem.spacing, problem.window)
    return bool((solid.distance(places) > -problem.spacing).any())
