"""The region of fluid of a problem, and the wall particles around it."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from scipy.spatial import cKDTree

from sphear.boundaries import Box
from sphear.boundaries.shapes import Circle, Dummies, Rectangle, Shape, check_room, dummies, repeated
from sphear.errors import SphearError
from sphear.kernels import Kernel
from sphear.neighbours import Domain
from sphear.schemes.incompressible.settings import Incompressible
from sphear.schemes.incompressible.walls import Walls
from sphear.schemes.problem import Problem

Array = np.ndarray[Any, Any]

LITTLE = 1e-6  # spacings from a wall, and of its speed: as good as nothing
TOO_NEAR = 0.3  # spacings between particles on walls; those in right corners are half of one from the next
FIRST_ROW = 0.75  # spacings behind a wall, up to which its first row is; beyond a corner it is 0.71


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


def walls_of(problem: Problem, settings: Incompressible, kernel: Kernel, supports: int) -> Walls | None:
    """The wall particles, as deep as the kernel reaches; None where there are none.

    Args:
        problem: the flow.
        settings: what is chosen of it.
        kernel: with its smoothing length.
        supports: how many supports of the kernel a sum reaches.

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
    if settings.walls == "sfdi":
        behind = _with_row_on_walls(behind, dx, window)
    domain = window if any(problem.periodic) else None
    return Walls(
        behind,
        dx,
        kernel,
        domain,
        settings.continuation,
        settings.walls == "adami",
        problem.free_surface,
        accelerations(shape, behind, dx, window),
        curvatures(shape, behind, dx, window),
    )


def curvatures(shape: Shape, behind: Dummies, spacing: float, window: Domain) -> Array:
    """(W,): of the walls at the feet of dummies, 1 / R around fluid in a circle, -1 / R around a cylinder, else 0."""
    result = np.zeros(len(behind.positions))
    for primitive, inverted in shape.primitives():
        if isinstance(primitive, Circle) and primitive.slips:
            distance = np.abs(repeated(primitive, window).distance(behind.feet))
            result[distance < LITTLE * spacing] = (-1.0 if inverted else 1.0) / primitive.radius
    return result


def accelerations(shape: Shape, behind: Dummies, spacing: float, window: Domain) -> Array:
    """(W, d): (u . grad) u of the walls at the feet of dummies, spin x u of a circle that turns, else zero."""
    result = np.zeros_like(behind.velocities)
    for primitive, _ in shape.primitives():
        if isinstance(primitive, Circle) and primitive.spin:
            wall = repeated(primitive, window).foot(behind.feet)
            off = np.abs(wall.velocity - behind.velocities).max(axis=1)
            own = (np.abs(wall.distance) < LITTLE * spacing) & (off < LITTLE * abs(primitive.spin) * primitive.radius)
            result[own] = primitive.spin * np.column_stack((-behind.velocities[own, 1], behind.velocities[own, 0]))
    return result


def _with_row_on_walls(behind: Dummies, dx: float, window: Domain) -> Dummies:
    """The dummies after particles on the walls, at the feet of the first row, each some way from the others."""
    first = behind.depths < FIRST_ROW * dx
    feet, normals, velocities = behind.feet[first], behind.normals[first], behind.velocities[first]
    feet = window.wrapped(feet)
    places, source = window.with_images(feet, dx)
    taken, kept = np.zeros(len(feet), bool), []
    for k, listed in enumerate(cKDTree(places).query_ball_point(feet, TOO_NEAR * dx)):
        if taken[k]:
            continue
        near = source[listed]
        taken[near] = True  # in a corner the feet of several are one, which faces as they do in the mean
        mean = normals[near].mean(axis=0)
        length = np.hypot(*mean)
        normals[k] = mean / length if length > 0 else normals[k]
        kept.append(k)
    return Dummies(
        np.concatenate((feet[kept], behind.positions)),
        np.concatenate((np.zeros(len(kept)), behind.depths)),
        np.concatenate((normals[kept], behind.normals)),
        np.concatenate((velocities[kept], behind.velocities)),
    )
