"""From a region with conditions, a fluid and forces to the problem that a scheme computes."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any, get_args

import numpy as np

from sphear.boundaries import Box
from sphear.boundaries.conditions import Condition, Periodic, WallCondition
from sphear.boundaries.named_walls import unbounded, walls_by_name, with_conditions
from sphear.boundaries.shapes import Rectangle, Shape
from sphear.checked import number, numbers
from sphear.errors import SphearError, quoted
from sphear.names import unknown
from sphear.schemes.energy import greatest_speed
from sphear.schemes.problem import Problem
from sphear.schemes.watch import wall_speed
from sphear.simulation.fluid import Fluid
from sphear.simulation.particles import Velocity, initial_velocities, lattice

Array = np.ndarray[Any, Any]
Force = tuple[float, ...] | Callable[[Array, float], Array]

AXES = ("x", "y")


def problem_of(
    region: Shape,
    spacing: float,
    fluid: Fluid,
    boundaries: Mapping[str, Condition],
    velocity: Velocity = None,
    body_force: Force | None = None,
    speed: float | None = None,
    length: float | None = None,
    filled: Shape | None = None,
) -> Problem:
    """The problem of a region of fluid.

    Args:
        region: where fluid is; bounded, but for the outside of solids in it.
        spacing: of the particles.
        fluid: density and viscosity.
        boundaries: conditions by the names of walls, and `Periodic` by the names of axes; other walls are at rest.
        velocity: of the particles at the start.
        body_force: on a unit of mass, constant or a function of places (N, d) and the time.
        speed: the largest that is expected; None takes that of walls, of the start, or what the force gives.
        length: that a Reynolds number is made with; None takes the least extent of the region.
        filled: the part of the region that fluid fills at the start, with a surface of its own; None is all of it.

    Raises:
        SphearError: these do not go together.
    """
    if not isinstance(region, Shape):
        raise SphearError(f"a region is a shape, such as Rectangle((0, 0), (1, 1)), not {quoted(region)}")
    if not isinstance(fluid, Fluid):
        raise SphearError(f"the fluid is a Fluid, such as Fluid(kinematic_viscosity=0.01), not {quoted(fluid)}")
    dx = number(spacing)
    if not dx > 0:
        raise SphearError(f"the spacing of the particles is a positive length, not {quoted(spacing)}")
    axes, conditions = _sorted(region, boundaries)
    region = with_conditions(region, conditions)
    box, shape = _box_and_shape(region, axes)
    if filled is not None:
        shape = unbounded(region, axes, box.lower, box.upper)
    positions, dx = lattice(box, shape, dx)
    if filled is not None:
        positions = _within(filled, positions)
    velocities = initial_velocities(velocity, positions)
    extent = min(high - low for low, high in zip(box.lower, box.upper, strict=True))
    given = extent if length is None else length
    force: Any = (0.0,) * len(box.lower) if body_force is None or callable(body_force) else body_force
    walls = wall_speed(box, shape, dx)
    return Problem(
        positions=positions,
        velocities=velocities,
        box=box,
        body_force=force,
        spacing=dx,
        density=fluid.density,
        kinematic_viscosity=fluid.nu,
        speed=_speed(walls, velocities, force, fluid.nu, extent) if speed is None else speed,
        length=given,
        shape=shape,
        free_surface=filled is not None,
        force=body_force if callable(body_force) else None,
    )


def _within(filled: Shape, positions: Array) -> Array:
    """The particles in the part that is filled."""
    given: object = filled
    if not isinstance(given, Shape):
        raise SphearError(f"the part that is filled is a shape, such as Rectangle((0, 0), (1, 2)), not {quoted(given)}")
    inside: Array = positions[filled.distance(positions) > 0]
    if not len(inside):
        raise SphearError(f"the part that is filled, the {filled}, holds no particle of the region")
    return inside


def _sorted(region: Shape, boundaries: Mapping[str, Condition]) -> tuple[tuple[int, ...], dict[str, WallCondition]]:
    """The periodic axes, and the conditions of walls by name."""
    given: object = boundaries
    if not isinstance(given, Mapping):
        raise SphearError(f"boundaries are given by name, as in {{'upper': NoSlip()}}, not {quoted(given)}")
    axes, conditions, walls = [], {}, known_walls(region)
    for name, condition in given.items():
        if name not in walls:
            raise unknown("wall", quoted(name) if not isinstance(name, str) else name, walls)
        if not isinstance(condition, get_args(Condition)):
            raise SphearError(f"the boundary {name!r} has a condition, such as NoSlip(), not {quoted(condition)}")
        if not isinstance(condition, Periodic):
            conditions[name] = condition
        elif name in AXES:
            axes.append(AXES.index(name))
        else:
            raise SphearError(f"a flow repeats along an axis, {' or '.join(AXES)}, not at the wall {quoted(name)}")
    return tuple(sorted(axes)), conditions


def _box_and_shape(region: Shape, axes: tuple[int, ...]) -> tuple[Box, Shape | None]:
    """The box around a region, and its shape unless it is that of the box."""
    lower, upper = region.bounds
    if not all(map(math.isfinite, (*lower, *upper))):
        raise SphearError(f"a region is bounded, and the {region} is not: take it from a Rectangle")
    sides: Any = tuple("periodic" if axis in axes else "walls" for axis in range(len(lower)))
    if isinstance(region, Rectangle):
        moving = dict(region.velocities)
        ends = {0: ("left", "right"), 1: ("lower", "upper")}
        last = max((axis for axis in ends if axis not in axes), default=-1)
        mine = ends.get(last, ())
        if all(side in mine for side in moving):
            low, high = (moving.get(side, ()) for side in mine) if mine else ((), ())
            free = tuple((axis, end) for axis in ends for end in (0, 1) if ends[axis][end] in region.slips)
            return Box(lower, upper, sides, lower_velocity=low, upper_velocity=high, free_slip=free), None
    for name, (primitive, side) in walls_by_name(region).items():
        if isinstance(primitive, Rectangle) and (side in dict(primitive.velocities) or side in primitive.slips):
            axis = 0 if side in ("left", "right") else 1
            if axis in axes:
                raise SphearError(
                    f"the flow repeats along {AXES[axis]}, so that there is no wall {name!r} for a condition"
                )
    return Box(lower, upper, sides), unbounded(region, axes, lower, upper)


def _speed(walls: float, velocities: Array, force: Any, viscosity: float, extent: float) -> float:
    """The largest speed to expect: of walls, of the start, or of the least of what viscosity and inertia leave a force.

    Between plates a force f drives f L^2 / (8 nu); from rest it accelerates fluid to sqrt(2 f L) over a length.
    """
    start = greatest_speed(velocities)
    f = math.hypot(*numbers(force))
    driven = math.sqrt(2.0 * f * extent)
    driven = min(driven, f * extent**2 / (8.0 * viscosity)) if viscosity else driven
    speed = max(walls, start, driven)
    if not speed > 0:
        raise SphearError("nothing moves this fluid at the start: say how fast it will be, as in speed=1.0")
    return speed


def known_walls(region: Shape) -> tuple[str, ...]:
    """The names of the walls of a region, and of the axes along which it may repeat."""
    return (*walls_by_name(region), *AXES)
