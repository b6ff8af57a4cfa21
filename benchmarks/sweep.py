"""A sweep over all pairs (pressure and Morris viscosity), and the pair list, against hand-written C++.

The same particles, formula and core: sphear's compiled sweep of `ViscousForce` and `PressureForce`, that of flows, and
roofline.cpp, which does the same over the memory layouts that particle codes use. Both are checked against each other,
then timed in turn; of each layout the best cell width and number of lanes counts.

    cell_auto   cells, vectorised by the compiler      csr_gather  pair list, vectorised by the compiler
    cell_vec    cells, explicit vectors                csr_aos     pair list, whole records transposed in registers
    sym_vec     cells, each pair once                  half_aos    the same, each pair once
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from functools import partial
from pathlib import Path

import _roofline
from _bench import Report, best_of, clocked
from _case import Case

from sphear import CubicSpline
from sphear.neighbours.cell_sort import cell_sort

FIRST_SEARCH = f"""
import sys, time
sys.path.insert(0, {str(Path(__file__).parent)!r})
from _bench import best_of, clocked, jittered_square
from _case import SUPPORT_OVER_DX, Case
from sphear import Neighbours

Case(20)  # compiles
positions = jittered_square(316)
begin = time.thread_time()
Neighbours(positions, SUPPORT_OVER_DX / 316, threads=1)
first = time.thread_time() - begin
print(first / best_of(1, clocked("sweep", Case(316).over))["sweep"])
"""


def compare(report: Report, side: int, program: Path | None, particles: Path) -> None:
    """sphear's sweep against every layout, its pair list against its sweep."""
    case, cubic, once = Case(side), Case(side, CubicSpline), Case(side, each_pair_once=True)
    measurements = [
        clocked("sweep", case.over, 5),
        clocked("everywhere", case.sweep.everywhere, 5),
        clocked("with packing", lambda: case.packed().everywhere(), 5),
        clocked("once", once.sweep.everywhere, 5),
        clocked("cubic spline", cubic.over, 5),
        clocked("search", case.search, 5),
        clocked("search once", once.search, 5),
        clocked("cell sort", partial(cell_sort, case.positions, case.support), 5),
    ]
    if program:
        case.over()
        case.write(particles)
        _roofline.check(program, particles, case.out)
        _roofline.check(program, particles, once.sweep.everywhere())
        measurements.append(_roofline.measurement(program, particles))
    times = best_of(10, *measurements)

    def add(
        what: str, over: float, under: float, *, at_least: float | None = None, at_most: float | None = None
    ) -> None:
        report.add(f"{side}x{side}, {what}", over / under, at_least=at_least, at_most=at_most)

    pairs = case.neighbours.pairs / case.count
    report.say(f"{side}x{side}, {pairs:.1f} neighbours, {case.count / times['sweep'] / 1e6:.1f} million particles/s")
    add("with packing / without", times["with packing"], times["everywhere"])
    add("speed, each pair once / twice", times["everywhere"], times["once"])
    if program:
        fastest = min(_roofline.FULL, key=times.__getitem__)
        add("speed, sphear / cell_auto", times["cell_auto"], times["sweep"], at_least=1.5)
        add(f"speed, sphear / fastest full layout ({fastest})", times[fastest], times["sweep"], at_least=0.6)
        for name in (*_roofline.FULL[1:], *_roofline.ONCE):
            add(f"speed, sphear / {name}", times[name], times["sweep"])
        add("speed, sphear, each pair once / half_aos", times["half_aos"], times["once"])
        add("speed, sort and list, sphear / C++", times["sort"] + times["build"], times["search"])
    add("sort and list in sweeps, Wendland C2", times["search"], times["sweep"], at_most=1.3)
    add("sort and list in sweeps, cubic spline", times["search"], times["cubic spline"], at_most=1.3)
    add("the sort alone in sweeps, Wendland C2", times["cell sort"], times["sweep"])
    add("sort and list of each pair once in sweeps of that kind", times["search once"], times["once"])


def first_search(report: Report) -> None:
    """The first search of a process, whose memory comes from the operating system page by page."""
    ratios = [float(subprocess.check_output([sys.executable, "-c", FIRST_SEARCH])) for _ in range(5)]
    report.add("316x316, sort and list in sweeps, first of a process", min(ratios))


def main() -> None:
    report = Report(__doc__ or "")
    with tempfile.TemporaryDirectory() as folder:
        program = _roofline.build(Path(folder))
        if isinstance(program, str):
            report.say(program)
        for side in (100, 316):
            compare(report, side, program if isinstance(program, Path) else None, Path(folder) / "particles")
    first_search(report)
    report.close()


if __name__ == "__main__":
    main()
