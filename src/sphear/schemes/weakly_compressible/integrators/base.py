"""The methods that all time integrators have, and what they are given and make."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import ClassVar, NamedTuple

from sphear.engine.stages import CheckFinite, CheckPositive, Stage


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
    """A way from the rates of change to the state a time step later.

    Attributes:
        restores: a step that fails on its way is undone, by what was kept of its start.
        begins_with_rates: the first step needs the rates of the start.

    Examples:
        >>> import sphear
        >>> [sphear.INTEGRATORS[name].begins_with_rates for name in sphear.INTEGRATORS]
        [False, True]
    """

    name: ClassVar[str] = "unnamed"
    aliases: ClassVar[tuple[str, ...]] = ()
    formula: ClassVar[str] = "not stated"
    source: ClassVar[str] = "not stated"
    restores: ClassVar[bool] = False
    begins_with_rates: ClassVar[bool] = False

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


def checked(evaluation: Sequence[Stage]) -> list[Stage]:
    """The evaluation, which fails where it gives no numbers."""
    return [*evaluation, CheckFinite("acceleration")]


def positive(of: Integrated) -> list[Stage]:
    """The stages that fail where density or energy is not positive."""
    return [CheckPositive(name) for name in of.scalars]
