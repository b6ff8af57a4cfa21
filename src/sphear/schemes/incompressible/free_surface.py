"""The free surface of a fluid: which particles lie on it and near it."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from scipy.spatial import cKDTree

from sphear.corrections import NoCorrection
from sphear.errors import SphearError
from sphear.interactions.free_surface import ConcentrationMoments, Umbrella
from sphear.kernels import Kernel
from sphear.schemes.incompressible.particle_sums import ParticleSums
from sphear.schemes.incompressible.settings import Incompressible
from sphear.schemes.objects import text
from sphear.viscosity.base import LaplacianTerm

Array = np.ndarray[Any, Any]

INNER, SPRAY = 0.97, 0.6  # of a lattice's concentration: above, a particle is inside; below, on the surface
LENGTH = 1.33  # spacings, of the umbrella
NOTHING = 1e-9  # of the concentration
ROUGH = 0.4  # least eigenvalue of the first moment: it is 1 inside, 0.5 on a plane surface, 0.24 at its corner
WET, DRY = 0.7, 1.0  # spacings from a particle: up to there a point is in the fluid, from there outside


class Surface(NamedTuple):
    """The particles on the free surface and near it.

    on: (N,), the outermost particles.
    near: (N,), with a neighbour on it, themselves included.
    alone: (N,), without any neighbour, in free flight.
    rough: (N,), near it and with too few neighbours for corrected gradients.
    concentration: (N,), over that of a lattice.
    slope: (N, d), of the concentration: into the fluid.
    inward: (N, d), unit vectors along it.
    moment: (N, d, d), sum_j V_j grad W_ij (x) (r_j - r_i).
    depth: (N,), of particles near it, below the place where the pressure is zero: that is half a spacing outside the
        outermost particles.
    """

    on: Array
    near: Array
    alone: Array
    rough: Array
    concentration: Array
    slope: Array
    inward: Array
    moment: Array
    depth: Array


def check_surface_settings(settings: Incompressible, laplacian: LaplacianTerm, kernel: Kernel) -> None:
    """Refuse what does not go with a free surface.

    Raises:
        SphearError: a level of the pressure is chosen; a wall condition needs fluid before every wall, or cannot carry
            weight; a Laplacian is corrected by neighbours on all sides.
    """
    if settings.pressure_level != "free":
        raise SphearError(
            f"a free surface fixes the level of the pressure: take pressure_level=free, not {settings.pressure_level}"
        )
    if why := settings.wall_model.surface_fault:
        raise SphearError(f"walls={text(settings.walls)} {why}: with a free surface take mirror_points or adami")
    if laplacian.preparation(kernel, NoCorrection()) is not None:
        raise SphearError(
            f"the setting laplacian={text(settings.laplacian)} needs neighbours on all sides: with a free surface take"
            " one without correction, such as morris"
        )


def surface(particles: ParticleSums, spacing: float, lattice_sum: float) -> Surface:
    """The free surface, by the particles' concentration and by who lies under their umbrella against the outside.

    Zheng, Ma & Shao (2018), section 2, combine the particle number density with auxiliary functions of the neighbours'
    places; the function here is the umbrella of Marrone et al. (2010). A particle is on the surface if its
    concentration is below 0.97 of a lattice's and nobody is under its umbrella, or if it is below 0.6: spray. Wall
    particles that are wetted count as neighbours, so that a wall is no surface.

    Args:
        particles: of fluid and walls.
        spacing: of the particles.
        lattice_sum: the concentration of a lattice.
    """
    kernel, count, dimension = particles.kernel, particles.count, particles.positions.shape[1]
    sums = particles.sum(ConcentrationMoments(kernel))
    total, slope, moment = sums[:, 0], sums[:, 1 : dimension + 1], sums[:, dimension + 1 :]
    moment = moment.reshape(count, dimension, dimension)
    concentration = total / lattice_sum
    inward = slope / np.maximum(np.linalg.norm(slope, axis=1, keepdims=True), 1e-300)
    normals = np.zeros((particles.total, dimension))
    normals[:count] = inward
    thin = concentration < INNER
    under = particles.of(thin).sum(Umbrella(kernel, LENGTH * spacing), None, inward=normals)[:, 0]
    on = (thin & (under < 0.5)) | (concentration < SPRAY)
    near = _with_neighbours(particles, on)
    alone = total - particles.fields["volume"][:count] * kernel.value_at_zero(dimension) < NOTHING
    rough = near.copy()
    rough[near] = np.linalg.eigvalsh(moment[near])[:, 0] < ROUGH
    return Surface(on, near, alone, rough, concentration, slope, inward, moment, _depth(particles, on, near, spacing))


def _with_neighbours(particles: ParticleSums, chosen: Array) -> Array:
    """(N,), True for the chosen particles (N,) and those that have one of them as a neighbour."""
    found, listed = chosen.copy(), particles.neighbours.of(chosen)
    for chunk in listed.chunks:
        neighbours = listed.source[chunk.neighbour[: chunk.pairs]]
        found[neighbours[neighbours < particles.count]] = True
    return found


def _depth(particles: ParticleSums, on: Array, near: Array, spacing: float) -> Array:
    """(N,), half a spacing and the distance from the next particle on the surface."""
    depth = np.full(particles.count, 0.5 * spacing)
    inner = np.flatnonzero(near & ~on)
    if len(inner):
        outermost, others = particles.positions[: particles.count][on], particles.positions[inner]
        if particles.domain is not None:
            outermost = particles.domain.with_images(outermost, particles.kernel.radius)[0]
            others = particles.domain.wrapped(others)
        depth[inner] += cKDTree(outermost).query(others)[0]
    return depth


def wetted(points: Array, fluid: Array, spacing: float) -> Array:
    """(W,), the share of points that is in the fluid, from 0, a spacing from the nearest particle, to 1, at 0.7.

    A wall particle whose mirror point is outside the fluid stands for no fluid, and nobody may count it.

    Args:
        points: (W, d), mirror points.
        fluid: (any, d), the particles near them, and their images.
        spacing: of the particles.
    """
    if not len(fluid):
        return np.zeros(len(points))
    distance = np.asarray(cKDTree(fluid).query(points, distance_upper_bound=DRY * spacing)[0]) / spacing
    result: Array = np.clip((DRY - distance) / (DRY - WET), 0.0, 1.0)
    return result


def along_surface(shift: Array, free_surface: Surface) -> Array:
    """Shifts (N, d) without their part across the surface near it, and none on it (Lind et al. 2012)."""
    across = (shift * free_surface.inward).sum(axis=1, keepdims=True) * free_surface.inward
    result = np.where(free_surface.near[:, None], shift - across, shift)
    result[free_surface.on] = 0.0
    return result
