"""Velocity and pressure of a step whose viscosity is implicit, found together."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from scipy.sparse import csr_array

from sphear.errors import SphearError
from sphear.pressure import PRECONDITIONERS, PressureSystem
from sphear.pressure.flexible import flexible_gmres
from sphear.pressure.vectors import norm
from sphear.schemes.incompressible import viscous
from sphear.schemes.incompressible.pressures import Pressures
from sphear.schemes.incompressible.projection import Equation
from sphear.schemes.incompressible.settings import Incompressible
from sphear.schemes.incompressible.sums import Sums
from sphear.schemes.problem import Problem

Array = np.ndarray[Any, Any]

START = 3  # steps by backward Euler, which damps what a sudden start excites (Rannacher 1984): of second order still
SWEEPS = 2  # that improve on the inverse of the velocity's equation
DAMPING = 2.0  # share of the end of a step beyond a half, over the step in L / U: of second order still


class Step(NamedTuple):
    """What a step is made with.

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


class Coupled:
    """Solves a step's momentum equation together with that of its pressure.

    A pressure that is found after viscosity leaves a slip at walls that grows with the viscosity times the step
    (Chorin 1968), also in a steady flow. Here velocity w and pressure p at the end of a step are those of

        w = u + dt (a - grad p / rho),    a = (1 - s) nu lap u + s nu lap w + f
        div w = alpha / dt (rho_particles - rho) / rho + tau (lap p - div grad p) / rho

    at once, with n . grad p = rho n . a at walls. The last term, a difference between two forms of one Laplacian, is
    what a projection leaves, and what keeps pressures of neighbours from falling apart (Rhie & Chow 1983). A projection
    has tau = dt; here tau is at most the step that the viscous limit allows an explicit step, so that the steady flow
    is the explicit scheme's with any step. With explicit viscosity both are the same equation.

    Flexible GMRES is preconditioned by blocks: for the velocity a Laplacian with Dirichlet walls, for the pressure

        -rho (lap^-1 / dt - s nu (1 - tau / dt))    (Cahouet & Chabard 1988)

    Args:
        pressures: the pressure equation, and where the pressure is kept.
        viscosity: nu.
        limit: the step that the viscous limit allows an explicit step.
        turnover: L / U, the time in which the flow passes its length.
        relief: alpha / dt, the rate at which crowding decays.
        kind: of the viscous step, "crank_nicolson" or "backward_euler".
    """

    def __init__(
        self, pressures: Pressures, viscosity: float, limit: float, turnover: float, relief: float, kind: str
    ) -> None:
        self.pressures, self.viscosity, self.limit = pressures, viscosity, limit
        self.turnover, self.relief = turnover, relief
        self.share = viscous.IMPLICIT_SHARE[kind]

    def solve(
        self, sums: Sums, velocities: Array, force: Array, time_step: float, moved: float, steps: int
    ) -> tuple[Array, Array]:
        """The velocities (N, d) at the end of a step, and the gradient (N, d) of its pressure.

        Args:
            sums: at the places where forces act.
            velocities: (N, d), at the step's start.
            force: (d,) or (N, d), on a unit of mass.
            time_step: dt.
            moved: the time for which particles moved before, and will after.
            steps: made before.

        Raises:
            SphearError: the solution did not converge.
        """
        share = min(self.share + DAMPING * time_step / self.turnover, 1.0) if steps >= START else 1.0
        return Coupling(self, sums, Step(velocities, force, time_step, share, moved)).solve()


