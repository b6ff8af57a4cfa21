"""Figure 14: error of the least u in the cavity with a cylinder against the number of particles."""

from __future__ import annotations

from typing import Any

from sphear.studies.result import Progress, StudyResult
from sphear.studies.zheng2018.cavities import computed
from sphear.studies.zheng2018.cavity_errors import errors

KEPT = "cavity-cylinder"  # the runs, which figures share
CLAIM = "around the cylinder too all errors fall with the particle size, and that of VISC-04 is the smallest"


def compute(*, quick: bool, workers: int, progress: Progress) -> dict[str, Any]:
    """All runs, in what is shown of them."""
    return computed(KEPT, quick=quick, workers=workers, progress=progress)


def present(data: dict[str, Any]) -> StudyResult:
    """Numbers, figure and finding."""
    return errors(data, CLAIM, 14)
