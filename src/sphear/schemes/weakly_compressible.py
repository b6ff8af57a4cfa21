"""Weakly compressible flow: summation density, an equation of state, the midpoint rule."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from sphear.boundaries import WALL_VELOCITIES, Box
from sphear.engine.structure import parameters
from sphear.equations_of_state import BatchelorTait, Linear
from sphear.errors import SphearError
from sphear.interactions import ReducedMomentum, SummationDensity
from sphear.neighbours.pair_list import selection_table_once
from sphear.operators import arguments
from sphear.schemes.program import loop_module
from sphear.schemes.settings import FlowSettings

Array = np.ndarray[Any, Any]

DENSITY_VARIATION = 0.01

CAUSES = {
    1: "too few neighbours for a correction or a fit",
    2: "an acceleration that is not a number; the time step may be too large, or the particles unstable",
    3: "a speed above the speed of sound, where the flow is no longer weakly compressible",
    4: "a particle went through a wall",
}


class FlowFailure(SphearError):
    """A run that broke down: when, where and why."""


@dataclass(frozen=True)
class Problem:
    """A flow to be computed.

    Attributes:
        positions: (N, d), at the start, on a lattice of spacing `spacing`.
        velocities: (N, d), at the start.
        box: its sides.
        body_force: on a unit of mass, (d,).
        spacing: of the particles.
        density: at rest.
        kinematic_viscosity: of the fluid.
        speed: the largest speed that is expected.
        length: the length that the Reynolds number is made with.
    """

    positions: Array
    velocities: Array
    box: Box
    body_force: tuple[float, ...]
    spacing: float
    density: float
    kinematic_viscosity: float
    speed: float
    length: float


@dataclass
class WeaklyCompressible:
    """A flow in time.

    Attributes:
        time: reached.
        steps: made.
        positions, velocities: (N, d), now.
        density, pressure: (N,), at the middle of the last step.
        limits: the time steps that the CFL, viscous and body-force conditions allow.
    """

    problem: Problem
    settings: FlowSettings
    time: float = 0.0
    steps: int = 0
    limits: dict[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        problem, settings = self.problem, self.settings
        self.positions, self.velocities = problem.positions.copy(), problem.velocities.copy()
        self.term = arguments.read_viscosity(settings.viscosity)
        self.correction = arguments.read_correction(settings.correction, self.term)
        self.kernel = arguments.read_kernel(settings.kernel, settings.h_over_dx, problem.spacing)
        self.sound_speed = settings.sound_speed or morris_sound_speed(problem)
        self.time_step = self._time_step()
        stiff = settings.equation_of_state == "batchelor_tait"
        equation = (BatchelorTait if stiff else Linear)(problem.density, self.sound_speed)
        count, dimension = self.positions.shape
        self.density, self.pressure = np.full(count, problem.density), np.zeros(count)

        density = SummationDensity(self.kernel)
        preparation = self.term.preparation(self.kernel, self.correction)
        stages = self._stages()
        self._check_walls(len(stages))
        wall_velocity = WALL_VELOCITIES.name(settings.wall_velocity)
        self._loop = loop_module(dimension, density, equation, preparation, stages, wall_velocity)
        interactions = [density, *([] if preparation is None else [preparation]), *stages]
        index, right = (
            preparation.normal_equations(dimension)
            if hasattr(preparation, "normal_equations")
            else (np.zeros((0, 0), np.int64), np.zeros(0))
        )
        lower, upper, kinds, velocities = problem.box.arrays()
        self._arguments = (
            np.full(count, problem.density * problem.spacing**dimension),
            np.full(count, problem.density * problem.kinematic_viscosity),
            np.array(problem.body_force, np.float64),
            lower, upper, kinds, problem.box.wall_axis, velocities, problem.spacing, self.kernel.radius,
            np.array(parameters(equation)),
            tuple(np.array(parameters(interaction) or [0.0]) for interaction in interactions),
            selection_table_once(), index, right, self.density, self.pressure,
        )  # fmt: skip

    def _stages(self) -> tuple[Any, ...]:
        """The viscous term inside the momentum equation; for two passes, its first before it."""
        reduced = self.settings.pressure_reduction == "mean"
        *before, _ = self.term.acceleration_stages(self.kernel, self.correction)
        return (*before, ReducedMomentum(self.term, self.kernel, self.correction, reduced))

    def _check_walls(self, layers: int) -> None:
        box = self.problem.box
        width = box.upper[box.wall_axis] - box.lower[box.wall_axis]
        supports = "the kernel's support" if layers == 1 else f"{layers} supports of the kernel"
        if box.wall_axis >= 0 and layers * self.kernel.radius > width:
            raise SphearError(
                f"the resolution of {self.settings.resolution} is too coarse for mirror particles: {supports} of"
                f" {layers * self.kernel.radius:g} reach beyond the channel's width of {width:g}"
            )

    def _time_step(self) -> float:
        problem, h = self.problem, self.kernel.h
        force = math.hypot(*problem.body_force)
        self.limits = {
            "cfl": 0.25 * h / (self.sound_speed + problem.speed),
            "viscous": 0.125 * h**2 / problem.kinematic_viscosity,
            "body_force": 0.25 * math.sqrt(h / force) if force > 0 else math.inf,
        }
        name = min(self.limits, key=self.limits.__getitem__)
        limit, wanted = self.limits[name], self.settings.time_step
        if wanted is not None and wanted > limit and not self.settings.force:
            raise SphearError(
                f"the time step of {wanted:g} is beyond the {name.replace('_', '-')} limit of {limit:g}: take a smaller"
                f" one, or --force"
            )
        return wanted or limit

    def advance(self, steps: int) -> None:
        """Make steps.

        Raises:
            FlowFailure: the flow broke down; the state is that of the moment.
        """
        made, status, worst = self._loop.advance(
            self.positions, self.velocities, self.time_step, steps, self.sound_speed, *self._arguments
        )
        self.steps += made
        self.time += made * self.time_step
        if status:
            place = ", ".join(f"{x:.6g}" for x in self.positions[worst])
            raise FlowFailure(f"the flow failed at t = {self.time:g}, particle {worst} at ({place}): {CAUSES[status]}")


def morris_sound_speed(problem: Problem) -> float:
    """c0^2 = max(U0^2, nu U0 / L, F L) / delta with delta = 0.01 (Morris, Fox & Zhu 1997, eq. 21)."""
    force = math.hypot(*problem.body_force)
    return math.sqrt(
        max(
            problem.speed**2,
            problem.kinematic_viscosity * problem.speed / problem.length,
            force * problem.length,
        )
        / DENSITY_VARIATION
    )
