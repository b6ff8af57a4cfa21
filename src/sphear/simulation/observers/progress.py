"""The standing of a run on the terminal."""

from __future__ import annotations

import sys
import time
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from sphear.simulation.observers.base import Observer

if TYPE_CHECKING:
    from sphear.simulation.run import Run

OFTEN = 1.0  # seconds between two lines


@dataclass
class Progress(Observer):
    """A line on the error stream a second: the time reached, steps, the share that is done and what is left.

    Args:
        steps: between two looks at the clock.

    Examples:
        >>> import sphear
        >>> observer = sphear.Progress(steps=100)
        >>> observer
        Progress(every=None, steps=100, when=None)
    """

    at_start = False

    steps: int | None = 10
    _last: float = field(default=0.0, init=False, repr=False)

    def look(self, run: Run) -> None:
        """Print a line if a second has passed."""
        if time.monotonic() - self._last >= OFTEN:
            self._last = time.monotonic()
            self._say(run.standing())

    def finish(self, run: Run) -> None:
        """Print how it ended."""
        self._say(f"{run.standing()}, end: {run.end}")

    def _say(self, line: str) -> None:
        sys.stderr.write(f"{line}\n")
        sys.stderr.flush()
