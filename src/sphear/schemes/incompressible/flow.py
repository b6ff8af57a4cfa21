"""An incompressible flow in time, by projection."""

from __future__ import annotations

import math
from contextlib import suppress
from typing import Any

import numpy as np

from sphear.engine.cache import compiled_beside
from sphear.engine.memory import keep_freed_memory
from sphear.engine.threads import thread_count
from sphear.errors import SphearError
from sphear.kernels import Kernel
from sphear.operators import arguments
from sphear.schemes.base import FlowFailure, check_kernel, check_start, check_state, chosen_time_step, described
from sphear.schemes.energy import EnergyBudget
from sphear.schemes.incompressible.compiling import parts
from sphear.schemes.incompressible.coupled import coupled
from sphear.schemes.incompressible.diagnostics import diagnostics
from sphear.schemes.incompressible.discretisation import Discretisation
from sphear.schemes.incompressible.failure_checks import FailureChecks
from sphear.schemes.incompressible.particle_sums import in_box
from sphear.schemes.incompressible.pressures import Pressures
from sphear.schemes.incompressible.settings import Incompressible
from sphear.schemes.incompressible.shifting import Displacement
from sphear.schemes.incompressible.step import step
from sphear.schemes.incompressible.sums_of_places import sums_of_places
from sphear.schemes.incompressible.viscous import IMPLICIT_SHARE, Viscous
from sphear.schemes.objects import text
from sphear.schemes.problem import Problem
from sphear.schemes.registered_names import named
from sphear.viscosity import ViscousTerm

Array = np.ndarray[Any, Any]

FREE_SURFACE_STEPS = 100.0  # viscous limits of an explicit step, that an implicit one is at most
PRESSURE_AT = {"midpoint": 0.5, "start": 0.0, "intermediate": 1.0}  # share of the step
COURANT = 0.4  # of smoothing lengths
USUAL_ALPHA = 10.0  # alpha over the time step in L / U: 0.01 at the step of 0.001 of Zheng, Ma & Shao (2018)

CHOSEN = ("viscosity", "correction", "gradient_correction", "kernel", "laplacian")  # by a name or an object


