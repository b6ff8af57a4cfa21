"""Runs of programs at resolutions, kept in a file, and the search for the coarsest that is as close as asked for."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict, dataclass
from itertools import pairwise
from pathlib import Path

GROWTH = 1.25  # of resolutions on the way up
GRAIN = 4  # resolutions are multiples of it, so that cells lie on both sides of a centre line
CLOSE = 0.06  # of a resolution: two that differ by less are not told apart
COST = 3.0  # processor time grows at least with this power of the resolution: cells, and steps


@dataclass(frozen=True)
class Computed:
    """A run: by which program on which processor, particles or cells a side, processor seconds, and how far it is off.

    deviation: mean deviation of both centre-line profiles, in lid speeds; infinite for a run that failed.
    """

    program: str
    version: str
    processor: str
    reynolds: int
    side: int
    steps: int
    seconds: float
    deviation: float


Runner = Callable[[int], Computed]


class Kept:
    """All runs that were ever made, in a file that is written anew after each."""

    def __init__(self, file: Path) -> None:
        self.file = file
        rows = json.loads(file.read_text(encoding="utf-8")) if file.exists() else []
        self.runs = [Computed(**{**row, "deviation": float(row["deviation"])}) for row in rows]

    def drop(self, program: str, processor: str) -> None:
        """Forget the runs of a program on this processor, so that they are made again."""
        self.runs = [run for run in self.runs if (run.program, run.processor) != (program, processor)]

    def add(self, run: Computed) -> None:
        """Keep a run; the file is whole at any time."""
        self.runs.append(run)
        self.runs.sort(key=lambda run: (run.processor, run.program, run.reynolds, run.side))
        rows = [asdict(run) | ({} if math.isfinite(run.deviation) else {"deviation": "inf"}) for run in self.runs]
        beside = self.file.with_suffix(".part")
        beside.write_text("[\n " + ",\n ".join(map(json.dumps, rows)) + "\n]\n", encoding="utf-8")
        beside.replace(self.file)

    def of(self, program: str, version: str, processor: str, reynolds: int) -> dict[int, Computed]:
        """The runs of a program at a Reynolds number, by resolution."""
        wanted = (program, version, processor, reynolds)
        found = (run for run in self.runs if (run.program, run.version, run.processor, run.reynolds) == wanted)
        return {run.side: run for run in found}


@dataclass
class Search:
    """The search with one program at one Reynolds number.

    Args:
        runs: those that are known, by resolution; what is computed is added.
        compute: makes a run.
        longest: processor seconds; no run is begun that is expected to take longer.
        first: the resolution to begin with.
    """

    runs: dict[int, Computed]
    compute: Runner
    longest: float = math.inf
    first: int = GRAIN

    def expected(self, side: int) -> float:
        """Processor seconds of a run, from that of the nearest resolution; zero if nothing is known."""
        if not self.runs:
            return 0.0
        nearest = min(self.runs.values(), key=lambda run: abs(run.side - side))
        return float(nearest.seconds * (side / nearest.side) ** COST)

    def at(self, side: int) -> Computed | None:
        """The run at a resolution, computed if it is not known; None if it would take too long."""
        if side not in self.runs:
            if self.expected(side) > self.longest:
                return None
            self.runs[side] = self.compute(side)
        return self.runs[side]

    def coarsest(self, deviation: float) -> Computed | None:
        """The coarsest run that is as close as that, to within `CLOSE` of its resolution; None if none was found.

        Upwards from the first resolution to one that is close enough, then by bisection below it. Deviations of
        particles scatter, so that a coarser one may be as close by chance; it counts where the search meets it.
        """
        below, side = 0, self.first
        while (run := self.at(side)) is not None and run.deviation > deviation:
            below, side = side, multiple(GROWTH * side, above=side)
        if run is None or not below:
            return run
        found = run
        while found.side - below > max(GRAIN, CLOSE * found.side):
            middle = self.at(multiple(math.sqrt(below * found.side), above=below))
            if middle is None:
                break
            if middle.deviation <= deviation:
                found = middle
            else:
                below = middle.side
        return found


def multiple(side: float, above: int) -> int:
    """The multiple of `GRAIN` nearest to a resolution, above another."""
    return max(GRAIN * round(side / GRAIN), above + GRAIN)


def time_to(runs: Iterable[Computed], deviation: float) -> float | None:
    """Processor seconds at which the curve of least deviations crosses one, between two runs; None beyond the curve.

    Runs that take longer and are no closer than another are not on the curve; between its points logarithms are
    interpolated. So what lies between two resolutions of one program does not count against it.
    """
    curve: list[Computed] = []
    for run in sorted(runs, key=lambda run: run.seconds):
        if math.isfinite(run.deviation) and (not curve or run.deviation < curve[-1].deviation):
            curve.append(run)
    for a, b in pairwise(curve):
        if b.deviation <= deviation <= a.deviation:
            part = math.log(a.deviation / deviation) / math.log(a.deviation / b.deviation)
            return float(a.seconds * (b.seconds / a.seconds) ** part)
    return None


def table(times: dict[str, Sequence[float | None]], deviations: Sequence[float], own: str) -> list[str]:
    """Lines of a table: seconds of each program to each deviation, and how many times those of `own` they are."""
    lines = [f"  {'processor seconds to':<24}" + "".join(f"{deviation:>20g}" for deviation in deviations)]
    for program, seconds in times.items():
        cells = []
        for taken, mine in zip(seconds, times[own], strict=True):
            ratio = f" ({taken / mine:.2g} x)" if taken and mine and program != own else ""
            cells.append(f"{'not reached' if taken is None else f'{taken:.3g}{ratio}':>20}")
        lines.append(f"  {program:<24}" + "".join(cells))
    return lines
