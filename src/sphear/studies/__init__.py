"""Studies: each table and figure of a paper, computed again and compared.

The catalogue knows the title and the module of each item, so that it can be listed without importing any.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, cast

from sphear.names import unknown
from sphear.progress import no_progress
from sphear.studies.kept import LongStudy, ShortStudy, kept
from sphear.studies.result import Progress, StudyResult

if TYPE_CHECKING:
    from typing_extensions import TypeIs

PAPERS = {
    "zheng2018": "Zheng, Ma & Shao 2018, Study on SPH viscosity term formulations, Applied Sciences 8(2):249",
    "basa2009": (
        "Basa, Quinlan & Lastiwka 2009, Robustness and accuracy of SPH formulations for viscous flow, IJNMF 60:1127"
    ),
}

ITEMS: dict[str, dict[str, str]] = {
    "zheng2018": {
        "table-1": "errors of four viscous terms on a lattice",
        "table-2": "errors of four viscous terms on jittered particles",
        "table-3": "time that four viscous terms take",
        "figure-1": "the particles, on a lattice and jittered",
        "figure-2": "the Laplacian along x = 0.5 on a lattice",
        "figure-3": "convergence on a lattice",
        "figure-4": "the Laplacian along x = 0.5 on jittered particles",
        "figure-5": "convergence on jittered particles",
        "figure-6": "time against the number of particles",
        "figure-7": "velocities and particles in the lid-driven cavity",
        "figure-8": "magnitude of the velocity in the lid-driven cavity",
        "figure-9": "profiles of the lid-driven cavity with each viscous term",
        "figure-10": "error of the least u in the lid-driven cavity against the number of particles",
        "figure-11": "set-up, velocities and particles in the cavity with a cylinder",
        "figure-12": "magnitude of the velocity in the cavity with a cylinder",
        "figure-13": "profiles of the cavity with a cylinder, with each viscous term",
        "figure-14": "error of the least u in the cavity with a cylinder against the number of particles",
        "settings": "readings of the settings that the paper states and does not, by how long they hold",
    },
    "basa2009": {
        "figure-1": "second derivatives of the cubic spline in 2-D",
        "figure-2": "compressible channel with and without pressure reduction",
        "figure-4": "wall treatments a short time after the start",
        "figure-5": "when channels fail, and their errors",
        "figure-7": "kinetic energy and drift of a failing channel",
        "figure-8": "velocities in the lid-driven cavity",
        "figure-9": "kinetic energy in the lid-driven cavity",
        "figure-10": "profiles of the lid-driven cavity",
        "findings": "each finding of the paper, confirmed or contradicted",
    },
}

TOGETHER = {
    "zheng2018": {
        "profile_figures": ("figure-2", "figure-4"),
        "convergence_figures": ("figure-3", "figure-5"),
        "cavity_figures": tuple(f"figure-{number}" for number in range(7, 15)),
    },
    "basa2009": {},
}
"""Items that one module has as its `STUDIES`; each other item is a module of its own."""


def items(paper: str, wanted: list[str]) -> list[str]:
    """The items asked for, all if none; raises SphearError for an unknown paper or item."""
    if paper not in ITEMS:
        raise unknown("paper", paper, ITEMS)
    for item in wanted:
        if item not in ITEMS[paper]:
            raise unknown(f"item of {paper}", item, ITEMS[paper])
    return list(dict.fromkeys(wanted)) or list(ITEMS[paper])


def study_of(paper: str, item: str) -> LongStudy | ShortStudy:
    """The study of a table or figure: its module, or an object of the module that it shares with others like it.

    Raises:
        SphearError: there is no such paper or item.
    """
    (item,) = items(paper, [item])
    for module, together in TOGETHER[paper].items():
        if item in together:
            studies: dict[str, LongStudy | ShortStudy] = import_module(f"sphear.studies.{paper}.{module}").STUDIES
            return studies[item]
    return cast("LongStudy | ShortStudy", import_module(f"sphear.studies.{paper}.{item.replace('-', '_')}"))


def is_long(study: LongStudy | ShortStudy) -> TypeIs[LongStudy]:
    """True if numbers of a study are kept with the package."""
    return hasattr(study, "compute")


def kept_as(study: LongStudy, item: str) -> str:
    """The name under which the numbers of an item are kept: figures of the same runs share them."""
    return str(getattr(study, "KEPT", item))


def reproduce(
    paper: str,
    item: str,
    *,
    quick: bool = False,
    rerun: bool = False,
    workers: int = 1,
    progress: Progress = no_progress,
) -> StudyResult:
    """Compute one table or figure again; of a long one take the numbers that are kept with the package.

    Args:
        paper: a key of `ITEMS`.
        item: such as "table-1".
        quick: fewer seeds and sizes, where the item is long.
        rerun: compute long ones too.
        workers: processes for the runs of long ones.
        progress: told what is being computed.
    """
    study = study_of(paper, item)
    if is_long(study):
        where = kept_as(study, item)
        computed = quick or rerun
        data = study.compute(quick=quick, workers=workers, progress=progress) if computed else kept(paper, where)
        return study.present(data)
    return study.run(quick=quick, progress=progress)
