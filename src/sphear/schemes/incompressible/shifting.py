"""Where particles are moved beside the flow, so that they stay evenly spread."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from sphear.algebra import Scalar, Vector, dot, scale, sqrt, where_less
from sphear.interactions import Part, Rates, Shifting
from sphear.kernels import Kernel

Array = np.ndarray[Any, Any]

XU_STRENGTH = 0.04  # C of the source, which takes 0.01 to 0.1
UNEVENNESS = 0.02  # spacings, by which particles leave a line while it is stretched e-fold
LEAST_STRETCHING = 1e-6  # of the expected speed over a spacing: parallel flow stretches by rounding only


@dataclass(frozen=True)
class XuShifting(Part):
    """The drift C U R_i, R_i = sum_j (rbar_i / r_ij)^2 r_ij / r_ij, rbar_i the mean of the r_ij; at most U / 2.

    Xu, Stansby & Laurence 2009, Accuracy and stability in incompressible SPH based on the projection method and a new
    approach, J. Comput. Phys. 228:6703, eqs. 31 to 34, over the time step.

    Args:
        kernel: its support is where neighbours are counted.
        strength: C.
        speed: U, the largest expected.
    """

    kernel: Kernel
    strength: float
    speed: float

    role = "drift"

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> tuple[Vector, Any]:
        """The pair's part of R and of the mean distance."""
        # a particle without volume, on a wall, counts for nothing
        near = where_less(r2, self.kernel.radius**2, other.volume / own.volume, 0.0)
        r = sqrt(r2)
        return tuple(0.0 for _ in d), (scale(near / (r2 * r), d), near * r, near)

    def finish(self, own: Any, sums: Any) -> Vector:
        """The drift, limited."""
        direction, distances, number = sums
        mean = distances / where_less(0.5, number, number, 1.0)
        wanted = scale(self.strength * self.speed * mean * mean, direction)
        size, most = sqrt(dot(wanted, wanted)), 0.5 * self.speed
        return scale(where_less(most, size, most / where_less(most, size, size, 1.0), 1.0), wanted)


def drift(shifting: str, kernel: Kernel, strength: float, speed: float, spacing: float) -> Rates | None:
    """The interaction whose result is the velocity with which particles are shifted; None for none.

    Args:
        shifting: "none", "lind" or "xu".
        kernel: with its smoothing length.
        strength: over that of the sources.
        speed: the largest expected.
        spacing: of the particles.
    """
    if shifting == "none":
        return None
    if shifting == "xu":
        return Rates((XuShifting(kernel, XU_STRENGTH * strength, speed),))
    return Rates((Shifting(kernel, strength, speed, spacing),))


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


def stretching(slopes: Array, least: float) -> Array:
    """(N,), the rate at which a flow stretches its lines, sqrt(tr(G^2) / 2) of slopes G (N, d, d); 0 below `least`.

    It is that of strain without what turns with the fluid (Okubo 1970, Weiss 1991): zero in parallel flow, which
    only shears lines, and in rotation.
    """
    squared = 0.5 * np.einsum("nab,nba->n", slopes, slopes)
    rate: Array = np.where(squared > least**2, np.sqrt(np.maximum(squared, 0.0)), 0.0)
    return rate
