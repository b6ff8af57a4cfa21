"""Figure 13: profiles of the cavity with a cylinder, with each viscous term."""

from __future__ import annotations

from typing import Any

from sphear.studies.result import Progress, StudyResult
from sphear.studies.zheng2018.cavities import computed
from sphear.studies.zheng2018.cavity_profiles import profiles

KEPT = "cavity-cylinder"  # the runs, which figures share
CLAIM = (
    "around the cylinder too the four terms give quite similar profiles; enlarged, VISC-04 agrees best with "
    "OpenFOAM, whose velocities are generally higher"
)


def compute(*, quick: bool, workers: int, progress: Progress) -> dict[str, Any]:
    """All runs, in what is shown of them."""
    return computed(KEPT, quick=quick, workers=workers, progress=progress)


def present(data: dict[str, Any]) -> StudyResult:
    """Numbers, figure and finding."""
    return profiles(data, CLAIM, 13)
