"""The time integrators: the midpoint rule, and kick-drift-kick."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar, NamedTuple

from sphear.engine.stages import CheckFinite, CheckPositive, EnterBox, PerParticle, Rows, Stage
from sphear.names import Registry
from sphear.schemes.point_formulas import Advanced, Corrected, Drifted, Kept


class Integrated(NamedTuple):
    """The variables that are integrated in time.

    scalars: of density and energy, beside place and velocity.
    of_walls: those of them that wall particles have too.
    drifting: whether particles move against the fluid.
    """

    scalars: tuple[str, ...]
    of_walls: tuple[str, ...]
    drifting: bool


class Step(NamedTuple):
    """The stages of a step.

    stages: all of them.
    evaluation: the first and the one after the last of those that find the rates of the present state.
    moved: the number of the stage from which on the state is that of the end of the step.
    """

    stages: tuple[Stage, ...]
    evaluation: tuple[int, int]
    moved: int


class Integrator(ABC):
    """A way from the rates of change to the state a time step later."""

    name: ClassVar[str]
    restores: ClassVar[bool]  # whether a step that fails on its way is undone, by what was kept of its start

    @abstractmethod
    def step(self, evaluation: Sequence[Stage], time_step: float, of: Integrated, fastest: float) -> Step:
        """The stages of a step.

        Args:
            evaluation: the stages that find the rates.
            time_step: of the step.
            of: what is integrated.
            fastest: the speed at which a step fails.
        """

    @abstractmethod
    def kept(self, of: Integrated) -> tuple[str, ...]:
        """The fields of which a copy is kept, as `..._before`."""


def _checked(evaluation: Sequence[Stage]) -> list[Stage]:
    return [*evaluation, CheckFinite("acceleration")]


def _positive(of: Integrated) -> list[Stage]:
    return [CheckPositive(name) for name in of.scalars]


@dataclass(frozen=True)
class Midpoint(Integrator):
    """The midpoint rule, second-order Runge-Kutta: rates half a step on carry the state over the whole of it.

    y(t + dt) = y(t) + dt f(y(t) + dt/2 f(y(t))), two evaluations a step (Basa, Quinlan & Lastiwka 2009, section 3).
    """

    name: ClassVar[str] = "midpoint"
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
            return stages + _positive(of)

        before = [
            PerParticle(Kept(self.kept(of)), Rows.FLUID),
            *([PerParticle(Kept(of.of_walls), Rows.WALLS)] if of.of_walls else []),
            *_checked(evaluation),
            *advance(0.5 * time_step),
            *_checked(evaluation),
        ]
        begin = 2 if of.of_walls else 1
        return Step(
            (*before, *advance(time_step), EnterBox(fastest)), (begin, begin + len(evaluation) + 1), len(before)
        )


@dataclass(frozen=True)
class KickDriftKick(Integrator):
    """The kick-drift-kick form of the leapfrog: half of the rates before and after a step, one evaluation each.

    r(t + dt) = r + dt (v + dt/2 a), v(t + dt) = v + dt/2 (a(t) + a(t + dt)), with the velocity v + dt a where the
    forces of the step's end depend on it.
    """

    name: ClassVar[str] = "kick_drift_kick"
    restores: ClassVar[bool] = False

    def kept(self, of: Integrated) -> tuple[str, ...]:
        """The rates of the step before."""
        return ("acceleration", *(f"{name}_rate" for name in of.scalars))

    def step(self, evaluation: Sequence[Stage], time_step: float, of: Integrated, fastest: float) -> Step:
        """Drift with the rates of the step before, evaluate, correct."""
        walls = bool(of.of_walls)
        moves: list[Stage] = [PerParticle(Drifted(time_step, of.scalars, True, of.drifting), Rows.FLUID)]
        moves += [PerParticle(Drifted(time_step, of.of_walls, False, False), Rows.WALLS)] if walls else []
        moves += [*_positive(of), EnterBox(fastest)]
        corrections: list[Stage] = [PerParticle(Corrected(time_step, of.scalars, True), Rows.FLUID)]
        corrections += [PerParticle(Corrected(time_step, of.of_walls, False), Rows.WALLS)] if walls else []
        rates = _checked(evaluation)
        return Step((*moves, *rates, *corrections), (len(moves), len(moves) + len(rates)), 0)


INTEGRATORS: Registry[Integrator] = Registry("integrator")
INTEGRATORS.add("midpoint", Midpoint())
INTEGRATORS.add("kick_drift_kick", KickDriftKick())
