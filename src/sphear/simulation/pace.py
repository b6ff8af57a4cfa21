"""The pace of a run: steps until it listens for interrupts, and seconds until it saves its state."""

from __future__ import annotations

import math
import time

from sphear.environment import seconds

SLICE = 0.5  # seconds between two moments at which a run can be stopped
SAVE_EVERY = "SPHEAR_SAVE_SECONDS"
USUAL = 10.0  # seconds between two savings of the state
SHARE = 0.01  # of a run's steps that may be lost, and of its time that saving may take


class Slices:
    """The number of steps that are made at once: as many as take half a second, measured on those before.

    What is computed does not depend on it.
    """

    def __init__(self) -> None:
        self.steps = 1

    def measured(self, steps: int, taken: float) -> None:
        """Learn from so many steps that took so many seconds."""
        self.steps = max(1, int(SLICE * steps / max(taken, 1e-9)))


class Copies:
    """The moments at which a state is copied, for a run that is interrupted in the midst of a step to go back to.

    Copying takes a hundredth of the time at most.
    """

    def __init__(self) -> None:
        self.cost, self.last = 0.0, -math.inf

    def due(self) -> bool:
        """True if it is time."""
        return time.monotonic() - self.last >= self.cost / SHARE

    def taken(self, began: float) -> None:
        """Learn that one was made since a moment of the monotonic clock."""
        self.last = time.monotonic()
        self.cost = self.last - began


class Savings:
    """The moments at which the state is saved: every 10 seconds.

    Where saving takes longer than a hundredth of that, it is less often, but at each hundredth of the run.

    Args:
        steps: of the whole run, as planned.
        at: steps made.
    """

    def __init__(self, steps: float, at: int) -> None:
        self.every = seconds(SAVE_EVERY, USUAL)
        self.share = SHARE * steps
        self.cost, self.last, self.steps = 0.0, time.monotonic(), at

    def due(self, steps: int) -> bool:
        """True if it is time."""
        waited = time.monotonic() - self.last
        return waited >= self.every and (waited >= self.cost / SHARE or steps - self.steps >= self.share)

    def tried(self, began: float, steps: int) -> None:
        """Learn that it was saved, or could not be, since a moment of the monotonic clock."""
        self.last, self.steps = time.monotonic(), steps
        self.cost = self.last - began
