"""An explicit flow in time: weakly compressible or, with an ideal gas, compressible."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial
from typing import Any

import numba
import numpy as np

from sphear.boundaries import CONTINUATIONS
from sphear.engine.memory import LARGE, keep_freed_memory
from sphear.engine.threads import loop_threads, thread_count
from sphear.equations_of_state import Barotropic, EquationOfState, IdealGas
from sphear.errors import SphearError
from sphear.kernels import Kernel
from sphear.operators import arguments
from sphear.schemes.arrays import arrays
from sphear.schemes.base import (
    FlowFailure,
    check_kernel,
    check_start,
    check_state,
    chosen_time_step,
    described,
    fineness,
)
from sphear.schemes.formulas import formulas
from sphear.schemes.integrators import CAUSES
from sphear.schemes.loop import loop_module
from sphear.schemes.named import named
from sphear.schemes.objects import text
from sphear.schemes.problem import Problem, corner_sound_speed, morris_sound_speed
from sphear.schemes.settings import WeaklyCompressible
from sphear.viscosity import ViscousTerm

Array = np.ndarray[Any, Any]


class Flow:
    """A flow in time.

    Args:
        problem: what is to be computed.
        settings: how.

    Attributes:
        problem: without the particles at the start.
        time: reached.
        steps: made.
        positions, velocities: (N, d), of the fluid now.
        density, pressure, energy: (N,); of the last evaluation, which of the midpoint rule is at the middle of a step
            where they are not integrated.
        drift: (N, d), of the particles against the fluid.
        limits: the time steps that the CFL, viscous and body-force conditions allow.

    Raises:
        SphearError: the settings do not fit the problem or each other.
    """

    def __init__(self, problem: Problem, settings: WeaklyCompressible) -> None:
        self.problem, self.settings = problem, settings
        self.time, self.steps = 0.0, 0
        check_start(problem)
        self.term = arguments.read_viscosity(settings.viscosity)
        self.correction = arguments.read_correction(settings.correction, None)
        self.kernel = arguments.read_kernel(settings.kernel, settings.h_over_dx, problem.spacing)
        self.count = len(problem.positions)
        self.sound_speed = _sound_speed(problem, settings)
        self.limits = self.limits_of(problem, settings, self.kernel, self.term)
        self.time_step = chosen_time_step(self.limits, settings)
        chosen = formulas(settings, problem, self.term, self.kernel, self.sound_speed, self.time_step)
        self._check_room(len(chosen.stages))
        at_start = arrays(settings, problem, chosen, self.kernel, _energy_at_rest(problem, settings))
        self._x, self._v, self._fields, self._change, self._space, self._numbers, self._constants = at_start
        self._fresh = False  # whether the rates are those of the state
        self.threads = min(thread_count(settings.threads, self.count), loop_threads())
        self._loop_of = partial(
            loop_module,
            problem.positions.shape[1],
            chosen,
            integrator=settings.integrator,
            walls=bool(problem.box.wall_axes),
            mirrored=settings.walls == "mirror",
            continuation=CONTINUATIONS.name(settings.continuation),
            wall_particles=settings.wall_particles,
        )
        self._loop = self._loop_of(parallel=self.threads > 1)
        nothing = np.empty((0, problem.positions.shape[1]))  # the start would be a tenth of a large flow's memory
        self.problem = replace(problem, positions=nothing, velocities=nothing)

    @staticmethod
    def limits_of(
        problem: Problem, settings: WeaklyCompressible, kernel: Kernel, term: ViscousTerm
    ) -> dict[str, float]:
        """The time steps that the CFL, viscous and body-force conditions allow; a flow itself is not needed."""
        return problem.time_step_limits(kernel.h, _sound_speed(problem, settings), term.radial)

    @property
    def positions(self) -> Array:
        """(N, d)."""
        return self._x[: self.count]

    @property
    def velocities(self) -> Array:
        """(N, d)."""
        return self._v[: self.count]

    @property
    def density(self) -> Array:
        """(N,)."""
        return self._fields.density[: self.count]

    @property
    def pressure(self) -> Array:
        """(N,)."""
        return self._fields.pressure[: self.count]

    @property
    def energy(self) -> Array:
        """(N,) of an ideal gas, else of one number that means nothing."""
        return self._fields.energy[: self.count]

    @property
    def drift(self) -> Array:
        """(N, d) where particles are moved against the fluid, else (1, d) of zeros."""
        return self._fields.drift[: self.count]

    @property
    def acceleration(self) -> Array:
        """(N, d), of the last evaluation."""
        return self._change.velocity

    def _check_room(self, stages: int) -> None:
        problem, settings = self.problem, self.settings
        reach = stages * self.kernel.radius
        supports, so = (
            ("the kernel's support", "reaches") if stages == 1 else (f"{stages} supports of the kernel", "reach")
        )
        for axis in problem.box.wall_axes:
            width = problem.box.upper[axis] - problem.box.lower[axis]
            if reach > width:
                raise SphearError(
                    f"{fineness(problem, settings)} is too coarse for walls={settings.walls}: {supports} of"
                    f" {reach:g} {so} beyond the width of {width:g} between the walls"
                )
        check_kernel(problem, self.kernel, settings)

    def advance(self, steps: int) -> None:
        """Make steps.

        Raises:
            FlowFailure: the flow broke down; the state is that of the moment.
        """
        if self.threads > 1:
            numba.set_num_threads(self.threads)
        if self.count > LARGE:
            keep_freed_memory()
        fastest = math.inf if self.settings.gas else self.sound_speed
        if self.threads > 1 and loop_threads() == 1:  # made before this process was forked
            self.threads, self._loop = 1, self._loop_of(parallel=False)
        made, status, worst = self._loop.advance(
            self._x, self._v, self._fields, self._change, self.time_step, steps, self._fresh, fastest, self.count,
            self.threads, self._space, self._numbers, self._constants,
        )  # fmt: skip
        self._fresh = status == 0 and (self._fresh or steps > 0 or self.settings.integrator == "kick_drift_kick")
        self.steps += made
        self.time = self.steps * self.time_step  # however many are made at once
        if status:
            place = ", ".join(f"{x:.6g}" for x in self._x[worst])
            raise FlowFailure(f"the flow failed at t = {self.time:g}, particle {worst} at ({place}): {CAUSES[status]}")

    def __repr__(self) -> str:
        """How many particles, by which term, and where they stand."""
        return described(self, text(self.settings.viscosity))

    def metrics(self) -> dict[str, float]:
        """Nothing beside what the case says."""
        return {}

    def resolved(self) -> dict[str, Any]:
        """Settings with names and defaults resolved, and numbers that follow from them."""
        settings = named(self.settings)
        return {
            "viscosity": text(settings.viscosity),
            "correction": text(settings.correction),
            "kernel": text(settings.kernel),
            "continuation": CONTINUATIONS.name(settings.continuation),
            "momentum": settings.form,
            "h_over_dx": self.kernel.h / self.problem.spacing,
            "sound_speed": self.sound_speed,
            "time_step": self.time_step,
            "threads": self.threads,
            "kinematic_viscosity": self.problem.kinematic_viscosity,
        }

    def introduction(self) -> str:
        """The sound speed."""
        return f"correction {text(self.settings.correction)}, sound speed {self.sound_speed:g}"

    def state(self) -> dict[str, Array]:
        """All that a run needs to go on, by name; copies."""
        return {name: values.copy() for name, values in self._arrays().items()}

    def _arrays(self) -> dict[str, Array]:
        return {
            "clock": np.array([self.time, self.steps]),
            "x": self._x,
            "v": self._v,
            "density": self._fields.density,
            "pressure": self._fields.pressure,
            "energy": self._fields.energy,
            "drift": self._fields.drift,
            "density_gradient": self._fields.density_gradient,
            "fresh": np.array(self._fresh),
            "velocity_rate": self._change.velocity,
            "density_rate": self._change.density,
            "energy_rate": self._change.energy,
        }

    def restore(self, state: dict[str, Array]) -> None:
        """Go back to a `state` of the same problem and settings.

        Raises:
            SphearError: it is that of another flow.
        """
        own = self._arrays()
        check_state(state, own)
        for name, values in own.items():
            if name not in ("clock", "fresh"):
                values[...] = state[name]
        self.time, self.steps, self._fresh = float(state["clock"][0]), int(state["clock"][1]), bool(state["fresh"])


def _sound_speed(problem: Problem, settings: WeaklyCompressible) -> float:
    """That of the fluid at rest."""
    equation, density = settings.equation_of_state, problem.density
    if isinstance(equation, Barotropic) and equation.rho0 != density:
        raise SphearError(
            f"the equation of state {equation!r} is of another fluid: rho0 must be the density of the flow, {density:g}"
        )
    if settings.gas:
        equation = equation if isinstance(equation, IdealGas) else IdealGas()
    if isinstance(equation, EquationOfState):
        return float(equation.sound_speed(density, _energy_at_rest(problem, settings)))
    return settings.sound_speed or max(morris_sound_speed(problem), corner_sound_speed(problem))


def _energy_at_rest(problem: Problem, settings: WeaklyCompressible) -> float:
    gas = settings.equation_of_state
    gas = gas if isinstance(gas, IdealGas) else IdealGas()
    return float(gas.energy(problem.density, settings.initial_pressure))
