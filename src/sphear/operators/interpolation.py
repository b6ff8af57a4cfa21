"""Fields at points: sums over the particles within the support, and what a correction makes of them."""

from __future__ import annotations

from typing import Any

import numpy as np

from sphear.corrections import Correction, MovingLeastSquares
from sphear.engine.sweep import sweep
from sphear.errors import SphearError
from sphear.interactions import Interpolation
from sphear.interactions.interpolation import LinearFitSums
from sphear.neighbours import Neighbours
from sphear.operators.particles import Fallback, Particles, too_few_neighbours
from sphear.operators.scaling import ScaledField, ScaledParticles, unscaled

Array = np.ndarray[Any, Any]

LEAST_SPREAD = 1e-4  # of the particles around a point across their line or plane, over h^2: less gives no slope


def interpolated(
    particles: Particles,
    neighbours: Neighbours,
    points: Array,
    values: Array,
    correction: Correction,
    fallback: Fallback | None,
) -> Array:
    """The values at points, (M, k); NaN where a corrected one is asked for and no particle is near.

    Args:
        particles: that carry the field.
        neighbours: of the points.
        points: (M, d).
        values: (N, k).
        correction: of the values.
        fallback: where too few are near for a plane: the uncorrected sum, NaN, or None to refuse.
    """
    if fallback not in (None, "uncorrected", "nan"):
        raise SphearError(f"fallback must be 'uncorrected' or 'nan', not {fallback!r}")
    units = ScaledParticles.of(particles.kernel, neighbours, particles.volumes, particles.precision)
    field = ScaledField.of(values, particles.precision)
    if isinstance(correction, MovingLeastSquares):
        reduced, lacking = _planes(units, field.values, particles.precision)
        if len(lacking) and fallback is None:
            what = f"correction {correction.name!r}"
            raise too_few_neighbours(lacking, points, what, f"is point {lacking[0]} at", "h", of="points")
        particles.check_isolated(fallback)
    else:
        particles.check_isolated(fallback)
        sums = _sums(Interpolation(units.kernel), units, field.values, particles.precision)
        one = sums[:, -1:]
        if not correction.zeroth_order:
            return unscaled(sums[:, :-1] * field.size + one * field.reference, 1.0).astype(particles.precision)
        with np.errstate(invalid="ignore", divide="ignore"):
            reduced, lacking = np.where(one > 0, sums[:, :-1] / one, np.nan), np.empty(0, np.int64)
    result = reduced * field.size + field.reference
    if len(lacking):
        result[lacking] = np.nan
        if fallback == "uncorrected":
            sums = _sums(Interpolation(units.kernel), units, field.values, particles.precision)[lacking]
            result[lacking] = sums[:, :-1] * field.size + sums[:, -1:] * field.reference
    return unscaled(result, 1.0).astype(particles.precision, copy=False)


def _sums(interaction: Any, units: ScaledParticles, values: Array, precision: str) -> Array:
    found = sweep(interaction, units.neighbours, dtype=precision, values=values, volume=units.volumes)
    return found.astype(np.float64, copy=False)


def _planes(units: ScaledParticles, values: Array, precision: str) -> tuple[Array, Array]:
    """The values of the planes of best fit, and the points that have particles near but too few for a plane."""
    dimension, columns = units.neighbours.dimension, values.shape[1]
    sums = _sums(LinearFitSums(units.kernel), units, values, precision)
    upper = np.triu_indices(dimension)
    ends = np.cumsum((1, dimension, columns, len(upper[0])))
    one, y, f, squares, mixed = np.split(sums, ends, axis=1)
    near = one[:, 0] > 0.0
    weight = np.where(near[:, None], one, 1.0)
    y, f = y / weight, f / weight  # the centre of the particles, and the mean of their values
    spread = np.empty((len(sums), dimension, dimension))
    spread[:, upper[0], upper[1]] = spread[:, upper[1], upper[0]] = squares / weight
    spread -= y[:, :, None] * y[:, None, :]
    slopes = mixed.reshape(-1, dimension, columns) / weight[:, :, None] - y[:, :, None] * f[:, None, :]
    lacking = near & ~(np.linalg.eigvalsh(spread)[:, 0] > LEAST_SPREAD)
    spread[~near | lacking] = np.eye(dimension)
    plane = f - np.einsum("ia,iak->ik", y, np.linalg.solve(spread, slopes))
    plane[~near] = np.nan
    return plane, np.flatnonzero(lacking)