class Coupling:
    """The equation of one step; velocities and pressures are one vector, as speeds.

    Args:
        how: the solver.
        sums: at the places where forces act.
        step: what it is made with.
    """

    def __init__(self, how: Coupled, sums: Sums, step: Step) -> None:
        self.how, self.sums, self.step = how, sums, step
        pressures, self.h = how.pressures, sums.how.kernel.h
        self.density = pressures.density
        self.tau = min(step.length, how.limit)
        self.kept = self.tau / step.length
        self.unit = self.density * self.h / self.tau  # of pressures
        rows = pressures.rows
        still = np.zeros((sums.places.total - sums.how.count, step.velocities.shape[1]))
        nothing = rows.jump(still, self.density, sums.ways())
        self.equation: Equation = rows.equation(sums.places, sums.rows, nothing, None)
        self.coupling = rows.wall_coupling(self.equation)
        self.inverse = PRECONDITIONERS[pressures.preconditioner].build(self.equation.system)
        self.velocity_inverse = self._velocity_inverse()
        u = step.velocities
        self.before = (1.0 - step.share) * sums.viscous(u) + step.force
        self.start = sums.divergent(u, -step.moved)
        self.still = sums.divergent(np.zeros_like(u))
        self.source = how.relief * pressures.crowding(sums)
        if step.moved:
            d = u.shape[1]
            slopes = sums.slopes(self.start).reshape(-1, d, d)
            self.source = self.source + step.moved * np.einsum("nab,nba->n", slopes, slopes)

    def solve(self) -> tuple[Array, Array]:
        """Velocities (N, d) and the gradient (N, d) of the pressure, which is kept.

        Raises:
            SphearError: the solution did not converge.
        """
        pressures, u = self.how.pressures, self.step.velocities
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
        found = scale * run.values
        residual = norm(self.residual(found))
        if not residual <= viscous.DRIFT * floor:
            raise SphearError(
                f"the implicit viscous step was not solved: after {run.iterations} iterations its relative residual is"
                f" {residual / scale:.2g} where {viscous.TOLERANCE:g} is asked for; take a smaller time step"
            )
        w, p = self._parts(found)
        pressures.iterations, pressures.residual = run.iterations, residual / scale
        pressures.keep(self.equation, p)
        jump = self._jump(self._even(w))
        values = pressures.with_walls(self.sums, pressures.fluid, pressures.on_walls, jump)
        return w, self.sums.pressure_slopes(values, self.sums.pressure_gradient(values))

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
        return self.sums.even(self.step.share * self.sums.viscous(w) + self.before)

    def _jump(self, even: Array) -> Array:
        pressures, sums = self.how.pressures, self.sums
        walls, count = pressures.walls, sums.how.count
        at_walls = even[count:]
        if walls is not None:
            at_walls = at_walls - 2.0 * self.step.moved / self.step.length * walls.accelerations
        return pressures.rows.jump(at_walls, self.density, sums.ways())

    def residual(self, z: Array) -> Array:
        """What both equations are off by, as speeds."""
        step, sums, kept, how = self.step, self.sums, self.kept, self.how.pressures
        w, p = self._parts(z)
        even = self._even(w)
        count = len(w)
        jump = self._jump(even)
        fluid = np.empty(count)
        fluid[self.equation.order] = p[:count]
        values = how.with_walls(sums, fluid, p[count:], jump)
        force = even[:count] - sums.pressure_gradient(values) / self.density
        momentum = kept * (w - step.velocities) - self.tau * force
        field = self.tau * even + kept * self.start
        if kept < 1.0:
            field = field + (1.0 - kept) * sums.divergent(w, step.moved)
        divergence = sums.divergence(field) - self.source
        laplacian: Array = self.equation.system.matrix @ p
        if len(jump):
            laplacian[:count] += self.coupling @ jump
        off = self.h * (np.zeros(len(p)) - self.tau / self.density * laplacian)
        off[:count] += self.h * divergence[self.equation.order]
        if len(p) > count:
            walls = how.walls
            assert walls is not None
            at_walls = even[count:] - 2.0 * step.moved / step.length * walls.accelerations
            off[count:] += self.h * self.tau / self.density * how.wall_source(at_walls)
        if self.equation.system.singular:
            off -= off.mean()
        return np.concatenate((momentum.ravel(), off))

    def _velocity_inverse(self) -> Any:
        """Nearly the inverse of w - s dt nu lap w, on one component, in the order of cells; None without viscosity."""
        factor = self.step.share * self.step.length * self.how.viscosity
        if not factor:
            return None
        matrix = self.how.pressures.rows.velocity_matrix(self.equation, self.sums.rows)
        count = matrix.shape[0]
        shifted = csr_array(matrix.copy())
        shifted.data[shifted.indptr[:count]] -= 1.0 / factor  # the diagonal comes first
        of = self.equation.system
        system = PressureSystem(
            shifted, of.positions[:count], of.lower, of.upper, of.periodic, of.spacing, of.symmetric, False
        )
        inverse = PRECONDITIONERS["grid"].build(system)

        def apply(vector: Array) -> Array:
            result: Array = inverse(vector) / -factor
            for _ in range(SWEEPS):
                result = result + inverse(vector + factor * (shifted @ result)) / -factor
            return result

        return apply

    def precondition(self, z: Array) -> Array:
        """Nearly the solution of the equations, block by block."""
        shape = self.step.velocities.shape
        size, order = shape[0] * shape[1], self.equation.order
        w = z[:size].reshape(shape) / self.kept
        if self.velocity_inverse is not None:
            inner = np.empty_like(w)
            for component in range(shape[1]):
                inner[order, component] = self.velocity_inverse(np.ascontiguousarray(w[order, component]))
            w = inner
        off = z[size:] / self.h
        if self.kept < 1.0:
            moved = self.sums.divergence(self.sums.divergent(w) - self.still)
            off[: shape[0]] -= (1.0 - self.kept) * moved[order]
        if self.equation.system.singular:
            off -= off.mean()
        viscous_part = self.step.share * self.how.viscosity * (1.0 - self.kept) * off
        viscous_part[shape[0] :] = 0.0
        p = self.density * (viscous_part - self.inverse(off) / self.step.length)
        return np.concatenate((w.ravel(), p / self.unit))


def coupled(
    problem: Problem,
    settings: Incompressible,
    pressures: Pressures,
    h: float,
    time_step: float,
    radial: bool,
) -> Coupled | None:
    """The solver of implicit steps; None of explicit ones, and where a free surface cuts pressures off.

    Args:
        problem: what is computed.
        settings: how.
        pressures: the pressure equation.
        h: the smoothing length.
        time_step: dt.
        radial: whether the viscous term acts along the line of centres.
    """
    if settings.viscous_step == "explicit" or problem.free_surface:
        return None
    limit = problem.time_step_limits(h, 0.0, radial)["viscous"]
    turnover, relief = problem.length / problem.speed, pressures.alpha / time_step
    return Coupled(pressures, problem.kinematic_viscosity, limit, turnover, relief, settings.viscous_step)
