"""The discretisation of an incompressible flow: its walls, and the differential operators on its particles."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from sphear.kernels import Kernel
from sphear.operators import arguments
from sphear.schemes.incompressible.differential_operators import DifferentialOperators
from sphear.schemes.incompressible.particle_sums import ParticleSums
from sphear.schemes.incompressible.region import region, walls_of
from sphear.schemes.incompressible.settings import Incompressible
from sphear.schemes.incompressible.viscous import Viscous
from sphear.schemes.problem import Problem

Array = np.ndarray[Any, Any]


class Discretisation:
    """Turns the fields of a flow into sums over neighbours.

    Args:
        problem: what is computed.
        settings: of the scheme.
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
        self.slips = settings.wall_model.divergence == "slipping"
        self.correction = arguments.read_correction(settings.gradient_correction, None)
        self.count = len(problem.positions)
        self.region = region(problem)
        self.domain = problem.window if any(problem.periodic) else None
        self.walls = walls_of(problem, settings, kernel, 2 if viscous.of_all else 1, threads)
        self.lattice_sum = self._lattice_sum()

    def _lattice_sum(self) -> float:
        dx, d = self.problem.spacing, self.problem.positions.shape[1]
        reach = int(self.kernel.radius / dx) + 1
        axes = np.meshgrid(*[np.arange(-reach, reach + 1) * dx] * d)
        r2 = sum(axis**2 for axis in axes)
        inside = r2 < self.kernel.radius**2
        return float(np.sum(self.kernel.value(r2[inside], d)) * dx**d)

    def at(self, x: Array, distance: Array | None = None, together: Sequence[Any] = ()) -> DifferentialOperators:
        """The operators on particles.

        Args:
            x: (N, d), where they are.
            distance: (N,), from walls, if that is known.
            together: sums over places and volumes that will all be asked for, see `ParticleSums`.
        """
        if self.region is not None and distance is None:
            distance = self.region.distance(x)
        return DifferentialOperators(self, self.particles(x, distance, together), distance)

    def particles(self, x: Array, distance: Array | None, together: Sequence[Any] = ()) -> ParticleSums:
        """The particles of fluid and walls; arguments as for `at`, the distance known if there are walls."""
        walls, dx = self.walls, self.problem.spacing
        everything = x if walls is None else np.concatenate((x, walls.dummies.positions))
        volume: Array | float = dx ** x.shape[1]
        if self.problem.free_surface or (walls is not None and walls.on_wall):
            volume = np.full(len(everything), volume)
        if walls is not None and isinstance(volume, np.ndarray):
            volume[self.count : self.count + walls.on_wall] = 0.0  # they have a pressure only
            if self.problem.free_surface and distance is not None:
                volume[self.count :] *= walls.wetted(x, distance)
        return ParticleSums(everything, self.count, self.kernel, volume, self.domain, self.threads, together=together)
