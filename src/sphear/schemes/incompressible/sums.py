"""What an incompressible flow sums over neighbours: how it is discretised, and the sums at the places of a moment."""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np

from sphear.corrections import NoCorrection
from sphear.interactions import Gradient
from sphear.interactions.free_surface import Concentration
from sphear.interactions.pressure_gradient import SymmetricGradient
from sphear.interactions.sfdi_gradient import SfdiFit, SfdiGradient
from sphear.kernels import Kernel
from sphear.operators import arguments
from sphear.schemes.incompressible.free_surface import surface, wetted
from sphear.schemes.incompressible.places import Places
from sphear.schemes.incompressible.pressure_level import levelled
from sphear.schemes.incompressible.region import region, walls_of
from sphear.schemes.incompressible.settings import Incompressible
from sphear.schemes.incompressible.surface_pressure import surface_gradient
from sphear.schemes.incompressible.viscous import Viscous
from sphear.schemes.problem import Problem

Array = np.ndarray[Any, Any]


class Discretisation:
    """How the fields of a flow become sums.

    Args:
        problem: what is computed.
        settings: how.
        kernel: with its smoothing length.
        viscous: the viscous acceleration.
        threads: to compute on.

    Attributes:
        region: of fluid; None without walls.
        walls: the wall particles; None without walls.
        domain: with the periodic axes; None without.
        lattice_sum: sum_j V_j W_ij of a lattice.

    Raises:
        SphearError: there is no room for the fluid.
    """

    def __init__(
        self, problem: Problem, settings: Incompressible, kernel: Kernel, viscous: Viscous, threads: int
    ) -> None:
        self.problem, self.kernel, self.viscous, self.threads = problem, kernel, viscous, threads
        self.pressure_form, self.pressure_level = settings.gradient, settings.pressure_level
        self.slips = settings.wall_divergence == "slipping"
        self.correction = arguments.read_correction(settings.gradient_correction, None)
        self.count = len(problem.positions)
        self.region = region(problem)
        self.domain = problem.window if any(problem.periodic) else None
        self.walls = walls_of(problem, settings, kernel, 2 if viscous.of_all else 1)
        self.lattice_sum = self._lattice_sum()

    def _lattice_sum(self) -> float:
        dx, d = self.problem.spacing, self.problem.positions.shape[1]
        reach = int(self.kernel.radius / dx) + 1
        axes = np.meshgrid(*[np.arange(-reach, reach + 1) * dx] * d)
        r2 = sum(axis**2 for axis in axes)
        inside = r2 < self.kernel.radius**2
        return float(np.sum(self.kernel.value(r2[inside], d)) * dx**d)

    def at(self, x: Array, distance: Array | None = None) -> Sums:
        """The sums at the places x (N, d), so far from walls (N,) if that is known."""
        walls, dx = self.walls, self.problem.spacing
        everything = x if walls is None else np.concatenate((x, walls.dummies.positions))
        volume = np.full(len(everything), dx ** x.shape[1])
        if walls is not None:
            volume[self.count : self.count + walls.on_wall] = 0.0  # they have a pressure only
            if self.problem.free_surface:
                fluid = x if self.domain is None else self.domain.with_images(x, walls.reach)[0]
                volume[self.count :] *= wetted(walls.images, fluid, dx)
        places = Places(everything, self.count, self.kernel, volume, self.domain, self.threads)
        if walls is not None and self.region is not None and distance is None:
            distance = self.region.distance(x)
        return Sums(self, places, distance)


