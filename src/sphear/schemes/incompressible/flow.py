"""An incompressible flow in time, by projection."""

from __future__ import annotations

import math
from contextlib import suppress
from typing import Any

import numpy as np

from sphear.engine.memory import keep_freed_memory
from sphear.engine.threads import thread_count
from sphear.errors import SphearError
from sphear.kernels import Kernel
from sphear.operators import arguments
from sphear.schemes.base import FlowFailure, check_kernel, check_start, check_state, chosen_time_step, described
from sphear.schemes.energy import EnergyBudget
from sphear.schemes.incompressible.coupled import coupled
from sphear.schemes.incompressible.diagnostics import diagnostics
from sphear.schemes.incompressible.free_surface import along_surface
from sphear.schemes.incompressible.guard import Guard
from sphear.schemes.incompressible.places import in_box
from sphear.schemes.incompressible.pressures import Pressures
from sphear.schemes.incompressible.settings import Incompressible
from sphear.schemes.incompressible.shifting import LEAST_STRETCHING, drift, stretching, unevenness
from sphear.schemes.incompressible.sums import Discretisation, Sums
from sphear.schemes.incompressible.viscous import IMPLICIT_SHARE, Viscous
from sphear.schemes.named import named
from sphear.schemes.objects import text
from sphear.schemes.problem import Problem
from sphear.viscosity import ViscousTerm

Array = np.ndarray[Any, Any]

