"""Figure 8: magnitude of the velocity in the lid-driven cavity."""

from __future__ import annotations

from typing import Any

from sphear.studies.result import Progress, StudyResult
from sphear.studies.zheng2018.cavities import computed
from sphear.studies.zheng2018.cavity_magnitude import magnitude

KEPT = "cavity"  # the runs, which figures share
CLAIM = "with VISC-04 the magnitude of the velocity is similar to that of OpenFOAM"


def compute(*, quick: bool, workers: int, progress: Progress) -> dict[str, Any]:
    """All runs, in what is shown of them."""
    return computed(KEPT, quick=quick, workers=workers, progress=progress)


def present(data: dict[str, Any]) -> StudyResult:
    """Numbers, figure and finding."""
    return magnitude(data, CLAIM, 8)
