"""Sums over pressures with the neighbours that are missing outside a free surface.

Sums that leave them out know nothing of the pressure zero outside: the gradient of differences p_j - p_i drives a
particle on the surface inwards when its pressure rises, a projection with it grows what it should take away. So the
pressure is continued: from the particle linearly to zero on the surface and on,

    p(r) = p_i (1 - n . (r - r_i) / depth_i)

with n the outward normal. The missing neighbours are those of a whole lattice without those that are there, so that
their sums are known from the latter's, and linear pressures, such as hydrostatic ones, are exact.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from sphear.corrections import NoCorrection
from sphear.engine.preparation import Preparation
from sphear.interactions import Gradient
from sphear.interactions.free_surface import LaplacianMoments
from sphear.schemes.incompressible.free_surface import Surface
from sphear.schemes.incompressible.particle_sums import ParticleSums

Array = np.ndarray[Any, Any]

LEAST, MOST = 1.0, 3.0  # times p_i, that it falls to its missing neighbours: to zero; 2.45 on a plane surface


def missing_weights(
    particles: ParticleSums, surface: Surface, moments: LaplacianMoments, preparation: Preparation | None
) -> Array:
    """(N,), the part of the missing neighbours in the diagonal of a Laplacian; not positive.

    The first moment of the weights of a lattice vanishes: summed over those missing, w_ij (p_j - p_i) is
    -|sum_j w_ij (r_j - r_i)| p_i / depth_i of those that are there. In a sheet of one particle these balance: there it
    is at least the missing weights times a spacing, over the depth of half a spacing.

    Args:
        particles: of fluid and walls.
        surface: the surface.
        moments: of the Laplacian.
        preparation: that it needs.
    """
    sums = particles.of(surface.near).sum(moments, preparation)
    share = np.maximum(1.0 / surface.concentration - 1.0, 0.0)
    sheet = np.where(surface.on, 2.0 * surface.depth * sums[:, 0] * share, 0.0)
    first = np.linalg.norm(sums[:, 1:], axis=1)
    result: Array = np.where(surface.near, -np.maximum(first, sheet) / surface.depth, 0.0)
    return result


def surface_gradient(particles: ParticleSums, surface: Surface, pressures: Array) -> Array:
    """(N, d), grad p with the missing neighbours near the surface; elsewhere it means nothing.

        grad p_i = sum_j V_j (p_j - p_i) grad W_ij + k_i p_i sum_j V_j grad W_ij
        k_i = (1 - n . M_i n) / (depth_i |sum_j V_j grad W_ij|),  M_i = sum_j V_j grad W_ij (x) (r_j - r_i)

    The mean fall of the pressure to the missing neighbours, k_i p_i, is limited to p_i and 3 p_i; with 2 p_i it would
    be the symmetric sum of p_j + p_i.

    Args:
        particles: of fluid and walls.
        surface: the surface.
        pressures: (P,), of both.
    """
    count = particles.count
    near = particles.of(surface.near)
    plain = near.sum(Gradient(particles.kernel, NoCorrection(), True), None, values=pressures[:, None])
    short = 1.0 - np.einsum("na,nab,nb->n", surface.inward, surface.moment, surface.inward)
    length = surface.depth * np.linalg.norm(surface.slope, axis=1)
    fall = np.clip(short / np.maximum(length, 1e-300), LEAST, MOST)
    result: Array = plain + (fall * pressures[:count])[:, None] * surface.slope
    return result
