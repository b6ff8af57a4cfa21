"""The formulas that make up a step, from the settings."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sphear.boundaries.models import ExplicitWallModel
from sphear.corrections import Correction, NoCorrection
from sphear.engine.formula import Interaction
from sphear.engine.preparation import Preparation
from sphear.engine.stages import PointFormula
from sphear.equations_of_state import EQUATIONS_OF_STATE, EquationOfState, IdealGas, Linear
from sphear.interactions import (
    Advection,
    Continuity,
    DensityAdvection,
    DensityDiffusion,
    DensityGradient,
    InternalEnergy,
    Part,
    PressureForce,
    Rates,
    Shifting,
    SummationDensity,
    TransportStress,
    TransportVelocity,
    ViscousForce,
)
from sphear.kernels import Kernel
from sphear.operators.arguments import read_correction
from sphear.schemes.problem import Problem
from sphear.schemes.weakly_compressible.settings import WeaklyCompressible
from sphear.viscosity.base import ViscousTerm


@dataclass(frozen=True)
class Formulas:
    """The interactions of a step, in the order in which they are swept.

    Attributes:
        density: gives the density; None where it is integrated.
        equation_of_state: gives the pressure.
        walls: the wall model, where particles stand behind walls; else None.
        before_wall: sums what they take from the fluid before them; None takes nothing.
        at_wall: makes fields of theirs of it.
        preparations: what the stages know of a particle's neighbourhood, by the name that they know it by.
        stages: each knows the one before as `before`; the last gives the rates.
        rates: the last of the stages.
    """

    density: Interaction | None
    equation_of_state: EquationOfState
    walls: ExplicitWallModel | None
    before_wall: Interaction | None
    at_wall: PointFormula | None
    preparations: tuple[tuple[str, Preparation], ...]
    stages: tuple[Interaction, ...]
    rates: Rates


def formulas_of(
    settings: WeaklyCompressible,
    problem: Problem,
    term: ViscousTerm,
    kernel: Kernel,
    sound_speed: float,
    time_step: float,
) -> Formulas:
    """The formulas of a flow.

    Args:
        settings: what is chosen.
        problem: the flow.
        term: its viscous term.
        kernel: with its smoothing length.
        sound_speed: at rest.
        time_step: which the transport velocity depends on.
    """
    correction = read_correction(settings.correction)
    of_term = NoCorrection() if term.own_correction else correction
    preparations = [("prepared", term.preparation(kernel, of_term))]
    prepared = "prepared"
    if term.own_correction:  # the pressure gradient's correction then needs sums of its own
        prepared = "prepared_gradient"
        preparations.append((prepared, correction.preparation(kernel)))
    *before, _ = term.acceleration_stages(kernel, of_term)
    viscous = ViscousForce(term, kernel, of_term)
    rates = Rates((viscous, *_parts(settings, problem, kernel, correction, prepared, sound_speed, time_step)))
    equation = _equation(settings, problem, sound_speed)
    walls = _walls(settings, problem)
    state = equation if settings.gas else Linear(problem.density, sound_speed)  # of which the density follows
    summed = settings.density == "summation"
    return Formulas(
        density=SummationDensity(kernel) if summed else None,
        equation_of_state=equation,
        walls=walls,
        before_wall=None if walls is None else walls.before_wall(kernel),
        at_wall=None if walls is None else walls.at_wall(state, with_density=not summed),
        preparations=tuple((name, preparation) for name, preparation in preparations if preparation is not None),
        stages=(*before, rates),
        rates=rates,
    )


def _equation(settings: WeaklyCompressible, problem: Problem, sound_speed: float) -> EquationOfState:
    if isinstance(settings.equation_of_state, EquationOfState):
        return settings.equation_of_state
    if settings.gas:
        return IdealGas()
    kind: Any = EQUATIONS_OF_STATE[settings.equation_of_state]
    equation: EquationOfState = kind(problem.density, sound_speed)
    return equation


def _parts(
    settings: WeaklyCompressible,
    problem: Problem,
    kernel: Kernel,
    correction: Correction,
    prepared: str,
    sound_speed: float,
    time_step: float,
) -> list[Part]:
    """Everything but the viscous force."""
    gas = settings.gas
    continuity = settings.density == "continuity"
    at_rest = settings.initial_pressure if gas else 0.0
    parts: list[Part] = [
        PressureForce(
            kernel,
            correction,
            settings.form,
            settings.pressure_reduction == "mean",
            at_rest if settings.pressure_reduction == "hydrostatic" else None,
            prepared,
        )
    ]
    if continuity:
        seen = "slip_velocity" if settings.wall_divergence == "slipping" else "velocity"
        parts.append(Continuity(kernel, correction, prepared, seen))
    if settings.density_diffusion > 0:
        gradients = settings.diffusion_form == "antuono"
        parts.append(DensityDiffusion(kernel, settings.density_diffusion, sound_speed, gradients))
        if gradients:
            parts.append(DensityGradient(kernel, correction, prepared))
    if gas:
        parts.append(InternalEnergy(kernel, correction, settings.form, prepared))
    if settings.transport == "shifting":
        shifting = Shifting(kernel, settings.shifting_strength, problem.speed, problem.spacing)
        parts += [shifting, Advection(shifting, kernel, correction, prepared)]
        if continuity:
            parts.append(DensityAdvection(shifting, kernel, correction, prepared))
    elif settings.transport == "transport_velocity":
        background = settings.background_pressure * problem.density * sound_speed**2
        parts += [TransportVelocity(kernel, 0.5 * time_step * background), TransportStress(kernel)]
    return parts


def _walls(settings: WeaklyCompressible, problem: Problem) -> ExplicitWallModel | None:
    """The wall model whose particles stand behind walls; None without walls, or where they mirror."""
    model = settings.wall_model
    if problem.box.free_slip:
        model.check_free_slip()
    return None if model.mirrors or not problem.walled else model
