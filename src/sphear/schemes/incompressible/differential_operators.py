"""Differential operators on the particles of an incompressible flow and its walls at one moment."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from sphear.corrections import NoCorrection
from sphear.interactions import Gradient
from sphear.interactions.concentration import Concentration
from sphear.interactions.pressure_gradient import SymmetricGradient
from sphear.interactions.sfdi_gradient import SfdiFit, SfdiGradient
from sphear.schemes.incompressible.free_surface import surface
from sphear.schemes.incompressible.particle_sums import ParticleSums
from sphear.schemes.incompressible.pressure_level import levelled
from sphear.schemes.incompressible.slopes import squared_traces, traces
from sphear.schemes.incompressible.surface_pressure import surface_gradient

if TYPE_CHECKING:
    from sphear.schemes.incompressible.discretisation import Discretisation

Array = np.ndarray[Any, Any]


class DifferentialOperators:
    """Gradient, divergence and viscous acceleration as sums over the neighbours of particles at one moment.

    Args:
        discretisation: of the flow.
        particles: the N of the fluid and the W of walls.
        distance: (N,), of the fluid's from walls; None without walls.

    Attributes:
        interpolation: the fields of wall particles from the fluid; None without walls.
        surface: the free surface; None of a problem without.
    """

    def __init__(self, discretisation: Discretisation, particles: ParticleSums, distance: Array | None) -> None:
        self.discretisation, self.particles = discretisation, particles
        x = particles.positions[: discretisation.count]
        problem, walls = discretisation.problem, discretisation.walls
        self.interpolation = None if walls is None or distance is None else walls.interpolation(x, distance)
        self.surface = surface(particles, problem.spacing, discretisation.lattice_sum) if problem.free_surface else None

    def gradient(self, fields: Array) -> Array:
        """(N, k d), of fields (N + W, k), from differences."""
        correction, kernel = self.discretisation.correction, self.discretisation.kernel
        return self.particles.sum(Gradient(kernel, correction, True), correction.preparation(kernel), values=fields)

    def slopes(self, fields: Array) -> Array:
        """(N, k d), as `gradient`; without correction where a free surface leaves too few neighbours for it."""
        result = self.gradient(fields)
        if self.surface is None or not self.surface.rough.any():
            return result
        rough = self.particles.of(self.surface.rough)
        plain = rough.sum(Gradient(self.discretisation.kernel, NoCorrection(), True), None, values=fields)
        return np.where(self.surface.rough[:, None], plain, result)

    def divergence(self, velocities: Array, later: float = 0.0) -> Array:
        """(N,), of velocities (N + W, d), once particles have moved with them for a time t = `later`.

        What is at x is then at x + t u, so that the gradient G becomes G (1 + t G)^-1: tr(G) - t tr(G^2), to second
        order.
        """
        d = velocities.shape[1]
        slopes = self.slopes(velocities)
        result = traces(slopes, d)
        if later:
            result -= later * squared_traces(slopes, d)
        return result

    def pressure_gradient(self, pressures: Array) -> Array:
        """(N, d), of pressures (N + W,), in the chosen form; of differences, with the zero outside a surface."""
        free_surface, kernel, count = self.surface, self.discretisation.kernel, self.discretisation.count
        form, level = self.discretisation.pressure_form, self.discretisation.pressure_level
        pressures = levelled(pressures, level, self.particles.positions[:count])
        if free_surface is not None:
            pressures = pressures.copy()
            fluid = pressures[:count]
            fluid[free_surface.on & (fluid < 0.0)] = 0.0  # nothing pulls at a surface
        if form == "symmetric":
            return self.particles.sum(SymmetricGradient(kernel), None, values=pressures[:, None])
        if form == "sfdi":
            result = self.particles.sum(SfdiGradient(kernel), SfdiFit(kernel), values=pressures[:, None])
        else:
            result = self.gradient(pressures[:, None])
        if free_surface is None:
            return result
        return np.where(free_surface.near[:, None], surface_gradient(self.particles, free_surface, pressures), result)

    def pressure_slopes(self, pressures: Array, gradient: Array) -> Array:
        """(N, d), the gradient of pressures (N + W,), of which the symmetric form is none: it is exact for no field."""
        return self.slopes(pressures[:, None]) if self.discretisation.pressure_form == "symmetric" else gradient

    def viscous(self, u: Array) -> Array:
        """(N, d), the viscous acceleration of velocities (N, d)."""
        discretisation = self.discretisation
        here = self._all if discretisation.viscous.of_all and discretisation.walls is not None else self.particles
        near = None if self.surface is None else self.surface.near
        return discretisation.viscous.acceleration(here, self.continued(u), discretisation.count, near)

    @cached_property
    def _all(self) -> ParticleSums:
        """The particles of fluid and walls, all of which have sums."""
        here, volume = self.particles, self.particles.volume
        domain, threads = self.discretisation.domain, self.discretisation.threads
        return ParticleSums(here.positions, here.total, here.kernel, volume, domain, threads)

    def continued(self, u: Array) -> Array:
        """(N + W, d), velocities as the viscous term sees them."""
        walls = self.discretisation.walls
        return u if walls is None or self.interpolation is None else walls.continued(self.interpolation, u)

    def divergent(self, u: Array, since: float = 0.0) -> Array:
        """(N + W, d), velocities as the divergence sees them, of particles that were here a time `since` before."""
        return self.slipping(u, since) if self.discretisation.slips else self.continued(u)

    def slipping(self, u: Array, since: float = 0.0) -> Array:
        """(N + W, d), velocities that slip along walls, of particles that were here a time `since` before."""
        walls = self.discretisation.walls
        return u if walls is None or self.interpolation is None else walls.slipping(self.interpolation, u, since)

    def way(self) -> Array:
        """(W, d), from wall particles to where the pressures that are continued to them are from."""
        walls = self.discretisation.walls
        if walls is None or self.interpolation is None:
            return np.zeros(self.particles.positions[:0].shape)
        return walls.model.way(walls, self.interpolation, self.particles.positions[: self.discretisation.count])

    def even(self, field: Array) -> Array:
        """(N + W, ...), a field that is the same on both sides of walls."""
        walls = self.discretisation.walls
        return field if walls is None or self.interpolation is None else walls.even(self.interpolation, field)

    def concentration(self) -> Array:
        """(N,), the density of particles over that of a lattice."""
        if self.surface is not None:
            return self.surface.concentration
        total: Array = self.particles.sum(Concentration(self.discretisation.kernel))[:, 0]
        return total / self.discretisation.lattice_sum
