"""Walls of fixed particles: layers of them on the lattice of the fluid beyond a box, or in rows behind a shape."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
from scipy.spatial import cKDTree

from sphear.boundaries.box import Box
from sphear.boundaries.models.base import FIRST_ROW
from sphear.boundaries.shapes import Dummies, Shape, dummies, repeated
from sphear.boundaries.shapes.base import slipping
from sphear.errors import SphearError
from sphear.neighbours import Domain

Array = np.ndarray[Any, Any]

NEARBY = 0.1  # spacings along the wall, where it is looked for
STEEP = 0.3  # of that way, off which the wall has turned: a corner of more than 17 degrees


@dataclass(frozen=True)
class WallParticles:
    """Particles that stand still behind the walls.

    Attributes:
        positions: (M, d).
        velocities: (M, d), of the wall that each stands behind; in a corner of the slower one.
        normals: (M, d), of that wall, into the fluid; zero in corners, where no line across the wall meets the fluid.
        depths: (M,), behind the wall.
        nearest: (M,), the particle of the first layer before each one; itself in corners.
    """

    positions: Array
    velocities: Array
    normals: Array
    depths: Array
    nearest: Array


def wall_particles(box: Box, spacing: float, layers: int) -> WallParticles:
    """The particles behind the walls of a box.

    Args:
        box: with walls.
        spacing: of the particles; a whole number of them fits between the walls.
        layers: of particles behind each wall.
    """
    dimension = len(box.lower)
    if not layers:  # walls that mirror; without this, all places of the fluid would be gone through
        none = np.empty((0, dimension))
        return WallParticles(none, none, none, np.empty(0), np.empty(0, np.int64))
    wall_velocities = box.arrays()[3][..., :dimension]
    cells = [max(1, round((high - low) / spacing)) for low, high in zip(box.lower, box.upper, strict=True)]
    ranges = [range(-layers, n + layers) if axis in box.wall_axes else range(n) for axis, n in enumerate(cells)]
    number: dict[tuple[int, ...], int] = {}
    rows: list[tuple[list[float], Array, Array, float]] = []
    firsts: list[tuple[int, ...]] = []
    for index in product(*ranges):
        behind = [axis for axis, k in enumerate(index) if not 0 <= k < cells[axis]]
        if not behind:
            continue
        number[index] = len(rows)
        sides = [(axis, int(index[axis] >= cells[axis])) for axis in behind]
        speeds = [wall_velocities[axis, side] for axis, side in sides]
        normal, depth, first = np.zeros(dimension), 0.0, list(index)
        if len(sides) == 1:
            ((axis, side),) = sides
            normal[axis] = -1.0 if side else 1.0
            layer = index[axis] - cells[axis] if side else -1 - index[axis]
            depth = (layer + 0.5) * spacing
            first[axis] = cells[axis] if side else -1
        place = [low + (k + 0.5) * spacing for low, k in zip(box.lower, index, strict=True)]
        rows.append((place, min(speeds, key=lambda u: float(np.dot(u, u))), normal, depth))
        firsts.append(tuple(first))
    return WallParticles(
        positions=np.array([row[0] for row in rows]).reshape(-1, dimension),
        velocities=np.array([row[1] for row in rows]).reshape(-1, dimension),
        normals=np.array([row[2] for row in rows]).reshape(-1, dimension),
        depths=np.array([row[3] for row in rows]),
        nearest=np.array([number[first] for first in firsts], np.int64),
    )


def particles_behind(shape: Shape, spacing: float, depth: float, window: Domain) -> WallParticles:
    """The particles behind the walls of a shape, in rows along them.

    Args:
        shape: the region of fluid, in the plane.
        spacing: of the particles.
        depth: up to which there are rows.
        window: the box of interest, with its periodic axes.

    Raises:
        SphearError: fluid slips along one of the walls, which fixed particles cannot let it.
    """
    behind = dummies(shape, spacing, depth, window)
    if slipping(behind.velocities).any():
        raise SphearError(
            "fluid slips along walls of walls=mirror, or of scheme=incompressible, and not along fixed particles, which"
            f" the walls of {shape} are made of"
        )
    straight = ~_in_corners(shape, behind, spacing, window)
    first = np.flatnonzero((behind.depths < FIRST_ROW * spacing) & straight)
    nearest = np.arange(len(behind.positions))
    if len(first):
        nearest[straight] = first[cKDTree(behind.feet[first]).query(behind.feet[straight])[1]]
    return WallParticles(
        behind.positions,
        behind.velocities,
        np.where(straight[:, None], behind.normals, 0.0),
        np.where(straight, behind.depths, 0.0),
        nearest,
    )


def _in_corners(shape: Shape, behind: Dummies, spacing: float, window: Domain) -> Array:
    """True for particles with their foot in a corner, where the wall goes on in no straight line, (M,)."""
    whole, step = repeated(shape, window), NEARBY * spacing
    along = step * np.column_stack((-behind.normals[:, 1], behind.normals[:, 0]))
    off = [np.abs(whole.distance(window.wrapped(behind.feet + sign * along))) for sign in (1.0, -1.0)]
    return np.asarray(np.maximum(*off) > STEEP * step)
