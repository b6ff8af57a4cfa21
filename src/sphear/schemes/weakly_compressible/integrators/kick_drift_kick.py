"""Kick-drift-kick, with one evaluation a step."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

from sphear.engine.stages import EnterBox, PerParticle, Rows, Stage
from sphear.schemes.weakly_compressible.integrators.base import Integrated, Integrator, Step, checked, positive
from sphear.schemes.weakly_compressible.point_formulas import Corrected, Drifted


@dataclass(frozen=True)
class KickDriftKick(Integrator):
    """The kick-drift-kick form of the leapfrog: half of the rates before and after a step, one evaluation each.

    The forces of the step's end depend on the velocity v + dt a.

    Examples:
        >>> import sphear
        >>> print(sphear.WeaklyCompressible(integrator=sphear.KickDriftKick()))
        WeaklyCompressible(integrator='kick_drift_kick')
    """

    name: ClassVar[str] = "kick_drift_kick"
    aliases: ClassVar[tuple[str, ...]] = ("leapfrog",)
    formula: ClassVar[str] = "r(t + dt) = r + dt (v + dt/2 a), v(t + dt) = v + dt/2 (a(t) + a(t + dt))"
    source: ClassVar[str] = "Verlet 1967, Phys. Rev. 159:98; Adami, Hu & Adams 2013, J. Comput. Phys. 241:292"
    begins_with_rates: ClassVar[bool] = True

    def kept(self, of: Integrated) -> tuple[str, ...]:
        """The rates of the step before."""
        return ("acceleration", *(f"{name}_rate" for name in of.scalars))

    def step(self, evaluation: Sequence[Stage], time_step: float, of: Integrated, fastest: float) -> Step:
        """Drift with the rates of the step before, evaluate, correct."""
        walls = bool(of.of_walls)
        moves: list[Stage] = [PerParticle(Drifted(time_step, of.scalars, True, of.drifting), Rows.FLUID)]
        moves += [PerParticle(Drifted(time_step, of.of_walls, False, False), Rows.WALLS)] if walls else []
        moves += [*positive(of), EnterBox(fastest)]
        corrections: list[Stage] = [PerParticle(Corrected(time_step, of.scalars, True), Rows.FLUID)]
        corrections += [PerParticle(Corrected(time_step, of.of_walls, False), Rows.WALLS)] if walls else []
        rates = checked(evaluation)
        return Step((*moves, *rates, *corrections), (len(moves), len(moves) + len(rates)), 0)
