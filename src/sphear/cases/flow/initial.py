"""Where particles are at the start: on a lattice half a spacing away from the sides, staggered, or disordered."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from sphear.boundaries import Box
from sphear.boundaries.box import with_images
from sphear.boundaries.shapes import Shape, fluid_lattice
from sphear.cases.size import check_size
from sphear.engine.sweep import sweep
from sphear.errors import SphearError
from sphear.interactions import Shifting
from sphear.interactions.rates import Rates
from sphear.kernels import WendlandC2
from sphear.neighbours import Domain, Neighbours

if TYPE_CHECKING:
    from sphear.schemes.base import Settings

Array = np.ndarray[Any, Any]

JITTER = 0.5  # of a spacing, before disordered particles are let settle
SETTLING_STEPS = 200
SETTLING_RATE = 0.2  # of a smoothing length, for a drift of the largest speed


def particles_between(box: Box, settings: Settings) -> tuple[Array, float]:
    """Particles that fill a box, `resolution` along its last axis, and their spacing.

    As `settings.initial` says: on a square lattice; with every other row of it shifted by half a spacing (by a quarter
    to either side where the rows end at walls); or relaxed from random places, drawn with `settings.seed`.
    """
    spacing = spacing_of(box, settings)
    ticks = [
        low + (np.arange(round((high - low) / spacing)) + 0.5) * spacing
        for low, high in zip(box.lower, box.upper, strict=True)
    ]
    grid = np.stack(np.meshgrid(*ticks, indexing="ij"), axis=-1)
    if settings.initial == "staggered":
        to_one_side = box.sides[0] == "periodic"
        grid[:, ::2, ..., 0] += 0.5 * spacing if to_one_side else 0.25 * spacing
        grid[:, 1::2, ..., 0] -= 0.0 if to_one_side else 0.25 * spacing
    positions = grid.reshape(-1, len(box.lower))
    if settings.initial == "relaxed":
        positions = relaxed(positions, box, spacing, settings.seed)
    return positions, spacing


def spacing_of(box: Box, settings: Settings) -> float:
    """The spacing of particles, `resolution` of them along the last axis of a box.

    Raises:
        SphearError: there are more of them in the box than there is memory for.
    """
    across = box.upper[-1] - box.lower[-1]
    extents = [(high - low) / across for low, high in zip(box.lower, box.upper, strict=True)]
    check_size("resolution", settings.resolution, extents)
    return across / settings.resolution


def particles_in(shape: Shape, box: Box, settings: Settings) -> tuple[Array, float]:
    """Particles of a lattice that fill a shape in a box, `resolution` of them along its last axis, and their spacing.

    Raises:
        SphearError: there is no fluid, or particles are asked for that are not on a lattice.
    """
    if settings.initial != "lattice":
        raise SphearError(f"particles around shapes start from initial=lattice, not from initial={settings.initial}")
    spacing = spacing_of(box, settings)
    window = Domain(box.lower, box.upper, box.periodic)
    return fluid_lattice(shape, spacing, window), spacing


def relaxed(positions: Array, box: Box, spacing: float, seed: int) -> Array:
    """Particles that were put at random places near these and then moved down their concentration until they settle.

    They are as disordered as those of a flow, and as evenly spread; walls push them back by mirror particles.
    """
    generator = np.random.default_rng(seed)
    x = positions + JITTER * spacing * generator.uniform(-1.0, 1.0, positions.shape)
    kernel = WendlandC2(1.5 * spacing)
    speed = 1e6  # the drift is limited to half of it: out of reach, and divided out
    shifting = Rates((Shifting(kernel, 1.0, speed, spacing),))
    lower, upper, kinds, _ = box.arrays()
    for _step in range(SETTLING_STEPS):
        entries, _, _ = with_images(_inside(x, box), lower, upper, kinds, kernel.radius, 0.0)
        neighbours = Neighbours(entries, kernel.radius, threads=1)
        volumes = np.full(len(entries), spacing ** positions.shape[1])
        drift = sweep(shifting, neighbours, volume=volumes)[: len(x)]
        x = entries[: len(x)] + SETTLING_RATE * kernel.h * drift / speed
    return _inside(x, box)


def _inside(x: Array, box: Box) -> Array:
    """Particles that went through a wall, reflected."""
    for axis in box.wall_axes:
        low, high = box.lower[axis], box.upper[axis]
        x[:, axis] = np.where(x[:, axis] < low, 2 * low - x[:, axis], x[:, axis])
        x[:, axis] = np.where(x[:, axis] > high, 2 * high - x[:, axis], x[:, axis])
    return x
