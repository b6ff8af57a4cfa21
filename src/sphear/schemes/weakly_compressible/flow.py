"""An explicit flow in time: weakly compressible or, with an ideal gas, compressible."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numba
import numpy as np

from sphear.boundaries import CONTINUATIONS
from sphear.engine.backends.cpu import Program, Space
from sphear.engine.stages import CAUSES, THROUGH_A_WALL, EnterBox
from sphear.engine.threads import loop_threads, thread_count
from sphear.kernels import Kernel
from sphear.operators import arguments
from sphear.schemes.base import FlowFailure, check_start, check_state, chosen_time_step, described
from sphear.schemes.objects import text
from sphear.schemes.problem import Problem
from sphear.schemes.registered_names import named
from sphear.schemes.weakly_compressible.arrays import fields_at_start, integrated
from sphear.schemes.weakly_compressible.diagnostics import diagnostics
from sphear.schemes.weakly_compressible.formulas import formulas_of
from sphear.schemes.weakly_compressible.room import check_room
from sphear.schemes.weakly_compressible.settings import WeaklyCompressible
from sphear.schemes.weakly_compressible.sound_speed import energy_at_rest, sound_speed
from sphear.schemes.weakly_compressible.step import step_of
from sphear.schemes.weakly_compressible.walls_of_regions import gone_through, region_of, with_possible_walls
from sphear.viscosity import ViscousTerm

Array = np.ndarray[Any, Any]

OF_WALLS = ("walls", "wall_divergence", "density", "diffusion_form")  # which a region may change


class WeaklyCompressibleFlow:
    """A flow in time by explicit steps, weakly compressible or of an ideal gas.

    Args:
        problem: what is to be computed.
        settings: of the scheme.

    Attributes:
        problem: without the particles at the start.
        energy_budget: None, as no work is summed up.
        time: reached.
        steps: made.
        density, pressure: of the last evaluation, in midpoint steps half a step back where they are not integrated.
        limits: the time steps that the CFL, viscous and body-force conditions allow.

    Raises:
        SphearError: the settings do not fit the problem or each other.
    """

    energy_budget = None

    def __init__(self, problem: Problem, settings: WeaklyCompressible) -> None:
        settings = with_possible_walls(problem, settings)
        self.problem, self.settings = problem, settings
        self.time, self.steps = 0.0, 0
        check_start(problem)
        self.term = arguments.read_viscosity(settings.viscosity)
        self.correction = arguments.read_correction(settings.correction, None)
        self.kernel = arguments.read_kernel(settings.kernel, settings.h_over_dx, problem.spacing)
        self.count = len(problem.positions)
        self.sound_speed = sound_speed(problem, settings)
        self.limits = self.limits_of(problem, settings, self.kernel, self.term)
        self.time_step = chosen_time_step(self.limits, settings)
        formulas = formulas_of(settings, problem, self.term, self.kernel, self.sound_speed, self.time_step)
        check_room(problem, settings, self.kernel, len(formulas.stages))
        integrator = settings.time_integrator
        at_rest = energy_at_rest(problem, settings)
        self._fields = fields_at_start(settings, problem, formulas, self.kernel, integrator, at_rest)
        self._step = step_of(problem, settings, formulas, set(self._fields), self.sound_speed, self.time_step)
        self._restored = integrator.kept(integrated(formulas)) if integrator.restores else ()
        self._fresh = False  # whether the rates are those of the state
        self._body_force = np.array(problem.body_force, np.float64)
        self.threads = min(thread_count(settings.threads, self.count), loop_threads())
        self._program = self._compiled()
        self._region = region_of(problem)
        nothing = np.empty((0, problem.positions.shape[1]))  # the start would be a tenth of a large flow's memory
        self.problem = replace(problem, positions=nothing, velocities=nothing)

    @property
    def density_rate(self) -> Array | None:
        """(N,): d rho / dt of the last evaluation, a density over a time; None where the density is summed."""
        return self._fields["density_rate"][: self.count] if "density_rate" in self._fields else None

    def _compiled(self) -> Program:
        """The steps, for so many threads."""
        box = self.problem.box.arrays(self.settings.wall_model.mirrors)
        space = Space(*box, spacing=float(self.problem.spacing), support=float(self.kernel.radius))
        uniform = {"body_force": self._body_force}
        return Program(self._step.stages, self._fields, uniform, space, self.count, self.threads)

    @staticmethod
    def limits_of(
        problem: Problem, settings: WeaklyCompressible, kernel: Kernel, term: ViscousTerm
    ) -> dict[str, float]:
        """The time steps that the CFL, viscous and body-force conditions allow; a flow itself is not needed."""
        return problem.time_step_limits(kernel.h, sound_speed(problem, settings), term.radial)

    @property
    def positions(self) -> Array:
        """Positions of the particles, (N, d), in the problem's unit of length."""
        return self._fields["position"][: self.count]

    @property
    def velocities(self) -> Array:
        """Velocities of the particles, (N, d), in the problem's unit of speed."""
        return self._fields["velocity"][: self.count]

    @property
    def density(self) -> Array:
        """Density at the particles, (N,), a mass by a volume."""
        return self._fields["density"][: self.count]

    @property
    def pressure(self) -> Array:
        """Pressure at the particles by the equation of state, (N,), a density by a squared speed."""
        return self._fields["pressure"][: self.count]

    @property
    def energy(self) -> Array:
        """Internal energy of an ideal gas by its mass, (N,), a squared speed; else zeros."""
        return self._fields["energy"][: self.count] if "energy" in self._fields else np.zeros(self.count)

    @property
    def drift(self) -> Array:
        """Velocity of the particles against the fluid, (N, d); zero where nothing moves them so."""
        return self._fields["drift"][: self.count] if "drift" in self._fields else np.zeros_like(self.positions)

    @property
    def acceleration(self) -> Array:
        """Acceleration du/dt of the particles by the last evaluation, (N, d), a speed by a time."""
        return self._fields["acceleration"][: self.count]

    def advance(self, steps: int) -> None:
        """Make steps.

        Raises:
            FlowFailure: the flow broke down; the state is that of the moment.
        """
        if self.threads > 1:
            numba.set_num_threads(self.threads)
        if self.threads > 1 and loop_threads() == 1:  # made before this process was forked
            self.threads = 1
            self._program = self._compiled()
        if self.settings.time_integrator.begins_with_rates and not self._fresh:
            self._run(1, *self._step.evaluation)
            self._fresh = True
        self._run(steps)

    def _run(self, steps: int, begin: int = 0, end: int | None = None) -> None:
        """Run stages of steps, all of them or those of an evaluation."""
        ended = self._program.run(steps, begin, end)
        if end is None:
            moved = isinstance(self._step.stages[ended.stage], EnterBox) if ended.cause else False
            self.steps += ended.steps + moved
            self.time = self.steps * self.time_step  # however many are made at once
        cause, particle = ended.cause, ended.particle
        if not cause and (through := gone_through(self._region, self.problem, self.positions)) >= 0:
            cause, particle = THROUGH_A_WALL, through
        if cause:
            self._fresh = False
            if ended.cause and ended.stage < self._step.moved:
                for name in self._restored:
                    self._fields[name][...] = self._fields[f"{name}_before"]
            place = ", ".join(f"{x:.6g}" for x in self._fields["position"][particle])
            raise FlowFailure(
                f"the flow failed at t = {self.time:g}, particle {particle} at ({place}): {CAUSES[cause]}"
            )

    def __repr__(self) -> str:
        """The number of particles, the viscous term and the clock."""
        return described(self, text(self.settings.viscosity))

    def metrics(self) -> dict[str, float]:
        """Mach number, density, divergence and distances of particles now, see `diagnostics`."""
        return diagnostics(self)

    def resolved(self) -> dict[str, Any]:
        """Settings with names and defaults resolved, and numbers that follow from them."""
        settings = named(self.settings)
        return {
            "viscosity": text(settings.viscosity),
            "correction": text(settings.correction),
            "kernel": text(settings.kernel),
            **{key: text(getattr(settings, key)) for key in OF_WALLS},
            "continuation": CONTINUATIONS.name(settings.continuation),
            "density_diffusion": settings.density_diffusion,
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
        changing = ("position", "velocity", "density", "pressure", "energy", "drift", "density_gradient",
                    "acceleration", "density_rate", "energy_rate")  # fmt: skip
        return {
            "clock": np.array([self.time, self.steps]),
            "fresh": np.array(self._fresh),
            **{name: self._fields[name] for name in changing if name in self._fields},
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
