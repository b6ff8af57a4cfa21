"""Figures 7 to 14: the lid-driven cavity without and with a cylinder. What differs is a table."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

from sphear.studies.result import Progress, StudyResult
from sphear.studies.zheng2018.cavities import CASES, computed
from sphear.studies.zheng2018.cavity_errors import errors
from sphear.studies.zheng2018.cavity_magnitude import magnitude
from sphear.studies.zheng2018.cavity_profiles import profiles
from sphear.studies.zheng2018.cavity_vectors import vectors

Shown = Callable[[dict[str, Any], str, int], StudyResult]


@dataclass(frozen=True)
class CavityFigure:
    """A figure of the runs of a cavity, which it shares with the others of that cavity.

    Attributes:
        number: of the figure.
        KEPT: the case whose runs it shows; their numbers are kept under its name.
        shown: makes the result of the numbers, the claim and the number of the figure.
        claim: what the paper says of it.
    """

    number: int
    KEPT: str
    shown: Shown
    claim: str

    def compute(self, *, quick: bool, workers: int, progress: Progress) -> dict[str, Any]:
        """All runs, in what is shown of them."""
        return computed(self.KEPT, quick=quick, workers=workers, progress=progress)

    def present(self, data: dict[str, Any]) -> StudyResult:
        """Numbers, figure and finding."""
        return self.shown(data, self.claim, self.number)


ALONE, CYLINDER = CASES
FIGURES = (
    CavityFigure(
        7,
        ALONE,
        partial(vectors, sizes=(40, 100)),
        "with 1600 and with 10,000 particles the lid drives one vortex, and at t = 40 the velocities have reached the"
        " stable state",
    ),
    CavityFigure(
        8,
        ALONE,
        magnitude,
        "with VISC-04 the magnitude of the velocity is similar to that of OpenFOAM",
    ),
    CavityFigure(
        9,
        ALONE,
        profiles,
        "the four terms give quite similar profiles; enlarged, VISC-04 agrees best, and OpenFOAM's velocities are"
        " generally higher",
    ),
    CavityFigure(
        10,
        ALONE,
        errors,
        "the errors of min u fall with the particle size for all terms, and those of VISC-04 are the smallest at every"
        " size",
    ),
    CavityFigure(
        11,
        CYLINDER,
        partial(vectors, sizes=(100,)),
        "with 100 x 100 particles, VISC-04 and a cylinder inside the results are steady at t = 40",
    ),
    CavityFigure(
        12,
        CYLINDER,
        magnitude,
        "with VISC-04 the magnitude of the velocity around the cylinder agrees qualitatively with that of OpenFOAM",
    ),
    CavityFigure(
        13,
        CYLINDER,
        profiles,
        "around the cylinder too the four terms give quite similar profiles; enlarged, VISC-04 agrees best with"
        " OpenFOAM, whose velocities are generally higher",
    ),
    CavityFigure(
        14,
        CYLINDER,
        errors,
        "around the cylinder too all errors fall with the particle size, and that of VISC-04 is the smallest",
    ),
)
STUDIES = {f"figure-{figure.number}": figure for figure in FIGURES}
