"""The runs behind the search for the paper's own settings: each reading until it fails or its time is reached."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from sphear.studies.kept import runs_folder
from sphear.studies.zheng2018.cavities import PAPER, REYNOLDS, TIME_STEP, UNTIL
from sphear.studies.zheng2018.settings_combinations import BY_NAME, FINE, LONG, LONG_SIZES, QUICK, READINGS

if TYPE_CHECKING:
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
        from sphear.sweeps import plan

        settings = {
            "time_step": TIME_STEP,
            **BY_NAME[self.reading].changes,
            "reynolds": REYNOLDS,
            "resolution": self.resolution,
            "until": self.until,
        }
        return plan(CASE, {}, {"scheme": "incompressible", **settings}, preset=PAPER)[0]


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


def compute_reading(case: str, settings: dict[str, Any]) -> dict[str, Any]:
    """Compute a run to its end, with the disorder and the least pressure at each output.

    It goes on where it was saved last, also by a shorter run of the same settings.
    """
    from sphear.cases.flow import FLOWS, FlowRun
    from sphear.errors import SphearError
    from sphear.sweeps import Run
    from sphear.sweeps.result import record

    if settings.get("threads", 1) is None:
        settings = {**settings, "threads": 1}
    chosen = FLOWS[case].settings(**settings)
    saved = runs_folder(PAPER) / f"{Run(case, chosen.model_copy(update={'until': UNTIL})).key}.npz"
    run: Any = FlowRun(FLOWS[case], chosen)
    if saved.exists():
        try:
            run.restore(saved)
        except SphearError:  # of other settings, or further on
            run = FlowRun(FLOWS[case], chosen)

    def observe(_: str) -> None:
        flow = run.flow
        with np.errstate(all="ignore"):
            run.history[-1] |= {"disorder": disorder(flow), "least_pressure": float(flow.pressure.min())}

    run.run(observe, keep=saved)
    if run.end == "time" and chosen.until != UNTIL:
        run.save(saved)
    else:
        saved.unlink(missing_ok=True)
    return record(run)
