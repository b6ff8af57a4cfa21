"""A sweep and a search on two threads against one, by the clock on the wall, which other programs disturb.

So two more ratios stand beside: what the machine gives at the time, as a whole sweep on each of two threads; and what
two undisturbed processors would give, from the processor's time (equal shares assumed). 316 x 316 particles, pressure
and Morris viscosity, Wendland C2, 29 neighbours; all timed in turn.
"""

from __future__ import annotations

import time
from threading import Thread

from _bench import Report, best_of, clocked
from _case import Case

SIDE = 316


def measure(report: Report, each_pair_once: bool, at_least: float | None) -> None:
    one, two, other = (Case(SIDE, threads=count, each_pair_once=each_pair_once) for count in (1, 2, 1))

    def side_by_side() -> None:
        thread = Thread(target=other.sweep.everywhere)
        thread.start()
        one.sweep.everywhere()
        thread.join()

    calls = {
        "one": one.sweep.everywhere,
        "two": two.sweep.everywhere,
        "both": side_by_side,
        "search on one": one.search,
        "search on two": two.search,
    }
    by_wall = (clocked(name, call, 5, time.perf_counter) for name, call in calls.items())
    by_processor = (clocked(f"{name}, processor", calls[name], 5, time.process_time) for name in ("one", "two"))
    times = best_of(12, *by_wall, *by_processor)
    how = f"each pair {'once' if each_pair_once else 'twice'}"
    report.add(f"speed of a sweep, {how}, two threads / one", times["one"] / times["two"], at_least=at_least)
    report.add("the same on undisturbed processors", 2 * times["one, processor"] / times["two, processor"])
    report.add("speed of two sweeps, side by side / one by one", 2 * times["one"] / times["both"])
    report.add(f"speed of the search, {how}, two threads / one", times["search on one"] / times["search on two"])


def main() -> None:
    report = Report(__doc__ or "")
    measure(report, each_pair_once=False, at_least=1.8)
    measure(report, each_pair_once=True, at_least=None)
    report.close()


if __name__ == "__main__":
    main()
