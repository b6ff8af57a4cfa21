"""Why the engine's defaults are what they are: lanes of a sweep, precision, and the width of the cells.

Pressure and Morris viscosity, Wendland C2, 29 neighbours, one thread, everything timed in turn. A sweep is compiled for
4, 8 or 16 neighbours at once, in float64 and float32; the cells of the neighbour search are a whole, a half or a third
of the support wide. Lanes are changed, and cells too, by changing the module's own constants.
"""

from __future__ import annotations

from collections.abc import Mapping
from unittest import mock

from _bench import Measurement, Report, best_of, clocked
from _case import Case

from sphear.engine import flags, program
from sphear.engine import sweep as engine
from sphear.neighbours import cells, pair_list

LANES = {"float64": (4, 8), "float32": (4, 8, 16)}
REACHES = (1, 2, 3)


def with_lanes(case: Case, dtype: str, lanes: int) -> engine.Sweep:
    """The case's sweep, compiled for so many neighbours at once."""
    engine._compiled.cache_clear()
    with mock.patch.object(program, "lane_count", return_value=lanes):
        return engine.Sweep(case.interaction, case.neighbours, case.fields, dtype=dtype)


def with_reach(case: Case, reach: int) -> Measurement:
    """The time of a search with cells of the support over `reach`."""

    def measure() -> Mapping[str, float]:
        with mock.patch.object(cells, "REACH", reach), mock.patch.object(pair_list, "REACH", reach):
            pair_list._builder.cache_clear()
            case.search()
            return clocked(f"reach {reach}", case.search, 3)()

    return measure


def main() -> None:
    report = Report(__doc__ or "")
    for side in (100, 316):
        case = Case(side)
        sweeps = [
            clocked(f"{dtype} {lanes}", with_lanes(case, dtype, lanes).everywhere, 5)
            for dtype in LANES
            for lanes in LANES[dtype]
        ]
        times = best_of(10, *sweeps, *(with_reach(case, reach) for reach in REACHES))
        pair_list._builder.cache_clear()
        default = times[f"float64 {flags.lane_count('float64')}"]
        for dtype, numbers in LANES.items():
            for lanes in numbers:
                chosen = " (default)" if lanes == flags.lane_count(dtype) else ""
                what = f"{side}x{side}, speed, {dtype} in {lanes} lanes{chosen} / default"
                report.add(what, default / times[f"{dtype} {lanes}"])
        for reach in REACHES:
            chosen = " (default)" if reach == cells.REACH else ""
            what = f"{side}x{side}, speed, search with {reach} cells a support{chosen} / default"
            report.add(what, times[f"reach {cells.REACH}"] / times[f"reach {reach}"])
    report.close()


if __name__ == "__main__":
    main()
