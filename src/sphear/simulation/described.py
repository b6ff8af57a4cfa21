"""A simulation in words: its physics, its numerics, the limits of its step, and what a run will take."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from sphear.boundaries.conditions import NoSlip, Periodic
from sphear.simulation.region import known_walls

if TYPE_CHECKING:
    from sphear.simulation.simulation import Simulation

SIDES = {"x": ("left", "right"), "y": ("lower", "upper")}  # that are none where the flow repeats along an axis


def described(simulation: Simulation) -> str:
    """A few lines, each with a word for what it says."""
    problem, flow = simulation.flow.problem, simulation.flow
    crossing = math.ceil(problem.length / problem.speed / flow.time_step)
    lines = [
        ("region", str(simulation.region)),
        ("fluid", repr(simulation.fluid)),
        ("Reynolds", f"{simulation.reynolds:.6g}, of the speed {problem.speed:g} and the length {problem.length:g}"),
    ]
    if problem.force is not None or any(problem.body_force):
        lines.append(("force", str(problem.body_force if problem.force is None else "of place and time")))
    lines += _boundaries(simulation)
    if problem.free_surface:
        lines.append(("filled", f"{simulation.filled}, with a surface of its own"))
    lines += [
        ("particles", f"{flow.count}, {problem.spacing:g} apart"),
        ("scheme", str(simulation.scheme)),
        ("viscosity", f"{flow.resolved()['viscosity']}, kernel {flow.kernel.name} with h = {flow.kernel.h:g}"),
        ("time step", f"{flow.time_step:.4g}, where {_limits(flow.limits)}"),
        ("steps", f"{crossing} while fluid crosses the length once"),
        *(("unresolved", sentence) for sentence in simulation.unresolved),
        ("standing", f"t = {simulation.time:.6g}, {simulation.steps} steps{_end(simulation)}"),
    ]
    return "\n".join(f"{word:<11}{said}" for word, said in lines)


def _limits(limits: dict[str, float]) -> str:
    allowed = (f"{name.replace('_', ' ')} allows {limit:.4g}" for name, limit in limits.items() if limit < math.inf)
    return ", ".join(allowed)


def _boundaries(simulation: Simulation) -> list[tuple[str, str]]:
    """Axes along which the flow repeats, and the walls that are left, with their conditions."""
    boundaries = simulation.boundaries
    periodic = [name for name, condition in boundaries.items() if isinstance(condition, Periodic)]
    gone = {side for axis in periodic for side in SIDES[axis]}
    walls = [name for name in known_walls(simulation.region) if name not in SIDES and name not in gone]
    return [(name, repr(boundaries.get(name, NoSlip()))) for name in (*periodic, *walls)]


def _end(simulation: Simulation) -> str:
    return f", end: {simulation.end}" if simulation.end else ""