class Sums:
    """The sums at the places of a moment.

    Args:
        how: the discretisation.
        places: of the N particles and the W of walls.
        distance: (N,), of the particles from walls; None without walls.

    Attributes:
        rows: what the fluid says of the walls' fields; None without walls.
        surface: the free surface; None of a problem without.
    """

    def __init__(self, how: Discretisation, places: Places, distance: Array | None) -> None:
        self.how, self.places = how, places
        x = places.positions[: how.count]
        self.rows = None if how.walls is None or distance is None else how.walls.rows(x, distance)
        problem = how.problem
        self.surface = surface(places, problem.spacing, how.lattice_sum) if problem.free_surface else None

    def gradient(self, fields: Array) -> Array:
        """(N, k d), of fields (N + W, k), from differences."""
        correction, kernel = self.how.correction, self.how.kernel
        return self.places.sum(Gradient(kernel, correction, True), correction.preparation(kernel), values=fields)

    def slopes(self, fields: Array) -> Array:
        """(N, k d), as `gradient`; without correction where a free surface leaves too few neighbours for it."""
        result = self.gradient(fields)
        if self.surface is None or not self.surface.rough.any():
            return result
        plain = self.places.sum(Gradient(self.how.kernel, NoCorrection(), True), None, values=fields)
        return np.where(self.surface.rough[:, None], plain, result)

    def divergence(self, velocities: Array, later: float = 0.0) -> Array:
        """(N,), of velocities (N + W, d), once particles have moved with them for a time t = `later`.

        A place x is then at x + t u, so that the gradient G becomes G (1 + t G)^-1: tr(G) - t tr(G^2), to second order.
        """
        d = velocities.shape[1]
        slopes = self.slopes(velocities)
        result: Array = slopes[:, :: d + 1].sum(axis=1)
        if later:
            whole = slopes.reshape(-1, d, d)
            result -= later * np.einsum("nab,nba->n", whole, whole)
        return result

    def pressure_gradient(self, pressures: Array) -> Array:
        """(N, d), of pressures (N + W,), in the chosen form; of differences, with the zero outside a surface."""
        found, kernel, form = self.surface, self.how.kernel, self.how.pressure_form
        pressures = levelled(pressures, self.how.pressure_level, self.places.positions[: self.how.count])
        if found is not None:
            pressures = pressures.copy()
            fluid = pressures[: self.how.count]
            fluid[found.on & (fluid < 0.0)] = 0.0  # nothing pulls at a surface
        if form == "symmetric":
            return self.places.sum(SymmetricGradient(kernel), None, values=pressures[:, None])
        if form == "sfdi":
            result = self.places.sum(SfdiGradient(kernel), SfdiFit(kernel), values=pressures[:, None])
        else:
            result = self.gradient(pressures[:, None])
        if found is None:
            return result
        return np.where(found.near[:, None], surface_gradient(self.places, found, pressures), result)

    def pressure_slopes(self, pressures: Array, gradient: Array) -> Array:
        """(N, d), the gradient of pressures (N + W,), of which the symmetric form is none: it is exact for no field."""
        return self.slopes(pressures[:, None]) if self.how.pressure_form == "symmetric" else gradient

    def viscous(self, u: Array) -> Array:
        """(N, d), the viscous acceleration of velocities (N, d)."""
        how = self.how
        here = self._all if how.viscous.of_all and how.walls is not None else self.places
        near = None if self.surface is None else self.surface.near
        return how.viscous.acceleration(here, self.continued(u), how.count, near)

    @cached_property
    def _all(self) -> Places:
        """The places of fluid and walls, all of which have sums."""
        how, here = self.how, self.places
        return Places(here.positions, here.total, how.kernel, here.fields["volume"], how.domain, how.threads)

    def continued(self, u: Array) -> Array:
        """(N + W, d), velocities as the viscous term sees them."""
        walls = self.how.walls
        return u if walls is None or self.rows is None else walls.continued(self.rows, u)

    def divergent(self, u: Array, since: float = 0.0) -> Array:
        """(N + W, d), velocities as the divergence sees them, of particles that were here a time `since` before."""
        return self.slipping(u, since) if self.how.slips else self.continued(u)

    def slipping(self, u: Array, since: float = 0.0) -> Array:
        """(N + W, d), velocities that slip along walls, of particles that were here a time `since` before."""
        walls = self.how.walls
        return u if walls is None or self.rows is None else walls.slipping(self.rows, u, since)

    def ways(self) -> Array:
        """(W, d), from wall particles to where the pressures that are continued to them are from."""
        walls = self.how.walls
        if walls is None or self.rows is None:
            return np.zeros(self.places.positions[:0].shape)
        return walls.ways(self.rows, self.places.positions[: self.how.count])

    def even(self, field: Array) -> Array:
        """(N + W, ...), a field that is the same on both sides of walls."""
        walls = self.how.walls
        return field if walls is None or self.rows is None else walls.even(self.rows, field)

    def concentration(self) -> Array:
        """(N,), the density of particles over that of a lattice."""
        result: Array = self.places.sum(Concentration(self.how.kernel))[:, 0] / self.how.lattice_sum
        return result
