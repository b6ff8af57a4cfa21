"""The displacement of particles beside the flow, so that they stay evenly spread."""

from __future__ import annotations

from typing import Any

import numpy as np

from sphear.interactions import Rates
from sphear.kernels import Kernel
from sphear.schemes.incompressible.differential_operators import DifferentialOperators
from sphear.schemes.incompressible.free_surface import along_surface
from sphear.schemes.incompressible.slopes import add_scaled, changes, squared_traces
from sphear.schemes.problem import Problem
from sphear.shifting import ShiftingMethod

Array = np.ndarray[Any, Any]

UNEVENNESS = 0.02  # spacings, by which particles leave a line while it is stretched e-fold
LEAST_STRETCHING = 1e-6  # of the expected speed over a spacing: parallel flow stretches by rounding only


class Displacement:
    """Shifts the particles of a flow by a method's drift, and off lines that the flow stretches.

    Args:
        method: of shifting.
        problem: what is computed.
        kernel: with its smoothing length.
        seed: of the random vectors.
    """

    def __init__(self, method: ShiftingMethod, problem: Problem, kernel: Kernel, seed: int) -> None:
        drift = method.drift(kernel, problem.speed, problem.spacing)
        self.drift = None if drift is None else Rates((drift,))
        self.least = LEAST_STRETCHING * problem.speed / problem.spacing
        self.uneven = unevenness(len(problem.positions), problem.positions.shape[1], problem.spacing, seed)

    def of(self, operators: DifferentialOperators, velocities: Array, step: float, moved: float) -> tuple[Array, Array]:
        """The displacement (N, d) of a step, and what moving by it changes in the velocities (N, d).

        Args:
            operators: where forces act.
            velocities: (N, d), after the step.
            step: dt.
            moved: for how long particles move with them from there.
        """
        if self.drift is None:
            return np.zeros_like(velocities), np.zeros_like(velocities)
        # not of `continued`, whose walls hold the fluid: corrected by those, particles before a lid run away
        slopes = operators.slopes(operators.slipping(velocities, moved))
        shift = step * operators.particles.sum(self.drift)
        add_scaled(shift, step * stretching(slopes, velocities.shape[1], self.least), self.uneven)
        shift = shift if operators.surface is None else along_surface(shift, operators.surface)
        return shift, changes(slopes, shift)


def unevenness(count: int, dimension: int, spacing: float, seed: int) -> Array:
    """(count, d), where each particle is moved while the flow stretches its neighbourhood e-fold: a random vector.

    A line of particles that a flow stretches, as that through a stagnation point from a lattice, is symmetric: its
    concentration has no gradient, shifting leaves it as it is, and gaps grow until gradients break down. The least
    unevenness is enough for shifting to bring particles into the gaps from both sides.

    Args:
        count: of the particles.
        dimension: d.
        spacing: of the particles.
        seed: of the random vectors.
    """
    vectors: Array = np.random.default_rng(seed).uniform(-1.0, 1.0, (count, dimension))
    return UNEVENNESS * spacing * vectors


def stretching(slopes: Array, dimension: int, least: float) -> Array:
    """(N,), the rate at which a flow stretches its lines, sqrt(tr(G^2) / 2) of slopes G (N, d d); 0 below `least`.

    It is that of strain without what turns with the fluid (Okubo 1970, Weiss 1991): zero in parallel flow, which
    only shears lines, and in rotation.
    """
    squared = 0.5 * squared_traces(slopes, dimension)
    rate: Array = np.where(squared > least**2, np.sqrt(np.maximum(squared, 0.0)), 0.0)
    return rate
