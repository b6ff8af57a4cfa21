"""How much sooner a sweep of flows ends on two workers than on one.

Eight runs of equal length of one formula, which is compiled beforehand; starting the workers is part of the time. Where
the processors are shared with other programs the ratio falls: how much slower the time loops themselves were beside
each other than alone is printed too.
"""

from __future__ import annotations

import tempfile
import time

from _bench import Report

from sphear.sweeps import Run, Store, SweepResult, plan, run_sweep

REYNOLDS = (0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0)
PRESET = "basa2009"
STEPS = 6000  # some five seconds


def timed(runs: list[Run], workers: int) -> tuple[float, list[SweepResult]]:
    with tempfile.TemporaryDirectory() as folder:
        begin = time.perf_counter()
        results = run_sweep(runs, Store(folder), workers=workers)
        taken = time.perf_counter() - begin
    assert all(result.end == "steps" for result in results), [result.end for result in results]
    return taken, results


def main() -> None:
    report = Report(__doc__ or "")
    fixed = {"resolution": 40, "time_step": 1e-5}
    timed(plan("poiseuille", {"reynolds": REYNOLDS[:1]}, {**fixed, "max_steps": 1}, preset=PRESET), 1)  # compiles
    runs = plan("poiseuille", {"reynolds": REYNOLDS}, {**fixed, "max_steps": STEPS}, preset=PRESET)
    taken, loops = {}, {}
    for workers in (1, 2):
        taken[workers], results = timed(runs, workers)
        loops[workers] = sum(result.performance["seconds"] for result in results)
        report.add(f"{len(runs)} runs, workers: {workers}", taken[workers], "s")
    report.add("time of the time loops, beside each other / alone", loops[2] / loops[1])
    report.add("speed of a sweep, two workers / one", taken[1] / taken[2], at_least=1.8)
    report.close()


if __name__ == "__main__":
    main()
