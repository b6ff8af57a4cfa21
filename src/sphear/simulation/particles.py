"""Particles of the fluid at the start of a simulation."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from sphear.boundaries import Box
from sphear.boundaries.shapes import Shape, fluid_lattice
from sphear.checked import numbers, real_array
from sphear.errors import SphearError, quoted
from sphear.neighbours import Domain

Array = np.ndarray[Any, Any]
Velocity = Callable[[Array], Array] | Sequence[float] | Array | None

FITTING = 0.1  # of a spacing by which a row of whole spacings may miss the extent of a box


def lattice(box: Box, shape: Shape | None, spacing: float) -> tuple[Array, float]:
    """A square lattice, half a spacing from the sides of a box, as far as there is fluid; and its mean spacing.

    Along each axis a whole number of particles fits the box: their distances may differ from `spacing` a little.

    Raises:
        SphearError: the box is less than a spacing wide, or there is no fluid.
    """
    if shape is not None:
        _check_periods(box, spacing)
        return fluid_lattice(shape, spacing, Domain(box.lower, box.upper, box.periodic)), spacing
    ticks = []
    for axis, (low, high) in enumerate(zip(box.lower, box.upper, strict=True)):
        count = round((high - low) / spacing)
        if not count:
            raise SphearError(
                f"the region is {high - low:g} wide along {'xyz'[axis]}, less than a spacing of {spacing:g}"
            )
        ticks.append(low + (np.arange(count) + 0.5) * (high - low) / count)
    positions = np.stack(np.meshgrid(*ticks, indexing="ij"), axis=-1).reshape(-1, len(box.lower))
    volume = float(np.prod(np.subtract(box.upper, box.lower)))
    return positions, (volume / len(positions)) ** (1 / len(box.lower))


def _check_periods(box: Box, spacing: float) -> None:
    """Refuse periods that are no whole number of spacings where particles stand around shapes."""
    for axis, (low, high) in enumerate(zip(box.lower, box.upper, strict=True)):
        rows = (high - low) / spacing
        if box.periodic[axis] and abs(rows - round(rows)) > FITTING:
            near = (high - low) / max(1, round(rows))
            raise SphearError(
                f"the period of {high - low:g} along {'xyz'[axis]} is {rows:.4g} spacings: around shapes it is a whole"
                f" number of them, as with a spacing of {near:.6g}"
            )


def initial_velocities(velocity: Velocity, positions: Array) -> Array:
    """The velocities (N, d) of particles at the start.

    Args:
        velocity: one for all, (d,); one each, (N, d); a function of places (N, d); or None at rest.
        positions: (N, d).

    Raises:
        SphearError: it is none of these.
    """
    if velocity is None:
        return np.zeros_like(positions)
    if callable(velocity):
        velocity = velocity(positions.copy())
    elif len(one := numbers(velocity)) == positions.shape[1]:
        return np.tile(np.array(one), (len(positions), 1))
    values = real_array(velocity)
    if values is None or values.shape != positions.shape:
        shape = None if values is None else values.shape
        raise SphearError(
            f"velocities at the start are one for all or of the shape {positions.shape}, one a particle, not"
            f" {quoted(velocity) if shape is None else shape}"
        )
    return np.asarray(values, np.float64)
