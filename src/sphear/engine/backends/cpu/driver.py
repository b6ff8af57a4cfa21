"""The loop over the stages of steps: compiled once, for all flows."""

from __future__ import annotations

from typing import Any

import numpy as np

from sphear.engine.backends.cpu.views import call
from sphear.engine.cache import compiled

Array = np.ndarray[Any, Any]


@compiled
def advance(stages, tables, sizes, begin, end, at, steps):  # type: ignore[no-untyped-def]
    """Call the stages begin ... end - 1, one after the other, as often as there are steps, the first time from `at` on.

    Args:
        stages: (S,), their addresses.
        tables: (S, A), the addresses of the arrays of each.
        sizes: see `sphear.engine.backends.cpu.sizes`.
        begin: the first stage of a step.
        end: the one after the last.
        at: the stage to begin with.
        steps: to be made.

    Returns:
        steps made, the stage that ended them and its status: 0, or why it could not go on.
    """
    for step in range(steps):
        for stage in range(at, end):
            status = call(stages[stage], tables[stage], sizes)
            if status != 0:
                return step, stage, status
        at = begin
    return steps, end, 0
