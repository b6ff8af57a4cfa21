"""Processor time to a deviation: the lid-driven cavity by sphear, icoFoam and PySPH, each at its own best resolution.

    python benchmarks/to_an_error.py [--longest SECONDS] [--picture FILE]

The cavity starts from rest, Re = 100 to t = 20 and Re = 1000 to t = 40; the deviation is the mean of both centre-line
profiles from a time-accurate reference, as `sphear run cavity` reports it. Each program is one process on one core, and
its processor's time counts: compilation, meshes and reading off do not. Resolutions go up until the least deviation is
reached, then each is searched for the coarsest one that reaches it. Every run is kept in the file of --runs at once, by
version and processor: an interrupted search goes on there, and a longer one adds to it.

icoFoam has second order in space and time, uniform cells, and steps of Courant number 1. PYSPH_PYTHON names an
interpreter that has PySPH, if this one has not.
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Sequence
from pathlib import Path

from _bench import Report
from _cavity_programs import FIRST, PROGRAMS, UNTIL, Program
from _error_search import Computed, Kept, Search, table, time_to
from matplotlib.figure import Figure

from sphear.results.figure import save
from sphear.results.figure.style import FAINT, grid, styled

DEVIATIONS = (0.005, 0.002, 0.0012, 0.001)  # in lid speeds; 0.0012 is that of icoFoam with 200 x 200 cells
OWN = "sphear"
ASKED = {(1000, 0.0012, "icoFoam"): 10.0}  # Reynolds number, deviation, program: how many times as fast sphear is
RUNS = Path(__file__).with_suffix(".json")


def options(parser: argparse.ArgumentParser) -> None:
    """The options of this benchmark."""
    names = [program.name for program in PROGRAMS]
    parser.add_argument("--runs", type=Path, default=RUNS, metavar="FILE", help="where runs are kept")
    parser.add_argument("--longest", type=float, default=120.0, metavar="SECONDS",
                        help="of the processor; no run is begun that is expected to take longer (120)")  # fmt: skip
    parser.add_argument("--reynolds", type=int, nargs="+", choices=UNTIL, default=list(UNTIL), help="of the cavity")
    parser.add_argument("--programs", nargs="+", choices=names, default=names, metavar="NAME",
                        help=f"that compute: {', '.join(names)}")  # fmt: skip
    parser.add_argument("--again", nargs="+", choices=names, default=[], metavar="NAME",
                        help="programs whose runs on this processor are forgotten and made again")  # fmt: skip
    parser.add_argument("--picture", type=Path, metavar="FILE", help="draw deviations over time there (PNG)")


def searched(
    program: Program, version: str, processor: str, reynolds: int, kept: Kept, longest: float, report: Report
) -> Search:
    """The runs of a program at a Reynolds number, as many as the deviations want."""
    until = UNTIL[reynolds]

    def compute(side: int) -> Computed:
        steps, seconds, deviation = program.compute(reynolds, side, until)
        run = Computed(program.name, version, processor, reynolds, side, steps, seconds, deviation)
        kept.add(run)
        report.say(f"{run.program}, Re = {reynolds}, {side} a side: {seconds:.3g} s, deviation {deviation:.4f}")
        return run

    search = Search(kept.of(program.name, version, processor, reynolds), compute, longest, FIRST[reynolds])
    for deviation in DEVIATIONS:
        search.coarsest(deviation)
    return search


def tell(report: Report, reynolds: int, searches: dict[str, Search]) -> None:
    """The times to each deviation, of the coarsest run and along the curve, with ratios."""
    report.say(f"Re = {reynolds}, between resolutions:")
    along = {name: [time_to(search.runs.values(), each) for each in DEVIATIONS] for name, search in searches.items()}
    for line in table(along, DEVIATIONS, OWN):
        report.say(line)
    for name, search in searches.items():
        for deviation, between, own in zip(DEVIATIONS, along[name], along[OWN], strict=True):
            where = f"{name}, Re = {reynolds}, to {deviation:g}"
            found = search.coarsest(deviation)
            if found is not None:
                report.add(f"{where}, {found.side} a side", found.seconds, "s")
            if name != OWN and between and own:
                asked = ASKED.get((reynolds, deviation, name))
                report.add(f"  time over sphear's, {where}", between / own, at_least=asked)


@styled
def figure(runs: Sequence[Computed]) -> Figure:
    """Deviations of all runs over their processor time, a panel for each Reynolds number."""
    numbers = sorted({run.reynolds for run in runs})
    made, axes = grid(len(numbers), 2, (4.2, 3.2), "Deviation of a cavity over processor time, one core")
    for ax, reynolds in zip(axes, numbers, strict=True):
        for program in PROGRAMS:
            own = [run for run in runs if (run.program, run.reynolds) == (program.name, reynolds)]
            own = sorted((run for run in own if math.isfinite(run.deviation)), key=lambda run: run.side)
            if own:
                seconds, found = [run.seconds for run in own], [run.deviation for run in own]
                ax.loglog(seconds, found, "o-", color=program.colour, markersize=4, label=program.name)
        for deviation in DEVIATIONS:
            ax.axhline(deviation, color=FAINT, linewidth=0.6, linestyle=":")
        ax.set(title=f"Re = {reynolds}, t = {UNTIL[reynolds]}", xlabel="processor seconds", ylabel="mean deviation")
        ax.legend()
    return made


def main() -> None:
    report = Report(__doc__ or "", options)
    chosen, processor = report.options, str(report.machine["processor"])
    kept, here = Kept(chosen.runs), []
    for name in chosen.again:
        kept.drop(name, processor)
    versions = {program: program.version() for program in PROGRAMS if program.name in {OWN, *chosen.programs}}
    for sentence in sorted({program.missing for program, version in versions.items() if version is None}):
        report.say(sentence)
    for reynolds in chosen.reynolds:
        searches = {}
        for program, version in versions.items():
            if version is not None:
                search = searched(program, version, processor, reynolds, kept, chosen.longest, report)
                searches[program.name] = search
                here += search.runs.values()
        tell(report, reynolds, searches)
    if chosen.picture:
        save(figure(here), chosen.picture, "png")
    report.close()


if __name__ == "__main__":
    main()
