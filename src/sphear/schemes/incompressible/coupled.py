"""Velocity and pressure of a step whose viscosity is implicit, found together."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from sphear.schemes.incompressible import viscous
from sphear.schemes.incompressible.coupled_step import CoupledStep, StepInputs
from sphear.schemes.incompressible.differential_operators import DifferentialOperators
from sphear.schemes.incompressible.pressures import Pressures
from sphear.schemes.incompressible.settings import Incompressible
from sphear.schemes.problem import Problem

Array = np.ndarray[Any, Any]

START = 3  # steps by backward Euler, which damps what a sudden start excites (Rannacher 1984): of second order still
# share of the end of a step beyond a half, over the step in the flow's own time: of second order still
DAMPING = 2.0


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

    Flexible GMRES is preconditioned by blocks, see `BlockPreconditioner`.

    Args:
        pressures: the pressure equation, and where the pressure is kept.
        viscosity: nu.
        limit: the step that the viscous limit allows an explicit step.
        turnover: the lesser of L / U, in which the flow passes its length, and L^2 / nu, in which it feels its walls.
            A slow flow is steady beside longer steps, and by Crank and Nicolson would ring at each.
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
        self,
        operators: DifferentialOperators,
        velocities: Array,
        force: Array,
        time_step: float,
        moved: float,
        steps: int,
    ) -> tuple[Array, Array]:
        """The velocities (N, d) at the end of a step, and the gradient (N, d) of its pressure.

        Args:
            operators: at the places where forces act.
            velocities: (N, d), at the step's start.
            force: (d,) or (N, d), on a unit of mass.
            time_step: dt.
            moved: the time for which particles moved before, and will after.
            steps: made before.

        Raises:
            SphearError: the solution did not converge.
        """
        share = min(self.share + DAMPING * time_step / self.turnover, 1.0) if steps >= START else 1.0
        return CoupledStep(self, operators, StepInputs(velocities, force, time_step, share, moved)).solve()


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
        settings: of the scheme.
        pressures: the pressure equation.
        h: the smoothing length.
        time_step: dt.
        radial: whether the viscous term acts along the line of centres.
    """
    if settings.viscous_step == "explicit" or problem.free_surface:
        return None
    limit = problem.time_step_limits(h, 0.0, radial)["viscous"]
    nu, relief = problem.kinematic_viscosity, pressures.alpha / time_step
    turnover = min(problem.length / problem.speed, problem.length**2 / nu if nu > 0 else math.inf)
    return Coupled(pressures, nu, limit, turnover, relief, settings.viscous_step)
