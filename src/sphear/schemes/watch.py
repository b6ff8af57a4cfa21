"""Signs that a flow is none: energy that nobody gave, speeds that nothing drives, layers that are not resolved."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from sphear.boundaries import Box
from sphear.boundaries.shapes import Shape
from sphear.boundaries.shapes.fastest import fastest
from sphear.neighbours import Domain
from sphear.schemes.base import Flow
from sphear.schemes.energy import greatest_speed, kinetic_energy
from sphear.schemes.problem import Problem

Array = np.ndarray[Any, Any]

GROWTH = 0.01  # of the energy at the start, or turned over so far, by which that of an undriven flow may grow
CREATED = 0.2  # of the energy that was there and turned over, which the discretisation may make
OVERTAKEN = 1.25  # times the fastest wall or the fastest particle at the start, up to which fluid may be
THIN_LAYER = 2.0  # spacings: layers at walls of thickness L / sqrt(Re) are not resolved below
LARGE_CELL = 50.0  # U dx / nu, from which on particles dissipate more than viscosity does
LOST = 0.05  # of the energy that was there and turned over, from which on a loss to the discretisation is told
NOTHING = 1e-3  # of the expected speed or energy


class Watch:
    """Watches a flow for what no fluid does.

    Args:
        problem: of the flow, with its particles at the start.
    """

    def __init__(self, problem: Problem) -> None:
        self.mass = problem.density * problem.spacing ** problem.positions.shape[1]
        self.force = np.array(problem.body_force, np.float64)
        self.driven = bool(self.force.any()) or problem.force is not None
        self.varied = problem.force is not None
        self.walls = wall_speed(problem.box, problem.shape, problem.spacing)
        self.fastest = max(self.walls, greatest_speed(problem.velocities))
        self.start = kinetic_energy(self.mass, problem.velocities)
        self.heights = self._heights(problem)
        self.scale = 0.5 * self.mass * len(problem.positions) * problem.speed**2

    def _heights(self, problem: Problem) -> float | None:
        """sum_i f . x_i at the start; None where particles go round a period along the force."""
        round_ = any(periodic and force for periodic, force in zip(problem.periodic, self.force, strict=True))
        return None if round_ else float((problem.positions @ self.force).sum())

    def fault(self, flow: Flow) -> str | None:
        """Find what is wrong with a flow, in a sentence without its end; None where nothing is.

        - Fluid that no force drives is not faster than 1.25 times the fastest wall or particle at the start.
        - Where walls are at rest, kinetic energy and that in a constant force do not grow by more than 1 % of their
          start or, from rest, of the energy that was turned over. Sound, which an explicit flow makes, only takes some.
        - The residual of the energy budget does not rise by more than 20 % of the energy that was there and turned
          over.
        """
        least = NOTHING * flow.problem.speed
        if not self.driven and (speed := greatest_speed(flow.velocities)) > OVERTAKEN * max(self.fastest, least):
            what = "fastest wall" if self.walls == self.fastest else "fastest particle at the start"
            times = (
                f"{speed / self.fastest:.3g} times as fast as the {what}" if self.fastest else "on its way from rest"
            )
            return f"fluid is {times}, and no force drives it"
        budget = flow.energy_budget
        if not self.walls and not self.varied and self.heights is not None:
            whole = self.start if budget is None else budget.largest + budget.turned
            grown = self._grown(flow) / max(whole, NOTHING * self.scale)
            if grown > GROWTH:
                return f"its energy has grown by {grown:.2g} of what there was, and nothing gives any"
        if budget is not None and (created := budget.created(flow.velocities)) > CREATED:
            return f"the discretisation has made {created:.2g} of the energy that was there and turned over"
        return None

    def _grown(self, flow: Flow) -> float:
        """Kinetic energy and that in a constant force, over what they were at the start."""
        assert self.heights is not None
        given = self.mass * (float((flow.positions @ self.force).sum()) - self.heights)
        return float(kinetic_energy(self.mass, flow.velocities) - self.start - given)


def wall_speed(box: Box, shape: Shape | None, spacing: float) -> float:
    """The speed of the fastest wall, of a box and of a shape in it."""
    speeds = [math.hypot(*velocity) for velocity in (box.lower_velocity, box.upper_velocity)]
    if shape is not None:
        speeds.append(fastest(shape, spacing, Domain(box.lower, box.upper, box.periodic)))
    return max(speeds)


def unresolved(problem: Problem) -> list[str]:
    """Sentences that say what the particles of a problem do not resolve; none of a flow that they do.

    - Layers at walls of the thickness L / sqrt(Re), below two spacings. Straight channels have parallel flow, whose
      layers do not depend on Re.
    - Without walls, the cell Reynolds number U dx / nu beyond 50, where particles that shift dissipate more than
      viscosity does.
    """
    nu, dx, length, speed = problem.kinematic_viscosity, problem.spacing, problem.length, problem.speed
    if nu == 0.0 or problem.straight:
        return []
    cell, layer = speed * dx / nu, math.sqrt(nu * length / speed) / dx
    said = []
    if problem.walled and layer < THIN_LAYER:
        said.append(
            f"layers at walls, L / sqrt(Re) thick, are {layer:.2g} spacings and not resolved below {THIN_LAYER:g}: take"
            f" {THIN_LAYER / layer:.2g} times the resolution"
        )
    elif not problem.walled and cell > LARGE_CELL:
        said.append(
            f"the cell Reynolds number U dx / nu is {cell:.3g}, and beyond {LARGE_CELL:g} particles dissipate more than"
            " the viscosity does"
        )
    return said
