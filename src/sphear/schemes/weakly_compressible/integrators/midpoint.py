"""The midpoint rule, with two evaluations a step."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

from sphear.engine.stages import EnterBox, PerParticle, Rows, Stage
from sphear.schemes.weakly_compressible.integrators.base import Integrated, Integrator, Step, checked, positive
from sphear.schemes.weakly_compressible.point_formulas import Advanced, Kept


@dataclass(frozen=True)
class Midpoint(Integrator):
    """The midpoint rule, second-order Runge-Kutta: rates half a step on carry the state over the whole of it.

    Examples:
        >>> import sphear
        >>> print(sphear.WeaklyCompressible(integrator=sphear.Midpoint()))
        WeaklyCompressible()
    """

    name: ClassVar[str] = "midpoint"
    aliases: ClassVar[tuple[str, ...]] = ("rk2",)
    formula: ClassVar[str] = "y(t + dt) = y(t) + dt f(y(t) + dt/2 f(y(t)))"
    source: ClassVar[str] = "Basa, Quinlan & Lastiwka 2009, IJNMF 60:1127, section 3"
    restores: ClassVar[bool] = True

    def kept(self, of: Integrated) -> tuple[str, ...]:
        """The state at the start of the step."""
        return ("position", "velocity", *of.scalars)

    def step(self, evaluation: Sequence[Stage], time_step: float, of: Integrated, fastest: float) -> Step:
        """Keep the state, evaluate, go half a step, evaluate, go the whole step from the state that was kept."""

        def advance(time: float) -> list[Stage]:
            stages: list[Stage] = [PerParticle(Advanced(time, of.scalars, True, of.drifting), Rows.FLUID)]
            if of.of_walls:
                stages.append(PerParticle(Advanced(time, of.of_walls, False, False), Rows.WALLS))
            return stages + positive(of)

        before = [
            PerParticle(Kept(self.kept(of)), Rows.FLUID),
            *([PerParticle(Kept(of.of_walls), Rows.WALLS)] if of.of_walls else []),
            *checked(evaluation),
            *advance(0.5 * time_step),
            *checked(evaluation),
        ]
        begin = 2 if of.of_walls else 1
        return Step(
            (*before, *advance(time_step), EnterBox(fastest)), (begin, begin + len(evaluation) + 1), len(before)
        )
