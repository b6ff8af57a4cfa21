"""The region of fluid of a problem, and the wall particles around it."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from sphear.boundaries import Box
from sphear.boundaries.shapes import Circle, Dummies, Rectangle, Shape, check_room, dummies, repeated
from sphear.boundaries.shapes.base import Foot
from sphear.errors import SphearError
from sphear.kernels import Kernel
from sphear.neighbours import Domain
from sphear.schemes.incompressible.settings import Incompressible
from sphear.schemes.incompressible.walls import Walls
from sphear.schemes.problem import Problem

Array = np.ndarray[Any, Any]

LITTLE = 1e-6  # spacings from a wall, and of its speed: as good as nothing


def region(problem: Problem) -> Shape | None:
    """The region of fluid: the problem's own, or that between the walls of its box; None without walls.

    Raises:
        SphearError: its own goes on beyond a wall of the box.
    """
    if problem.shape is None:
        return between_walls(problem.box)
    whole = repeated(problem.shape, problem.window)
    _check_box(whole, problem)
    return whole


def _check_box(whole: Shape, problem: Problem) -> None:
    """Refuse fluid on the other side of a wall of the box."""
    low, high = np.array(problem.box.lower), np.array(problem.box.upper)
    for axis in problem.box.wall_axes:
        along = np.arange(low[1 - axis], high[1 - axis], problem.spacing) + 0.5 * problem.spacing
        for wall, way in ((low, -1.0), (high, 1.0)):
            beyond = np.empty((len(along), 2))
            beyond[:, 1 - axis] = along
            beyond[:, axis] = wall[axis] + way * LITTLE * problem.spacing
            if (whole.distance(beyond) > 0).any():
                raise SphearError(
                    f"the shape of the fluid goes on beyond the wall of the box at {'xy'[axis]} = {wall[axis]:g}: cut"
                    " it there, with &, or take a larger box"
                )


def fluid_of(problem: Problem) -> Shape | None:
    """The fluid in one period: the problem's own shape, or that between the walls of its box; None without walls."""
    return problem.shape if problem.shape is not None else between_walls(problem.box)


def between_walls(box: Box) -> Shape | None:
    """The region between the walls of a box; None where all its sides are periodic.

    Raises:
        SphearError: the box has walls and is not plane.
    """
    if not box.wall_axes:
        return None
    if len(box.lower) != 2:
        raise SphearError(f"walls of incompressible flows are in two dimensions, not in {len(box.lower)}")
    names = {(0, 0): "left", (0, 1): "right", (1, 0): "lower", (1, 1): "upper"}
    moving = {(box.wall_axes[-1], 0): box.lower_velocity, (box.wall_axes[-1], 1): box.upper_velocity}
    (left, lower), (right, upper) = (
        tuple(sign * math.inf if free else x for x, free in zip(corner, box.periodic, strict=True))
        for sign, corner in ((-1.0, box.lower), (1.0, box.upper))
    )
    velocities = {
        names[side]: (float(velocity[0]), float(velocity[1])) for side, velocity in moving.items() if velocity
    }
    free = tuple(names[side] for side in box.free_slip)
    return Rectangle((left, lower), (right, upper), velocities=velocities, slips=free)


def walls_of(
    problem: Problem, settings: Incompressible, kernel: Kernel, supports: int, threads: int = 1
) -> Walls | None:
    """The wall particles, as deep as the kernel reaches; None where there are none.

    Args:
        problem: the flow.
        settings: what is chosen of it.
        kernel: with its smoothing length.
        supports: how many supports of the kernel a sum reaches.
        threads: to compute on.

    Raises:
        SphearError: there is no room for the fluid.
    """
    shape = fluid_of(problem)
    if shape is None:
        return None
    window, dx = problem.window, problem.spacing
    check_room(shape, dx, supports * kernel.radius, window, kernel.radius)
    behind = dummies(shape, dx, math.ceil(supports * kernel.radius / dx) * dx, window)
    if not len(behind.positions):
        return None
    model = settings.wall_model
    behind = model.wall_particles(behind, dx, window)
    domain = window if any(problem.periodic) else None
    turning, bent = accelerations(shape, behind, dx, window), curvatures(shape, behind, dx, window)
    return Walls(behind, dx, kernel, domain, model, problem.free_surface, turning, bent, threads)


def curvatures(shape: Shape, behind: Dummies, spacing: float, window: Domain) -> Array:
    """(W,): of the walls at the feet of dummies, 1 / R around fluid in a circle, -1 / R around a cylinder, else 0."""
    result = np.zeros(len(behind.positions))
    for circle, inverted, feet in _circles(shape, behind, window):
        if circle.slips:
            own = np.abs(feet.distance) < LITTLE * spacing
            result[own] = (-1.0 if inverted else 1.0) / circle.radius
    return result


def accelerations(shape: Shape, behind: Dummies, spacing: float, window: Domain) -> Array:
    """(W, d): (u . grad) u of the walls at the feet of dummies, spin x u of a circle that turns, else zero."""
    result = np.zeros_like(behind.velocities)
    for circle, _, feet in _circles(shape, behind, window):
        if circle.spin:
            off = np.abs(feet.velocity - behind.velocities).max(axis=1)
            own = (np.abs(feet.distance) < LITTLE * spacing) & (off < LITTLE * abs(circle.spin) * circle.radius)
            result[own] = circle.spin * np.column_stack((-behind.velocities[own, 1], behind.velocities[own, 0]))
    return result


def _circles(shape: Shape, behind: Dummies, window: Domain) -> Iterator[tuple[Circle, bool, Foot]]:
    """The circles of a shape, whether each is a solid in it, and their walls' points nearest to the feet of dummies."""
    for primitive, inverted in shape.primitives():
        if isinstance(primitive, Circle) and (primitive.slips or primitive.spin):
            yield primitive, inverted, repeated(primitive, window).foot(behind.feet)
