"""Figure 11: set-up, velocities and particles in the cavity with a cylinder."""

from __future__ import annotations

from typing import Any

from sphear.studies.result import Progress, StudyResult
from sphear.studies.zheng2018.cavities import computed
from sphear.studies.zheng2018.cavity_vectors import vectors

KEPT = "cavity-cylinder"  # the runs, which figures share
CLAIM = "with 100 x 100 particles, VISC-04 and a cylinder inside the results are steady at t = 40"


def compute(*, quick: bool, workers: int, progress: Progress) -> dict[str, Any]:
    """All runs, in what is shown of them."""
    return computed(KEPT, quick=quick, workers=workers, progress=progress)


def present(data: dict[str, Any]) -> StudyResult:
    """Numbers, figure and finding."""
    return vectors(data, CLAIM, 11, (100,))