MOVED_BEFORE = {"midpoint": 0.5, "start": 0.0, "intermediate": 0.0}  # share of the step, before forces act
PRESSURE_AT = {"midpoint": 0.5, "start": 0.0, "intermediate": 1.0}  # share of the step
COURANT = 0.4  # of smoothing lengths
STABLE_SHIFTING = 0.25  # smoothing lengths a step and strength: half as much again makes particles clump
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
        settings: how.
        duration: how long a run of it takes, where that is known; implicit viscous steps resolve it.

    Attributes:
        time: reached.
        steps: made.
        positions, velocities: (N, d).
        pressure: (N,), at the positions; of the `pressure_time`.
        pressure_positions, pressure_slopes: (N, d), where it was found, and its gradient there.
        pressures: it, and how it was solved for.
        discretisation: how fields become sums.
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
        self.guard = Guard(problem, self.discretisation.region)
        self.limits = self.limits_of(problem, settings, self.kernel, self.term)
        self.time_step = chosen_time_step(self.limits, settings, duration)
        usual = USUAL_ALPHA * problem.speed * self.time_step / problem.length
        self.alpha = min(usual, 1.0) if settings.alpha is None else settings.alpha
        self.pressures = Pressures(problem, settings, self.kernel, self.discretisation.walls, self.alpha)
        self.coupled = coupled(problem, settings, self.pressures, self.kernel.h, self.time_step, self.term.radial)
        self.drift = drift(settings.shifting, self.kernel, settings.shifting_strength, problem.speed, problem.spacing)
        self.uneven = unevenness(self.count, problem.positions.shape[1], problem.spacing, settings.seed)
        self.x = in_box(np.ascontiguousarray(problem.positions, np.float64), self.discretisation.domain).copy()
        self.u = np.ascontiguousarray(problem.velocities, np.float64).copy()
        self.energy_budget = EnergyBudget(problem.density * problem.spacing ** self.x.shape[1], self.u, problem.speed)
        self.pressure_positions, self.pressure_slopes = self.x, np.zeros_like(self.u)
        self._distance: Array | None = None  # of the particles from walls, where it is known already

    @property
    def positions(self) -> Array:
        """(N, d)."""
        return self.x

    @property
    def velocities(self) -> Array:
        """(N, d)."""
        return self.u

    @property
    def pressure(self) -> Array:
        """(N,), at the positions, along its gradient from where it was found; of the `pressure_time`."""
        moved, domain = self.x - self.pressure_positions, self.discretisation.domain
        moved = moved if domain is None else domain.shortest(moved)
        result: Array = self.pressures.fluid + (self.pressure_slopes * moved).sum(axis=1)
        return result

    @property
    def pressure_time(self) -> float:
        """Of which time the pressure is: `projection=midpoint` finds it in the middle of a step."""
        projection = self.settings.projection
        if self.coupled is not None and projection == "intermediate":  # places that only a prediction knows
            projection = "start"
        return self.time - (1.0 - PRESSURE_AT[projection]) * self.time_step if self.steps else 0.0

    @property
    def density(self) -> Array:
        """(N,)."""
        return np.full(self.count, self.problem.density)

    @staticmethod
    def limits_of(problem: Problem, settings: Incompressible, kernel: Kernel, term: ViscousTerm) -> dict[str, float]:
        """The time steps that each condition allows; a flow itself is not needed."""
        h = kernel.h
        limits = problem.time_step_limits(h, 0.0, term.radial)
        limits["cfl"] = COURANT * h / problem.speed
        if settings.shifting == "lind":  # the concentration spreads explicitly
            limits["shifting"] = STABLE_SHIFTING * h / (settings.shifting_strength * problem.speed)
        if IMPLICIT_SHARE[settings.viscous_step]:
            limits["viscous"] = math.inf
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
                    self._step()
            except FlowFailure:
                raise
            except SphearError as error:
                raise FlowFailure(f"the flow failed at t = {self.time:g}: {error}") from None

    def _compile(self) -> None:
        """Make a step and take it back."""
        state = self.state()
        with suppress(SphearError), np.errstate(all="ignore"):
            self._step()
        self.restore(state)

    def _force(self, sums: Sums, time: float) -> Array:
        """(d,) or (N, d), the acceleration by forces at a time."""
        problem = self.problem
        force = np.array(problem.body_force)
        return force if problem.force is None else force + problem.force(sums.places.positions[: self.count], time)

    def _predicted(self, sums: Sums, u: Array, force: Array) -> Array:
        """(N, d), the acceleration of velocities u (N, d) by viscosity and a force, over the step."""
        share = IMPLICIT_SHARE[self.settings.viscous_step]
        if not share:
            acceleration: Array = sums.viscous(u) + force
            return acceleration
        return self.discretisation.viscous.implicit(share, self.time_step, u, force, sums.viscous)

    def _projected(self, sums: Sums, u: Array, force: Array, moved: float) -> tuple[Sums, Array, Array, Array]:
        """The sums where pressure acts, velocities (N, d) after it, its slopes, and the viscous acceleration."""
        step, x = self.time_step, sums.places.positions[: self.count]
        acceleration = self._predicted(sums, u, force)
        predicted = u + step * acceleration
        if self.settings.projection == "intermediate":
            self.guard.check_speed(self.time, x, predicted)
            sums = self.discretisation.at(in_box(x + step * predicted, self.discretisation.domain))
        even = sums.even(acceleration)
        before = sums.divergent(u, -moved) + step * even
        pressures = self.pressures.solve(sums, before, even[self.count :], step, moved)
        gradient = sums.pressure_gradient(pressures)
        after = predicted - step / self.problem.density * gradient
        return sums, after, sums.pressure_slopes(pressures, gradient), acceleration - force

    def _step(self) -> None:
        step, u = self.time_step, self.u.copy()  # before dry walls velocities change
        moved = MOVED_BEFORE[self.settings.projection] * step
        x, distance = self.x, self._distance
        if moved:
            x = x + moved * u
            self.guard.check_speed(self.time, self.x, u)
            distance = self.guard.put_back(self.time, x, u)
            x = in_box(x, self.discretisation.domain)
        sums = self.discretisation.at(x, distance)
        force = self._force(sums, self.time + moved)
        if self.coupled is not None:
            after, slopes = self.coupled.solve(sums, u, force, step, moved, self.steps)
            viscous = (after - u) / step - force + slopes / self.problem.density
        else:
            sums, after, slopes, viscous = self._projected(sums, u, force, moved)
        self.pressure_positions, self.pressure_slopes = sums.places.positions[: self.count], slopes
        x = x + (0.5 * step - moved) * u + 0.5 * step * after
        if self.drift is not None:
            # not of `continued`, whose walls hold the fluid: corrected by those, particles before a lid run away
            slopes = sums.slopes(sums.slipping(after, moved)).reshape(self.count, *[u.shape[1]] * 2)
            stretched = stretching(slopes, LEAST_STRETCHING * self.problem.speed / self.problem.spacing)
            shift = step * (sums.places.sum(self.drift) + stretched[:, None] * self.uneven)
            shift = shift if sums.surface is None else along_surface(shift, sums.surface)
            after = after + np.einsum("nab,nb->na", slopes, shift)
            x = x + shift
        if not np.isfinite(after + x).all():
            self.guard.check_speed(self.time, self.x, after)  # before the state is no number
        self.x, self.u = x, after
        self.energy_budget.add(step, u, after, viscous, force)
        self.time += step
        self.steps += 1
        self.guard.check_speed(self.time, self.x, self.u)
        self._distance = self.guard.put_back(self.time, self.x, self.u)
        self.x = in_box(self.x, self.discretisation.domain)

    def __repr__(self) -> str:
        """How many particles, by which term, and where they stand."""
        return described(self, text(self.settings.viscosity))

    def metrics(self) -> dict[str, float]:
        """Iterations, residual, divergence, density and distances of particles now."""
        return diagnostics(self)

    def resolved(self) -> dict[str, Any]:
        """Settings with names and defaults resolved, and numbers that follow from them."""
        settings = named(self.settings)
        return {
            **{key: text(getattr(settings, key)) for key in CHOSEN},
            "preconditioner": self.pressures.preconditioner,
            "h_over_dx": self.kernel.h / self.problem.spacing,
            "alpha": self.alpha,
            "time_step": self.time_step,
            "threads": self.threads,
            "kinematic_viscosity": self.problem.kinematic_viscosity,
        }

    def introduction(self) -> str:
        """How the pressure is found."""
        settings = self.settings
        walls = f", walls {settings.walls}" if self.discretisation.walls is not None else ""
        return f"pressure to {settings.tolerance:g}, preconditioner {self.pressures.preconditioner}{walls}"

    def state(self) -> dict[str, Array]:
        """All that a run needs to go on, by name; copies."""
        return {name: np.copy(values) for name, values in self._arrays().items()}

    def _arrays(self) -> dict[str, Array]:
        return {
            "clock": np.array([self.time, self.steps]),
            "x": self.x,
            "v": self.u,
            "pressure": self.pressures.fluid,
            "wall_pressure": self.pressures.on_walls,
            "pressure_x": self.pressure_positions,
            "energy": self.energy_budget.state(),
            "pressure_slopes": self.pressure_slopes,
        }

    def restore(self, state: dict[str, Array]) -> None:
        """Go back to a `state` of the same problem and settings.

        Raises:
            SphearError: it is that of another flow.
        """
        check_state(state, self._arrays())
        self.x, self.u = np.array(state["x"]), np.array(state["v"])
        self.pressure_positions, self.pressure_slopes = (
            np.array(state["pressure_x"]),
            np.array(state["pressure_slopes"]),
        )
        self.pressures.fluid, self.pressures.on_walls = np.array(state["pressure"]), np.array(state["wall_pressure"])
        self.energy_budget.restore(state["energy"])
        self.time, self.steps, self._distance = float(state["clock"][0]), int(state["clock"][1]), None
