"""The base of all observers: rows that grow at even intervals."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, ClassVar

from sphear.checked import number
from sphear.errors import SphearError, quoted

if TYPE_CHECKING:
    from sphear.simulation.run import Run

ROUNDING = 1e-6  # of a time step, by which a time may be missed that is reached


def whole(value: object) -> bool:
    """True if a value is a positive whole number."""
    return isinstance(value, int) and not isinstance(value, bool) and value > 0


@dataclass
class Observer:
    """Looks at a simulation at even intervals, and keeps a row of each look.

    An observer of your own has a method `look`, which returns what is to be kept.

    Args:
        every: interval of time between two looks, counted from the start; each is at the first step beyond it.
        steps: or the interval in steps. Without either, an observer looks at the start and at the end.

    Attributes:
        rows: of all looks so far.

    Raises:
        SphearError: an interval is not positive, or both are given.
    """

    at_start: ClassVar[bool] = True  # whether it looks before the first step too

    every: float | None = None
    steps: int | None = None
    rows: list[Any] = field(default_factory=list, init=False, repr=False)

    def __post_init__(self) -> None:
        name = type(self).__name__
        if self.every is not None and self.steps is not None:
            raise SphearError(f"{name} looks every so much time or so many steps, not both")
        if self.every is not None:
            every = number(self.every)
            if not every > 0:
                raise SphearError(f"the interval of {name} is a positive time, not {quoted(self.every)}")
            self.every = every
        if self.steps is not None and not whole(self.steps):
            raise SphearError(f"the interval of {name} is a positive number of steps, not {quoted(self.steps)}")

    def start(self, run: Run) -> None:
        """Begin to watch a run: called once, before its first step."""

    def finish(self, run: Run) -> None:
        """Close a run that has come to its end, or to one of its ends: called after the last look."""

    def look(self, run: Run) -> Any:
        """The row that is kept of a run as it stands; None keeps nothing."""
        raise NotImplementedError

    def watch(self, run: Run) -> None:
        """Look, and keep what is seen."""
        if (row := self.look(run)) is not None:
            self.rows.append(row)

    def until_next(self, run: Run) -> float:
        """The number of steps to the next look; infinite where only the end is looked at."""
        flow = run.flow
        if self.steps is not None:
            return self.steps - flow.steps % self.steps
        if self.every is None:
            return math.inf
        step = flow.time_step
        past = math.floor((flow.time + ROUNDING * step) / self.every)
        return max(1.0, math.ceil(((past + 1) * self.every - flow.time) / step - ROUNDING))

    def due(self, run: Run) -> bool:
        """True if a look is due at the step that was just made."""
        flow = run.flow
        if self.steps is not None:
            return flow.steps % self.steps == 0
        if self.every is None:
            return False
        now, before = flow.time + ROUNDING * flow.time_step, flow.time - (1 - ROUNDING) * flow.time_step
        return math.floor(now / self.every) > math.floor(before / self.every)


def check_observer(observer: object) -> None:
    """Refuse what has not what an observer has.

    Raises:
        SphearError: it is no `Observer`.
    """
    if not isinstance(observer, Observer):
        raise SphearError(f"an observer is an Observer, such as History(every=0.1), not {quoted(observer)}")
