"""The stages of a step of the explicit scheme, from its settings and formulas."""

from __future__ import annotations

import math

from sphear.boundaries import CONTINUATIONS
from sphear.schemes.arrays import integrated
from sphear.schemes.columns import columns
from sphear.schemes.evaluation import evaluation
from sphear.schemes.formulas import Formulas
from sphear.schemes.integrators import INTEGRATORS, Step
from sphear.schemes.problem import Problem
from sphear.schemes.settings import WeaklyCompressible


def step_of(
    problem: Problem,
    settings: WeaklyCompressible,
    formulas: Formulas,
    fields: set[str],
    sound_speed: float,
    time_step: float,
) -> Step:
    """The stages of a step: an evaluation of the rates, as often as the integrator wants one, and its moves.

    Args:
        problem: the flow.
        settings: chosen.
        formulas: of the step.
        fields: the names of those that its particles have.
        sound_speed: at rest, above which no particle of a fluid that is no gas may be.
        time_step: of the step.
    """
    mirrored = settings.walls == "mirror" and problem.walled
    rates = evaluation(
        formulas,
        columns(fields),
        CONTINUATIONS.name(settings.continuation) if mirrored else None,
        settings.wall_particles,
    )
    fastest = math.inf if settings.gas else sound_speed
    return INTEGRATORS[settings.integrator].step(rates, time_step, integrated(formulas), fastest)
