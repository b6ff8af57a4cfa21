"""The base of all observers: rows that grow at even intervals, or at chosen times."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from sphear.checked import number, numbers
from sphear.errors import SphearError, quoted

if TYPE_CHECKING:
    from sphear.simulation.run import Run

ROUNDING = 1e-6  # of a time step, by which a time may be missed that is reached


def whole(value: object) -> bool:
    """True if a value is a positive whole number."""
    return isinstance(value, int) and not isinstance(value, bool) and value > 0


@dataclass
class Observer:
    """Looks at a simulation at even intervals or at chosen times, and keeps a row of each look.

    An observer of your own has a method `look`, which returns what is to be kept.

    Args:
        every: interval of time between two looks, counted from the start; each is at the first step beyond it.
        steps: or the interval in steps. At intervals, and without any, an observer looks at the start and the end too.
        when: or the times of all looks, each at the step nearest to it, once; none is at the end of its own accord.

    Attributes:
        rows: of all looks so far.

    Raises:
        SphearError: an interval is not positive, a time is before the start, or more than one of them is given.

    Examples:
        >>> import sphear
        >>> class Fastest(sphear.Observer):
        ...     def look(self, run):
        ...         return run.flow.time, abs(run.flow.velocities).max()
        ...
        >>> observer = Fastest(steps=1)
        >>> cavity = sphear.Simulation(
        ...     sphear.Rectangle((0, 0), (1, 1)),
        ...     spacing=0.1,
        ...     fluid=sphear.Fluid(kinematic_viscosity=0.01),
        ...     boundaries={"upper": sphear.NoSlip(velocity=(1.0, 0.0))},
        ...     observers=[observer],
        ... )
        >>> cavity.run(until=0.1).steps, len(observer.rows)
        (2, 3)
    """

    at_start: bool = field(default=True, init=False, repr=False)  # whether it looks before the first step too

    every: float | None = None
    steps: int | None = None
    when: Sequence[float] | None = None
    rows: list[Any] = field(default_factory=list, init=False, repr=False)

    def __post_init__(self) -> None:
        name = type(self).__name__
        if sum(given is not None for given in (self.every, self.steps, self.when)) > 1:
            raise SphearError(f"{name} looks every so much time, every so many steps or at times of its own: give one")
        if self.every is not None:
            every = number(self.every)
            if not every > 0:
                raise SphearError(f"the interval of {name} is a positive time, not {quoted(self.every)}")
            self.every = every
        if self.steps is not None and not whole(self.steps):
            raise SphearError(f"the interval of {name} is a positive number of steps, not {quoted(self.steps)}")
        if self.when is not None:
            times = numbers(self.when)
            if not times or min(times) < 0:
                raise SphearError(f"{name} looks at times from the start on, some of them, not at {quoted(self.when)}")
            self.when = tuple(sorted(times))

    @property
    def at_end(self) -> bool:
        """True if it looks where the run ends, whatever its interval: not where it has times of its own."""
        return self.when is None

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
        if self.when is not None:
            return next((step - flow.steps for step in self._steps_of_times(run) if step > flow.steps), math.inf)
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
        if self.when is not None:
            return flow.steps in self._steps_of_times(run)
        if self.every is None:
            return False
        now, before = flow.time + ROUNDING * flow.time_step, flow.time - (1 - ROUNDING) * flow.time_step
        return math.floor(now / self.every) > math.floor(before / self.every)

    def _steps_of_times(self, run: Run) -> list[int]:
        """The steps nearest to the times of its own."""
        assert self.when is not None
        return [round(time / run.flow.time_step) for time in self.when]


def check_observer(observer: object) -> None:
    """Refuse what has not what an observer has.

    Raises:
        SphearError: it is no `Observer`.
    """
    if not isinstance(observer, Observer):
        raise SphearError(f"an observer is an Observer, such as History(every=0.1), not {quoted(observer)}")
