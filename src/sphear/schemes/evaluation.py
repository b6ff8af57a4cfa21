"""The stages that find the rates of change of a state: entries, velocities, density, pressure, walls, sums."""

from __future__ import annotations

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
from sphear.interactions import FluidBeforeWall, VelocityBeforeWall
from sphear.schemes.columns import without_standing_mass
from sphear.schemes.formulas import Formulas
from sphear.schemes.point_formulas import ContinuedVelocity, FluidAtWall, Pressure, Rates, SummedDensity


def integrated_walls(formulas: Formulas) -> bool:
    """True if wall particles have a density of their own, integrated like the fluid's."""
    return formulas.density is None and isinstance(formulas.wall, VelocityBeforeWall)


def evaluation(formulas: Formulas, columns: Columns, continuation: str | None, wall_particles: bool) -> list[Stage]:
    """The stages of an evaluation.

    Args:
        formulas: of a step.
        columns: that they may use.
        continuation: of the velocity through mirroring walls, a name; None without them.
        wall_particles: whether particles stand on mirroring walls.
    """
    supports = len(formulas.stages)  # first derivatives at images need their neighbours, which lie twice as deep
    last = Rows.PARTICLES if integrated_walls(formulas) else Rows.FLUID
    every = Rows.ENTRIES if supports > 1 else last
    stages: list[Stage] = [Images(supports, wall_particles), Neighbours(of_images=supports > 1)]
    if continuation is not None:
        stages.append(ImageVelocities(continuation))
    if formulas.density is not None:
        of_density = without_standing_mass(columns) if wall_particles else columns
        stages.append(PairSum("summed", formulas.density, Rows.PARTICLES, of_density))
        stages.append(PerParticle(SummedDensity(), Rows.PARTICLES))
    of_pressure = Rows.FLUID if isinstance(formulas.wall, FluidBeforeWall) else Rows.PARTICLES
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
    """The stages that give wall particles their velocity from the fluid, and Adami's their pressure and density."""
    if formulas.wall is None:
        return []
    before = PairSum("before_wall", formulas.wall, Rows.WALLS, columns)
    if isinstance(formulas.wall, VelocityBeforeWall):
        return [before, PerParticle(ContinuedVelocity(), Rows.WALLS, nearest=("before_wall",))]
    return [before, PerParticle(FluidAtWall(formulas.wall_state, formulas.density is None), Rows.WALLS)]
