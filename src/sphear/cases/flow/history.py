"""The history of a run of a case: its metrics at even intervals, by which the case judges."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, cast

import numpy as np

from sphear.simulation.observers import Observer

if TYPE_CHECKING:
    from sphear.cases.flow.run import CaseRun
    from sphear.simulation.run import Run


@dataclass
class CaseHistory(Observer):
    """Rows of the metrics of a case; it also judges whether the run, one of a case, has ended."""

    at_start = False

    def look(self, run: Run) -> dict[str, float]:
        """Time in the unit of the case, steps, metrics of case and scheme, and what else is measured."""
        mine = cast("CaseRun", run)
        with np.errstate(all="ignore"):  # also of a flow that broke down
            metrics = {**mine.case.metrics(mine.settings, mine.flow), **mine.flow.metrics()}
            measured = mine.measured(mine)
        mine.end = mine.end or mine.implausible() or mine.verdict(metrics)
        return {"time": mine.flow.time / mine.unit, "steps": mine.flow.steps, **metrics, **measured}


def nothing(_: CaseRun) -> Mapping[str, float]:
    """No numbers beside those of the case."""
    return {}
