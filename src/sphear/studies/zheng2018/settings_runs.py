"""The runs behind the search for the paper's own settings: each reading until it fails or its time is reached."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from sphear.studies.kept import runs_folder
from sphear.studies.zheng2018.cavities import PAPER, REYNOLDS, TIME_STEP, UNTIL
from sphear.studies.zheng2018.settings_combinations import BY_NAME, FINE, LONG, LONG_SIZES, QUICK, READINGS
from sphear.studies.zheng2018.single_runs import gone_on_with, on_one_thread, planned

if TYPE_CHECKING:
    from sphear.cases.flow import CaseRun
    from sphear.schemes.incompressible.flow import IncompressibleFlow
    from sphear.sweeps import Run

CASE = "cavity"
SCREENED, FINE_SCREENED = 2.0, 0.5  # until when, 40 and 100 a side
QUICK_SIZE, QUICK_UNTIL = 20, 0.5
COMPUTE = f"{__name__}:compute_reading"


class Tried(NamedTuple):
    """A run.

    reading: its name.
    resolution: particles a side.
    until: when it ends.
    """

    reading: str
    resolution: int
    until: float

    def run(self) -> Run:
        """The run, its settings checked."""
        settings = {
            "time_step": TIME_STEP,
            **BY_NAME[self.reading].changes,
            "reynolds": REYNOLDS,
            "resolution": self.resolution,
            "until": self.until,
        }
        return planned(CASE, settings, PAPER)


def tried(quick: bool = False) -> list[Tried]:
    """All runs: readings one by one, then finer ones, then those to the paper's time."""
    if quick:
        return [Tried(name, QUICK_SIZE, QUICK_UNTIL) for name in QUICK]
    runs = [Tried(reading.name, LONG_SIZES[0], SCREENED) for reading in READINGS]
    runs += [Tried(name, LONG_SIZES[1], FINE_SCREENED) for name in FINE]
    return runs + [Tried(name, size, UNTIL) for size in LONG_SIZES for name in LONG]


def disorder(flow: IncompressibleFlow) -> float:
    """The root mean square of dx |sum_j V_j grad W_ij| over the particles.

    Zero where each has its neighbours in pairs on opposite sides, as on a lattice, however evenly strained.
    """
    from sphear.corrections import NoCorrection
    from sphear.interactions import Gradient

    places = flow.discretisation.at(flow.positions).particles
    ones = np.ones((places.total, 1))
    sums = places.sum(Gradient(flow.kernel, NoCorrection(), False), None, values=ones)
    return float(np.sqrt((sums**2).sum(axis=1).mean()) * flow.problem.spacing)


def measured(run: CaseRun) -> dict[str, float]:
    """The disorder and the least pressure."""
    from sphear.schemes.incompressible.flow import IncompressibleFlow

    assert isinstance(run.flow, IncompressibleFlow)
    return {"disorder": disorder(run.flow), "least_pressure": float(run.flow.pressure.min())}


def compute_reading(case: str, settings: dict[str, Any]) -> dict[str, Any]:
    """Compute a run to its end, with the disorder and the least pressure at each output.

    It goes on where it was saved last, also by a shorter run of the same settings.
    """
    from sphear.cases.flow import FLOWS, CaseRun
    from sphear.simulation.saved import forget
    from sphear.sweeps import Run
    from sphear.sweeps.result import record

    chosen = on_one_thread(case, settings)
    saved = runs_folder(PAPER) / f"{Run(case, chosen.model_copy(update={'until': UNTIL})).key}.npz"
    run = gone_on_with(lambda: CaseRun(FLOWS[case], chosen, measured=measured), saved)
    run.run(keep=saved)
    if run.end == "time" and chosen.until != UNTIL:
        run.save(saved)
    else:
        forget(saved)
    return record(run)
