"""The stages that find the rates of change of a state: entries, velocities, density, pressure, walls, sums."""

from __future__ import annotations

from sphear.boundaries.models import MirrorParticles
from sphear.engine.stages import (
    Columns,
    Images,
    ImageVelocities,
    Neighbours,
    PairSum,
    PerParticle,
    Prepare,
    Rows,
    Stage,
)
from sphear.schemes.weakly_compressible.columns import without_standing_mass
from sphear.schemes.weakly_compressible.formulas import Formulas
from sphear.schemes.weakly_compressible.point_formulas import Pressure, Rates, SummedDensity


def integrated_walls(formulas: Formulas) -> bool:
    """True if wall particles have a density of their own, integrated like the fluid's."""
    return formulas.density is None and formulas.walls is not None and formulas.walls.integrates_density


def evaluation(formulas: Formulas, columns: Columns, mirrors: MirrorParticles | None) -> list[Stage]:
    """The stages of an evaluation.

    Args:
        formulas: of a step.
        columns: that they may use.
        mirrors: the wall model, where walls mirror; else None.
    """
    supports = len(formulas.stages)  # first derivatives at images need their neighbours, which lie twice as deep
    last = Rows.PARTICLES if integrated_walls(formulas) else Rows.FLUID
    every = Rows.ENTRIES if supports > 1 else last
    on_walls = mirrors is not None and mirrors.on_wall
    stages: list[Stage] = [Images(supports, on_walls), Neighbours(of_images=supports > 1)]
    if mirrors is not None:
        stages.append(ImageVelocities(mirrors.continuation))
    if formulas.density is not None:
        of_density = without_standing_mass(columns) if on_walls else columns
        stages.append(PairSum("summed", formulas.density, Rows.PARTICLES, of_density))
        stages.append(PerParticle(SummedDensity(), Rows.PARTICLES))
    takes_pressure = formulas.walls is not None and formulas.walls.takes_pressure
    of_pressure = Rows.FLUID if takes_pressure else Rows.PARTICLES
    stages.append(PerParticle(Pressure(formulas.equation_of_state), of_pressure))
    stages += _walls(formulas, columns)
    preparations = tuple(
        (name, Prepare(f"prepared {number}", preparation, every, columns))
        for number, (name, preparation) in enumerate(formulas.preparations)
    )
    stages += [preparation for _, preparation in preparations]
    before = ""
    for number, stage in enumerate(formulas.stages, 1):
        end = number == supports
        result = "rates" if end else f"stage {number}"
        stages.append(PairSum(result, stage, last if end else every, columns, before, preparations))
        before = result
    roles = formulas.rates.roles
    stages.append(PerParticle(Rates(roles, roles), Rows.FLUID))
    if integrated_walls(formulas):
        stages.append(PerParticle(Rates(roles, ("density", "density_gradient")), Rows.WALLS))
    return stages


def _walls(formulas: Formulas, columns: Columns) -> list[Stage]:
    """The stages that give wall particles what they take from the fluid before them."""
    model, stages = formulas.walls, list[Stage]()
    if formulas.before_wall is not None:
        stages.append(PairSum("before_wall", formulas.before_wall, Rows.WALLS, columns))
    if model is not None and formulas.at_wall is not None:
        nearest = ("before_wall",) if model.from_first_layer else ()
        stages.append(PerParticle(formulas.at_wall, Rows.WALLS, nearest=nearest))
    return stages
