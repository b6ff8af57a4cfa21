"""The runs behind figures 7 to 14: the lid-driven cavity without and with a cylinder, with each viscous term.

The scheme's default settings, and beside them the paper's own (the preset `zheng2018`, with its time step), as they are
and with particle shifting, which the paper does not have. Each run is kept as it ends, and one that is interrupted goes
on from where it was saved last.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

from sphear.progress import no_progress
from sphear.references.zheng2018 import TERMS as PAPER_TERMS
from sphear.studies.kept import runs_folder, store, swept
from sphear.studies.result import Progress
from sphear.studies.zheng2018.single_runs import gone_on_with, on_one_thread, planned

if TYPE_CHECKING:
    from sphear.cases.flow import CaseRun
    from sphear.sweeps import Run, SweepResult

PAPER = "zheng2018"
CASES = ("cavity", "cavity-cylinder")
TERMS = (*PAPER_TERMS.values(), "fatehi_manzari")
SIZES = (40, 80, 100, 160, 200)  # particles a side
OWN_SIZES = (40, 100)  # with the paper's own settings
QUICK_SIZES, QUICK_UNTIL = (20, 30), 4.0
REYNOLDS, UNTIL = 1000.0, 40.0
SLOW_REYNOLDS, SLOW_UNTIL, SLOW_SIZE = 100.0, 20.0, 50
TIME_STEP = 0.001  # of the paper
DEFAULTS = "defaults"
SHIFTED = "zheng2018 with shifting"
DRAWN = "oger"  # the term whose fields are drawn
POINTS = 40  # a side, where fields are sampled
PARTICLES_DRAWN = (20, 30, 40, 100)  # sizes whose particles are kept

COMPUTE = f"{__name__}:compute_run"


class Wanted(NamedTuple):
    """A run.

    case: a flow.
    viscosity: the viscous term.
    resolution: particles a side.
    reynolds: of the lid.
    until: when it ends.
    preset: `DEFAULTS`, those of the scheme, "zheng2018", or `SHIFTED`, those with particle shifting.
    """

    case: str
    viscosity: str
    resolution: int
    reynolds: float = REYNOLDS
    until: float = UNTIL
    preset: str = DEFAULTS

    def run(self) -> Run:
        """The run, its settings checked."""
        preset = None if self.preset == DEFAULTS else PAPER
        own: dict[str, Any] = {"time_step": TIME_STEP} if preset else {}
        own |= {"shifting": "lind", "shifting_strength": 1.0} if self.preset == SHIFTED else {}
        named = {key: getattr(self, key) for key in ("viscosity", "resolution", "reynolds", "until")}
        return planned(self.case, {**own, **named}, preset)


def wanted(case: str, quick: bool = False) -> list[Wanted]:
    """All runs of a case, those that the figures compare first."""
    if quick:
        return [Wanted(case, term, size, until=QUICK_UNTIL) for size in QUICK_SIZES for term in TERMS]
    runs = [Wanted(case, term, size) for size in SIZES for term in TERMS]
    own = PAPER_TERMS.values() if case == "cavity" else (DRAWN,)
    runs += [Wanted(case, term, size, preset=PAPER) for size in OWN_SIZES for term in own]
    runs += [Wanted(case, DRAWN, size, preset=SHIFTED) for size in OWN_SIZES]
    if case == "cavity":
        runs += [Wanted(case, term, SLOW_SIZE, SLOW_REYNOLDS, SLOW_UNTIL) for term in TERMS]
    return runs


class Study:
    """Runs and where they are kept.

    Args:
        selection: the runs.
    """

    def __init__(self, selection: Iterable[Wanted]) -> None:
        self.selection = list(selection)

    @cached_property
    def runs(self) -> dict[Wanted, Run]:
        """By what is wanted."""
        return {each: each.run() for each in self.selection}

    def compute(self, workers: int, progress: Progress = no_progress) -> dict[Wanted, SweepResult]:
        """Compute what is not kept, short runs first.

        Raises:
            SphearError: a run was lost.
        """
        for run in self.runs.values():
            if self._stale(run):
                store(PAPER).path(run).unlink()
        results = swept(list(self.runs.values()), PAPER, workers, progress, compute=COMPUTE, longest_first=False)
        return dict(zip(self.runs, results, strict=True))

    def kept(self) -> dict[Wanted, SweepResult]:
        """The results so far."""
        found = {each: store(PAPER).get(run) for each, run in self.runs.items() if not self._stale(run)}
        return {each: result for each, result in found.items() if result is not None}

    def _stale(self, run: Run) -> bool:
        """True if the result of a run was computed when some setting had another default."""
        result = store(PAPER).get(run)
        if result is None:
            return False
        if not {"time", "steps"} <= result.metrics.keys():  # damaged
            return True
        return any(not _same(result.settings.get(key), value) for key, value in run.given.items())


def _same(kept: Any, wanted: Any) -> bool:
    """True if a resolved setting is the one asked for; one that nothing was asked of, or that is new, is."""
    if isinstance(kept, float) and isinstance(wanted, float):
        return math.isclose(kept, wanted, rel_tol=1e-9)
    return kept is None or wanted is None or bool(kept == wanted)


def computed(case: str, *, quick: bool, workers: int, progress: Progress) -> dict[str, Any]:
    """The numbers of all runs of a case that are shown."""
    from sphear.studies.zheng2018.cavity_rows import data_of

    return data_of(case, Study(wanted(case, quick)).compute(workers, progress), quick)


def selected(cases: Collection[str], at_most: int | None = None, terms: Collection[str] | None = None) -> list[Wanted]:
    """Some of the runs of cases: of so many particles a side at most, with these terms."""
    return [
        each
        for case in cases
        for each in wanted(case)
        if (at_most is None or each.resolution <= at_most) and (terms is None or each.viscosity in terms)
    ]


def compute_run(case: str, settings: dict[str, Any]) -> dict[str, Any]:
    """Compute a run to its end, or to its failure, going on where it was saved last; fields are kept as profiles."""
    from sphear.cases.flow import FLOWS, CaseRun
    from sphear.simulation.saved import forget
    from sphear.sweeps import Run
    from sphear.sweeps.result import record

    chosen_settings = on_one_thread(case, settings)
    saved = runs_folder(PAPER) / f"{Run(case, chosen_settings).key}.npz"
    run = gone_on_with(lambda: CaseRun(FLOWS[case], chosen_settings), saved)
    run.run(keep=saved)
    forget(saved)
    whole = record(run)
    if "profiles" in whole and settings["viscosity"] == DRAWN:
        whole["profiles"] |= fields(run)
    return whole


def fields(run: CaseRun) -> dict[str, list[float | None]]:
    """Both velocities at the centres of `POINTS` x `POINTS` squares, row by row from below, and where particles are.

    Where there is no fluid, the velocities are None.
    """
    import numpy as np

    from sphear.simulation.interpolation import interpolated

    flow = run.flow
    ticks = (np.arange(POINTS) + 0.5) / POINTS
    points = np.stack(np.meshgrid(ticks, ticks), axis=-1).reshape(-1, 2)
    inside = np.ones(len(points), bool) if flow.problem.shape is None else flow.problem.shape.distance(points) > 0
    values = np.full((len(points), 2), np.nan)
    values[inside] = interpolated(flow, points[inside])
    kept: dict[str, list[float | None]] = {
        f"field_{name}": [None if np.isnan(x) else float(x) for x in np.round(column, 4)]
        for name, column in zip("uv", values.T, strict=True)
    }
    if run.settings.resolution in PARTICLES_DRAWN:
        kept |= {f"particles_{name}": np.round(flow.positions[:, k], 4).tolist() for k, name in enumerate("xy")}
    return kept
