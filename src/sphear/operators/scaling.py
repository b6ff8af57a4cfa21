"""Lengths and fields brought to order one by powers of two, so that no unit is too small or large for the sums."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from sphear.errors import SphearError
from sphear.kernels import Kernel
from sphear.neighbours import Neighbours

Array = np.ndarray[Any, Any]

ORDINARY = 1e-30, 1e30  # smoothing lengths for whose powers float64 has room


class TooLargeError(SphearError):
    """Results too large for the precision of the sums."""


def power_of_two(size: float) -> float:
    """The power of two next below a positive number; 1 for zero. Multiplying by it rounds nothing."""
    return float(np.ldexp(1.0, int(np.frexp(size)[1]) - 1)) if size > 0.0 else 1.0


@dataclass(frozen=True)
class ScaledParticles:
    """Kernel, neighbours and volumes with lengths in a unit.

    Attributes:
        unit: in the user's unit of length.
    """

    kernel: Kernel
    neighbours: Neighbours
    volumes: Array
    unit: float

    @classmethod
    def of(cls, kernel: Kernel, neighbours: Neighbours, volumes: Array, precision: str) -> ScaledParticles:
        """In the user's unit where float64 has room for its powers, else in a power of two near h."""
        if precision == "float64" and ORDINARY[0] < kernel.h < ORDINARY[1]:
            return cls(kernel, neighbours, volumes, 1.0)
        unit = power_of_two(kernel.h)
        scaled: Any = replace(kernel, h=kernel.h / unit)
        return cls(scaled, neighbours.scaled(unit), volumes / unit**neighbours.dimension, unit)


@dataclass(frozen=True)
class ScaledField:
    """A field as reference + size x reduced, each column by itself.

    Attributes:
        values: (N, k), reduced.
        reference: (k,), in the midst of the values.
        size: (k,), powers of two.
    """

    values: Array
    reference: Array
    size: Array

    @classmethod
    def of(cls, values: Array, precision: str, *, shifted: bool = True, together: bool = False) -> ScaledField:
        """Reduce a field for sums in single precision; one for sums in double precision stays as it is.

        Args:
            values: (N, k).
            precision: of the sums.
            shifted: subtract the reference, for sums that do not feel a constant.
            together: one size for all columns.
        """
        columns = values.shape[1]
        if precision == "float64" or not values.size:
            return cls(values, np.zeros(columns), np.ones(columns))
        low, high = values.min(axis=0), values.max(axis=0)
        reference = 0.5 * low + 0.5 * high if shifted else np.zeros(columns)
        sizes = np.maximum(np.abs(low - reference), np.abs(high - reference))
        if together:
            sizes[:] = sizes.max()
        size = np.array([power_of_two(x) for x in sizes])
        return cls((values - reference) / size, reference, size)


def unscaled(result: Array, factor: Array | float) -> Array:
    """A result in the user's units, in the precision of the sums.

    Raises:
        SphearError: there are results that this precision cannot hold.
    """
    factor = np.asarray(factor, np.float64)
    if result.dtype == np.float64 and (factor == 1.0).all():
        return _held(result, result)
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        wanted = np.asarray(result, np.float64) * factor
        return _held(wanted, wanted.astype(result.dtype))


def _held(wanted: Array, result: Array) -> Array:
    least = np.finfo(result.dtype).tiny
    largest = float(np.abs(wanted).max(initial=0.0, where=~np.isnan(wanted)))
    too_large = largest > np.finfo(result.dtype).max
    if too_large or 0.0 < largest < least:
        raise (TooLargeError if too_large else SphearError)(
            f"the results, of up to {largest:.3g}, cannot be held in {result.dtype} numbers: take other units"
            f"{', or precision float64' if result.dtype == np.float32 else ''}"
        )
    return result
