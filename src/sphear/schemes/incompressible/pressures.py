"""The pressure of a step: its source, the solve, and its values behind walls."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from sphear.corrections import NoCorrection
from sphear.errors import SphearError
from sphear.kernels import Kernel
from sphear.operators import arguments
from sphear.pressure import read_preconditioner, solve
from sphear.schemes.incompressible.differential_operators import DifferentialOperators
from sphear.schemes.incompressible.free_surface import check_surface_settings
from sphear.schemes.incompressible.pressure_equation import PressureAssembly, PressureEquation
from sphear.schemes.incompressible.settings import Incompressible
from sphear.schemes.incompressible.walls import Walls
from sphear.schemes.problem import Problem
from sphear.viscosity.base import LaplacianTerm

Array = np.ndarray[Any, Any]

ROUNDED = 1e-13  # of the terms that a source is summed from, what rounding leaves where they cancel


def pressure_laplacian(problem: Problem, settings: Incompressible, kernel: Kernel) -> LaplacianTerm:
    """The viscous term whose Laplacian the pressure equation has.

    Raises:
        SphearError: it is none, or does not go with a free surface.
    """
    laplacian, plain = arguments.read_viscosity(settings.laplacian), NoCorrection()
    if (
        not isinstance(laplacian, LaplacianTerm)
        or len(laplacian.laplacian_stages(kernel, plain)) > 1
        or not laplacian.of_differences(plain)
    ):
        raise SphearError(
            "the setting laplacian must be a viscous term that is the Laplacian of each component, in one sum of"
            f" differences, not {laplacian.name!r}"
        )
    if problem.free_surface:
        check_surface_settings(settings, laplacian, kernel)
    return laplacian


class Pressures:
    """The pressure, kept as the next step's first guess.

    Args:
        problem: what is computed.
        settings: of the scheme.
        kernel: with its smoothing length.
        walls: the wall particles; None without walls.
        alpha: share of the density in the source.

    Attributes:
        fluid: (N,).
        on_walls: (S,), of particles on walls that have one of their own.
        iterations, residual: of the last solve.

    Raises:
        SphearError: the Laplacian cannot be that of a pressure, or there is no such preconditioner here.
    """

    def __init__(
        self, problem: Problem, settings: Incompressible, kernel: Kernel, walls: Walls | None, alpha: float
    ) -> None:
        laplacian = pressure_laplacian(problem, settings, kernel)
        self.preconditioner = read_preconditioner(settings.preconditioner)
        self.preconditioner.check()
        self.density, self.spacing = problem.density, problem.spacing
        self.alpha, self.tolerance = alpha, settings.tolerance
        self.walls = walls
        self.assembly = PressureAssembly(laplacian, kernel, walls, problem.box, problem.spacing)
        self.fluid = np.zeros(len(problem.positions))
        self.on_walls = np.zeros(self.assembly.on_wall)
        self.iterations, self.residual = 0, 0.0

    def solve(
        self,
        operators: DifferentialOperators,
        velocities: Array,
        accelerations: Array,
        time_step: float,
        later: float = 0.0,
    ) -> Array:
        """(N + W,), the pressure that frees velocities of divergence and particles of crowding.

        Args:
            operators: at the places of the projection.
            velocities: (N + W, d), predicted.
            accelerations: (W, d), that the pressure balances at walls.
            time_step: of the step.
            later: for how long particles then move with the new velocities, until these are free of divergence.

        Raises:
            SphearError: there is no solution, or none was found.
        """
        if self.walls is not None:  # what turns a wall turns the fluid at it, by the pressure
            accelerations = accelerations - 2.0 * later / time_step * self.walls.accelerations
        source, free_surface = self._source(operators, velocities, time_step, later), operators.surface
        if free_surface is not None:
            source[free_surface.alone] = 0.0
        jump = self.assembly.jump(accelerations, self.density, operators.way())
        equation = self.assembly.equation(operators.particles, operators.interpolation, jump, free_surface)
        right = np.concatenate((source[equation.order], self.wall_source(accelerations))) - equation.rows.jump_terms
        guess = np.concatenate((self.fluid[equation.order], self.on_walls))
        floor = self._rounding(operators, velocities, accelerations, time_step) * math.sqrt(len(right))
        solution = solve(equation.system, right, guess, self.preconditioner, self.tolerance, floor=floor)
        self.iterations, self.residual = solution.iterations, solution.residual
        self.keep(equation, solution.values)
        return self.with_walls(operators, self.fluid, self.on_walls, jump)

    def keep(self, equation: PressureEquation, values: Array) -> None:
        """Keep the solution of an equation, in its order."""
        count = len(self.fluid)
        self.fluid = np.empty(count)
        self.fluid[equation.order] = values[:count]
        self.on_walls = values[count:]

    def _source(self, operators: DifferentialOperators, velocities: Array, step: float, later: float) -> Array:
        """(N,), (1 - alpha) rho div u / dt - alpha (rho_particles - rho) / dt^2."""
        source = (1.0 - self.alpha) * self.density * operators.divergence(velocities, later) / step
        if self.alpha:
            source -= self.alpha * self.density * self.crowding(operators) / step / step
        return source

    def crowding(self, operators: DifferentialOperators) -> Array:
        """(N,), (rho_particles - rho) / rho that the pressure relieves."""
        crowding = operators.concentration() - 1.0
        if operators.surface is not None:  # a neighbourhood that ends at the surface is not thin
            near = operators.surface.near
            crowding[near] = np.maximum(crowding[near], 0.0)
        if self.assembly.on_wall:  # whose rows have no density: what is even cannot be relieved, so it drives nothing
            crowding -= crowding.mean()
        return crowding

    def _rounding(
        self, operators: DifferentialOperators, velocities: Array, accelerations: Array, step: float
    ) -> float:
        """The size of a source that is nothing but rounding of its terms, on a particle.

        Where a flow is at rest, uniform or parallel these cancel, and what is left is judged by their own sizes: places
        over the smoothing length, which the density knows, and velocities over it, those that walls balance included.
        """
        h = operators.discretisation.kernel.h
        speed = np.abs(velocities).max(initial=0.0) + step * np.abs(accelerations).max(initial=0.0)
        place = 1.0 + np.abs(operators.particles.positions).max(initial=0.0) / h
        rate = speed / h + self.alpha * place / step
        return float(ROUNDED * self.density * rate / step)

    def wall_source(self, accelerations: Array) -> Array:
        """(S,), n . grad p = rho n . a over the spacing, at particles on walls that have a pressure of their own."""
        on, walls = self.assembly.on_wall, self.walls
        if not on or walls is None:
            return np.zeros(0)
        slope = np.einsum("wd,wd->w", accelerations[:on], walls.normals[:on])
        result: Array = self.density * slope / self.spacing
        return result

    def with_walls(self, operators: DifferentialOperators, fluid: Array, on_walls: Array, jump: Array) -> Array:
        """(N + W,), the pressure of the fluid (N,) and of wall particles, those on walls having their own (S,)."""
        walls, interpolation = self.walls, operators.interpolation
        if walls is None or interpolation is None:
            return fluid
        behind = walls.model.pressures_behind(walls, interpolation, fluid, on_walls, jump)
        return np.concatenate((fluid, behind))
