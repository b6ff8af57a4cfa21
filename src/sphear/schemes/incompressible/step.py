"""A step of an incompressible flow: viscosity and forces, pressure, the move, and shifting."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from sphear.schemes.incompressible.differential_operators import DifferentialOperators
from sphear.schemes.incompressible.particle_sums import in_box
from sphear.schemes.incompressible.sums_of_places import viscosity_elsewhere
from sphear.schemes.incompressible.viscous import IMPLICIT_SHARE

if TYPE_CHECKING:
    from sphear.schemes.incompressible.flow import IncompressibleFlow

Array = np.ndarray[Any, Any]

MOVED_BEFORE = {"midpoint": 0.5, "start": 0.0, "intermediate": 0.0}  # share of the step, before forces act


def step(flow: IncompressibleFlow) -> None:
    """Make one step of a flow.

    Raises:
        FlowFailure: the flow broke down.
        SphearError: an equation was not solved.
    """
    dt, domain, u = flow.time_step, flow.discretisation.domain, flow.u.copy()  # before dry walls velocities change
    moved = MOVED_BEFORE[flow.settings.projection] * dt
    x, distance = flow.x, flow.distance
    if moved:
        x = x + moved * u
        flow.checks.check_speed(flow.time, flow.x, u)
        distance = flow.checks.put_back(flow.time, x, u)
        x = in_box(x, domain)
    operators = flow.discretisation.at(x, distance, () if viscosity_elsewhere(flow) else flow.together)
    force = _force(flow, operators, flow.time + moved)
    if flow.coupled is not None:
        after, slopes = flow.coupled.solve(operators, u, force, dt, moved, flow.steps)
        viscous = (after - u) / dt - force + slopes / flow.problem.density
    else:
        operators, after, slopes, viscous = _projected(flow, operators, u, force, moved)
    flow.pressure_positions, flow.pressure_slopes = operators.particles.positions[: flow.count], slopes
    x = x + (0.5 * dt - moved) * u + 0.5 * dt * after
    if flow.displacement.drift is not None:
        shift, change = flow.displacement.of(operators, after, dt, moved)
        after, x = after + change, x + shift
    if not np.isfinite(after + x).all():
        flow.checks.check_speed(flow.time, flow.x, after)  # before the state is no number
    flow.x, flow.u = x, after
    flow.energy_budget.add(dt, u, after, viscous, force)
    flow.time += dt
    flow.steps += 1
    flow.checks.check_speed(flow.time, flow.x, flow.u)
    flow.distance = flow.checks.put_back(flow.time, flow.x, flow.u)
    flow.x = in_box(flow.x, domain)


def _force(flow: IncompressibleFlow, operators: DifferentialOperators, time: float) -> Array:
    """(d,) or (N, d), the acceleration by forces at a time."""
    problem = flow.problem
    force = np.array(problem.body_force)
    return force if problem.force is None else force + problem.force(operators.particles.positions[: flow.count], time)


def _predicted(flow: IncompressibleFlow, operators: DifferentialOperators, u: Array, force: Array) -> Array:
    """(N, d), the acceleration of velocities u (N, d) by viscosity and a force, over the step."""
    share = IMPLICIT_SHARE[flow.settings.viscous_step]
    if not share:
        acceleration: Array = operators.viscous(u) + force
        return acceleration
    return flow.discretisation.viscous.implicit(share, flow.time_step, u, force, operators.viscous)


def _projected(
    flow: IncompressibleFlow, operators: DifferentialOperators, u: Array, force: Array, moved: float
) -> tuple[DifferentialOperators, Array, Array, Array]:
    """The operators where pressure acts, velocities (N, d) after it, its slopes, and the viscous acceleration."""
    dt, x = flow.time_step, operators.particles.positions[: flow.count]
    acceleration = _predicted(flow, operators, u, force)
    predicted = u + dt * acceleration
    if flow.settings.projection == "intermediate":
        flow.checks.check_speed(flow.time, x, predicted)
        x = in_box(x + dt * predicted, flow.discretisation.domain)
        operators = flow.discretisation.at(x, None, flow.together)
    even = operators.even(acceleration)
    before = operators.divergent(u, -moved) + dt * even
    pressures = flow.pressures.solve(operators, before, even[flow.count :], dt, moved)
    gradient = operators.pressure_gradient(pressures)
    after = predicted - dt / flow.problem.density * gradient
    return operators, after, operators.pressure_slopes(pressures, gradient), acceleration - force
