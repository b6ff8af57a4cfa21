"""The equation of velocity and pressure of one step whose viscosity is implicit."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from sphear.errors import SphearError
from sphear.pressure.flexible import flexible_gmres
from sphear.pressure.vectors import norm
from sphear.schemes.incompressible import viscous
from sphear.schemes.incompressible.block_preconditioner import BlockPreconditioner
from sphear.schemes.incompressible.differential_operators import DifferentialOperators
from sphear.schemes.incompressible.pressure_equation import PressureEquation
from sphear.schemes.incompressible.slopes import squared_traces

if TYPE_CHECKING:
    from sphear.schemes.incompressible.coupled import Coupled

Array = np.ndarray[Any, Any]


class StepInputs(NamedTuple):
    """The velocities, forces and shares that a step is made with.

    velocities: (N, d), at its start.
    force: (d,) or (N, d), on a unit of mass.
    length: dt.
    share: of the viscosity at its end.
    moved: since when particles moved before forces act, and for how long they move with the new velocity.
    """

    velocities: Array
    force: Array
    length: float
    share: float
    moved: float


class CoupledStep:
    """The equation of one step; velocities and pressures are one vector, as speeds.

    Args:
        solver: of such steps.
        operators: at the places where forces act.
        step: its velocities, forces and shares.
    """

    def __init__(self, solver: Coupled, operators: DifferentialOperators, step: StepInputs) -> None:
        self.solver, self.operators, self.step = solver, operators, step
        pressures, self.h = solver.pressures, operators.discretisation.kernel.h
        self.density = pressures.density
        self.tau = min(step.length, solver.limit)
        self.kept = self.tau / step.length
        self.unit = self.density * self.h / self.tau  # of pressures
        assembly = pressures.assembly
        still = np.zeros((operators.particles.total - operators.discretisation.count, step.velocities.shape[1]))
        nothing = assembly.jump(still, self.density, operators.way())
        self.equation: PressureEquation = assembly.equation(operators.particles, operators.interpolation, nothing, None)
        self.coupling = assembly.wall_coupling(self.equation)
        self.precondition = BlockPreconditioner(self)
        u = step.velocities
        self.before = (1.0 - step.share) * operators.viscous(u) + step.force
        self.start = operators.divergent(u, -step.moved)
        self.still = operators.divergent(np.zeros_like(u))
        self.source = solver.relief * pressures.crowding(operators)
        if step.moved:
            slopes = operators.slopes(self.start)
            self.source = self.source + step.moved * squared_traces(slopes, u.shape[1])

    def solve(self) -> tuple[Array, Array]:
        """Velocities (N, d) and the gradient (N, d) of the pressure, which is kept.

        Raises:
            SphearError: the solution did not converge.
        """
        pressures, u = self.solver.pressures, self.step.velocities
        guess = np.concatenate((u.ravel(), self._packed(pressures.fluid, pressures.on_walls) / self.unit))
        constant = self.residual(np.zeros_like(guess))
        scale = norm(constant) or 1.0
        floor = viscous.TOLERANCE * scale

        def times(z: Array) -> Array:
            result: Array = (self.residual(scale * z) - constant) / scale
            return result

        run = flexible_gmres(
            times, -constant / scale, guess / scale, self.precondition, viscous.TOLERANCE, viscous.MOST
        )
        solution = scale * run.values
        residual = norm(self.residual(solution))
        if not residual <= viscous.DRIFT * floor:
            raise SphearError(
                f"the implicit viscous step was not solved: after {run.iterations} iterations its relative residual is"
                f" {residual / scale:.2g} where {viscous.TOLERANCE:g} is asked for; take a smaller time step"
            )
        w, p = self._parts(solution)
        pressures.iterations, pressures.residual = run.iterations, residual / scale
        pressures.keep(self.equation, p)
        jump = self._jump(self._even(w))
        values = pressures.with_walls(self.operators, pressures.fluid, pressures.on_walls, jump)
        return w, self.operators.pressure_slopes(values, self.operators.pressure_gradient(values))

    def _packed(self, fluid: Array, on_walls: Array) -> Array:
        return np.concatenate((fluid[self.equation.order], on_walls))

    def _parts(self, z: Array) -> tuple[Array, Array]:
        """Velocities (N, d), and pressures in the order of their equation."""
        shape = self.step.velocities.shape
        size = shape[0] * shape[1]
        p = self.unit * z[size:]
        if self.equation.system.singular:
            p = p - p.mean()
        return z[:size].reshape(shape), p

    def _even(self, w: Array) -> Array:
        """(N + W, d), the acceleration by viscosity and forces, the same on both sides of walls."""
        return self.operators.even(self.step.share * self.operators.viscous(w) + self.before)

    def _jump(self, even: Array) -> Array:
        pressures, operators = self.solver.pressures, self.operators
        walls, count = pressures.walls, operators.discretisation.count
        at_walls = even[count:]
        if walls is not None:
            at_walls = at_walls - 2.0 * self.step.moved / self.step.length * walls.accelerations
        return pressures.assembly.jump(at_walls, self.density, operators.way())

    def residual(self, z: Array) -> Array:
        """The errors of both equations, as speeds."""
        step, operators, kept, pressures = self.step, self.operators, self.kept, self.solver.pressures
        w, p = self._parts(z)
        even = self._even(w)
        count = len(w)
        jump = self._jump(even)
        fluid = np.empty(count)
        fluid[self.equation.order] = p[:count]
        values = pressures.with_walls(operators, fluid, p[count:], jump)
        force = even[:count] - operators.pressure_gradient(values) / self.density
        momentum = kept * (w - step.velocities) - self.tau * force
        field = self.tau * even + kept * self.start
        if kept < 1.0:
            field = field + (1.0 - kept) * operators.divergent(w, step.moved)
        divergence = operators.divergence(field) - self.source
        laplacian: Array = self.equation.rows.times(p)
        if len(jump):
            laplacian[:count] += self.coupling @ jump
        off = self.h * (np.zeros(len(p)) - self.tau / self.density * laplacian)
        off[:count] += self.h * divergence[self.equation.order]
        if len(p) > count:
            walls = pressures.walls
            assert walls is not None
            at_walls = even[count:] - 2.0 * step.moved / step.length * walls.accelerations
            off[count:] += self.h * self.tau / self.density * pressures.wall_source(at_walls)
        if self.equation.system.singular:
            off -= off.mean()
        return np.concatenate((momentum.ravel(), off))