class IncompressibleFlow:
    """An incompressible flow in time.

    A step predicts velocities from viscosity and body force (Zheng, Ma & Shao 2018, eqs. 7 to 9), finds the pressure
    that frees them of divergence (eq. 13), and moves particles with the mean of old and new velocity (eqs. 10 to 12);
    then they are shifted. With `projection=midpoint` they move with the old velocity for half a step before forces act
    and with the new one for the other half after it, which is the same mean and second order for the pressure's force;
    with forces of the step's start, vortices gain energy in proportion to the step.

    Args:
        problem: what is to be computed.
        settings: of the scheme.
        duration: how long a run of it takes, where that is known; implicit viscous steps resolve it.

    Attributes:
        time: reached.
        steps: made.
        positions, velocities: (N, d).
        pressure: (N,), at the positions; of the `pressure_time`.
        pressure_positions, pressure_slopes: (N, d), where it was found, and its gradient there.
        pressures: it, and how it was solved for.
        discretisation: how fields become operators.
        together: the sums of a step that are made in one sweep.
        limits: the time steps that the CFL, viscous, body-force and shifting conditions allow.

    Raises:
        SphearError: the settings do not fit the problem or each other.
    """

    def __init__(self, problem: Problem, settings: Incompressible, duration: float = math.inf) -> None:
        self.problem, self.settings = problem, settings
        self.time, self.steps = 0.0, 0
        check_start(problem)
        self.term = arguments.read_viscosity(settings.viscosity)
        correction = arguments.read_correction(settings.correction, self.term)
        self.kernel = arguments.read_kernel(settings.kernel, settings.h_over_dx, problem.spacing)
        check_kernel(problem, self.kernel, settings)
        self.count = len(problem.positions)
        self.threads = thread_count(settings.threads, self.count)
        viscous = Viscous(self.term, correction, self.kernel, problem.kinematic_viscosity)
        self.discretisation = Discretisation(problem, settings, self.kernel, viscous, self.threads)
        self.checks = FailureChecks(problem, self.discretisation.region)
        self.limits = self.limits_of(problem, settings, self.kernel, self.term)
        self.time_step = chosen_time_step(self.limits, settings, duration)
        usual = USUAL_ALPHA * problem.speed * self.time_step / problem.length
        self.alpha = min(usual, 1.0) if settings.alpha is None else settings.alpha
        self.pressures = Pressures(problem, settings, self.kernel, self.discretisation.walls, self.alpha)
        self.coupled = coupled(problem, settings, self.pressures, self.kernel.h, self.time_step, self.term.radial)
        self.displacement = Displacement(settings.shifting_method, problem, self.kernel, settings.seed)
        self.together = sums_of_places(self)
        self.x = in_box(np.ascontiguousarray(problem.positions, np.float64), self.discretisation.domain).copy()
        self.u = np.ascontiguousarray(problem.velocities, np.float64).copy()
        self.energy_budget = EnergyBudget(problem.density * problem.spacing ** self.x.shape[1], self.u, problem.speed)
        self.pressure_positions, self.pressure_slopes = self.x, np.zeros_like(self.u)
        self.distance: Array | None = None  # (N,), of the particles from walls, where it is known already

    @property
    def positions(self) -> Array:
        """Positions of the particles, (N, d), in the problem's unit of length."""
        return self.x

    @property
    def velocities(self) -> Array:
        """Velocities of the particles, (N, d), in the problem's unit of speed."""
        return self.u

    @property
    def pressure(self) -> Array:
        """Pressure (N,) of the `pressure_time`, taken along its gradient from where it was found to the positions."""
        moved, domain = self.x - self.pressure_positions, self.discretisation.domain
        moved = moved if domain is None else domain.shortest(moved)
        result: Array = self.pressures.fluid + np.einsum("nd,nd->n", self.pressure_slopes, moved)
        return result

    @property
    def pressure_time(self) -> float:
        """The time that the pressure is of: `projection=midpoint` finds it in the middle of a step."""
        projection = self.settings.projection
        if self.coupled is not None and projection == "intermediate":  # places that only a prediction knows
            projection = "start"
        return self.time - (1.0 - PRESSURE_AT[projection]) * self.time_step if self.steps else 0.0

    @property
    def density(self) -> Array:
        """Density of the fluid, one number for all particles, (N,), a mass by a volume."""
        return np.full(self.count, self.problem.density)

    @staticmethod
    def limits_of(problem: Problem, settings: Incompressible, kernel: Kernel, term: ViscousTerm) -> dict[str, float]:
        """The time steps that each condition allows; a flow itself is not needed."""
        h = kernel.h
        limits = problem.time_step_limits(h, 0.0, term.radial)
        limits["cfl"] = COURANT * h / problem.speed
        if (stable := settings.shifting_method.stable_step(h, problem.speed)) < math.inf:
            limits["shifting"] = stable
        if IMPLICIT_SHARE[settings.viscous_step]:
            # beside a free surface velocity and pressure are found one after the other, which long steps do not bear
            limits["viscous"] *= FREE_SURFACE_STEPS if problem.free_surface else math.inf
        return limits

    def advance(self, steps: int) -> None:
        """Make steps; none at all compile what a step needs.

        Raises:
            FlowFailure: the flow broke down; the state is that of the moment.
        """
        keep_freed_memory()  # the rows of the pressure equation are large even of small flows
        if not steps:
            self._compile()
        for _ in range(steps):
            try:
                with np.errstate(all="ignore"):  # what breaks down is no number in the end
                    step(self)
            except FlowFailure:
                raise
            except SphearError as error:
                raise FlowFailure(f"the flow failed at t = {self.time:g}: {error}") from None

    def _compile(self) -> None:
        """Make a step and take it back."""
        state = self.state()
        with compiled_beside(parts(self)), suppress(SphearError), np.errstate(all="ignore"):
            step(self)
        self.restore(state)

    def __repr__(self) -> str:
        """The particles, the viscous term and the clock in a line."""
        return described(self, text(self.settings.viscosity))

    def metrics(self) -> dict[str, float]:
        """Iterations, residual, divergence, density and distances of particles now."""
        return diagnostics(self)

    def resolved(self) -> dict[str, Any]:
        """Settings with names and defaults resolved, and numbers that follow from them."""
        settings = named(self.settings)
        return {
            **{key: text(getattr(settings, key)) for key in CHOSEN},
            "preconditioner": text(settings.preconditioner),
            "h_over_dx": self.kernel.h / self.problem.spacing,
            "alpha": self.alpha,
            "time_step": self.time_step,
            "threads": self.threads,
            "kinematic_viscosity": self.problem.kinematic_viscosity,
        }

    def introduction(self) -> str:
        """The solve for the pressure, and the wall model."""
        settings = self.settings
        walls = f", walls {text(settings.walls)}" if self.discretisation.walls is not None else ""
        return f"pressure to {settings.tolerance:g}, preconditioner {text(settings.preconditioner)}{walls}"

    def state(self) -> dict[str, Array]:
        """All that a run needs to go on, by name; copies."""
        return {name: np.copy(values) for name, values in self._arrays().items()}

    def _arrays(self) -> dict[str, Array]:
        return {
            "clock": np.array([self.time, self.steps]),
            "position": self.x,
            "velocity": self.u,
            "pressure": self.pressures.fluid,
            "wall_pressure": self.pressures.on_walls,
            "pressure_position": self.pressure_positions,
            "energy_budget": self.energy_budget.state(),
            "pressure_slopes": self.pressure_slopes,
        }

    def restore(self, state: dict[str, Array]) -> None:
        """Go back to a `state` of the same problem and settings.

        Raises:
            SphearError: it is that of another flow.
        """
        check_state(state, self._arrays())
        self.x, self.u = np.array(state["position"]), np.array(state["velocity"])
        self.pressure_positions, self.pressure_slopes = (
            np.array(state["pressure_position"]),
            np.array(state["pressure_slopes"]),
        )
        self.pressures.fluid, self.pressures.on_walls = np.array(state["pressure"]), np.array(state["wall_pressure"])
        self.energy_budget.restore(state["energy_budget"])
        self.time, self.steps, self.distance = float(state["clock"][0]), int(state["clock"][1]), None
