"""Figure 10: error of the least u in the lid-driven cavity against the number of particles."""

from __future__ import annotations

from typing import Any

from sphear.studies.result import Progress, StudyResult
from sphear.studies.zheng2018.cavities import computed
from sphear.studies.zheng2018.cavity_errors import errors

KEPT = "cavity"  # the runs, which figures share
CLAIM = (
    "the errors of min u fall with the particle size for all terms, and those of VISC-04 are the smallest at every size"
)


def compute(*, quick: bool, workers: int, progress: Progress) -> dict[str, Any]:
    """All runs, in what is shown of them."""
    return computed(KEPT, quick=quick, workers=workers, progress=progress)


def present(data: dict[str, Any]) -> StudyResult:
    """Numbers, figure and finding."""
    return errors(data, CLAIM, 10)
