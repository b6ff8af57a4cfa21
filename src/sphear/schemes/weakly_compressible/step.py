"""The stages of a step of the explicit scheme, from its settings and formulas."""

from __future__ import annotations

import math

from sphear.boundaries.models import MirrorParticles
from sphear.schemes.problem import Problem
from sphear.schemes.weakly_compressible.arrays import integrated
from sphear.schemes.weakly_compressible.columns import columns
from sphear.schemes.weakly_compressible.evaluation import evaluation
from sphear.schemes.weakly_compressible.formulas import Formulas
from sphear.schemes.weakly_compressible.integrators import Step
from sphear.schemes.weakly_compressible.settings import WeaklyCompressible


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
    mirrors = settings.wall_model if problem.walled else None
    mirrors = mirrors if isinstance(mirrors, MirrorParticles) else None
    rates = evaluation(formulas, columns(fields), mirrors)
    fastest = math.inf if settings.gas else sound_speed
    return settings.time_integrator.step(rates, time_step, integrated(formulas), fastest)
