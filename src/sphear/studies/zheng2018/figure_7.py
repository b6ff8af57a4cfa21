"""Figure 7: velocities and particles in the lid-driven cavity."""

from __future__ import annotations

from typing import Any

from sphear.studies.result import Progress, StudyResult
from sphear.studies.zheng2018.cavities import computed
from sphear.studies.zheng2018.cavity_vectors import vectors

KEPT = "cavity"  # the runs, which figures share
CLAIM = (
    "with 1600 and with 10,000 particles the lid drives one vortex, and at t = 40 the velocities have reached "
    "the stable state"
)


def compute(*, quick: bool, workers: int, progress: Progress) -> dict[str, Any]:
    """All runs, in what is shown of them."""
    return computed(KEPT, quick=quick, workers=workers, progress=progress)


def present(data: dict[str, Any]) -> StudyResult:
    """Numbers, figure and finding."""
    return vectors(data, CLAIM, 7, (40, 100))
