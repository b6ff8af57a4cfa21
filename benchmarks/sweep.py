"""A sweep over all pairs (pressure and Morris viscosity), and the pair list, against hand-written C++.

The same particles, formula and core: sphear's compiled `Momentum` sweep, and roofline.cpp, which does the same over the
memory layouts that particle codes use. Both are checked against each other, then timed in turn; of each layout the best
cell width and number of lanes counts.

    cell_auto   cells, vectorised by the compiler      csr_gather  pair list, vectorised by the compiler
    cell_vec    cells, explicit vectors                csr_aos     pair list, whole records transposed in registers
    sym_vec     cells, each pair once                  half_aos    the same, each pair once
"""

from __future__ import annotations

import tempfile
from functools import partial
from pathlib import Path

import _roofline
import numpy as np
from _bench import Report, best_of, clocked, jittered_square

from sphear import CubicSpline, Kernel, Morris, Neighbours, NoCorrection, WendlandC2
from sphear.engine.sweep import Sweep
from sphear.interactions import Momentum
from sphear.neighbours.cells import cell_sort

SUPPORT_OVER_DX = 3.09  # 29 neighbours
ETA = 0.1  # smoothing lengths
VISCOSITY = 0.01


class Case:
    """Particles on a jittered lattice in open space, and sphear's sweep over them."""

    def __init__(
        self, side: int, kernel: type[Kernel] = WendlandC2, threads: int = 1, each_pair_once: bool = False
    ) -> None:
        random = np.random.default_rng(1)
        self.positions, self.support = jittered_square(side), SUPPORT_OVER_DX / side
        self.count, self.mass, self.threads, self.once = side**2, 1 / side**2, threads, each_pair_once
        density = 1 + 0.01 * random.random(self.count)
        self.fields = {
            "velocity": random.standard_normal((self.count, 2)),
            "pressure_over_density2": random.random(self.count),
            "density": density,
            "volume": self.mass / density,
            "mass": np.full(self.count, self.mass),
            "dynamic_viscosity": np.full(self.count, VISCOSITY),
        }
        self.interaction = Momentum(Morris(eta=ETA), kernel(self.support / 2), NoCorrection())
        self.neighbours = self.search()
        self.sweep = self.packed()
        self.out = np.empty((self.count, 2))
        self.targets = [self.neighbours.particles(chunk) for chunk in self.neighbours.chunks]

    def search(self) -> Neighbours:
        return Neighbours(self.positions, self.support, threads=self.threads, each_pair_once=self.once)

    def packed(self) -> Sweep:
        return Sweep(self.interaction, self.neighbours, self.fields, each_pair_once=self.once)

    def over(self) -> None:
        for chunk, target in zip(self.neighbours.chunks, self.targets, strict=True):
            self.sweep.over(chunk, self.out, target)

    def write(self, file: Path) -> None:
        names = ("velocity", "pressure_over_density2", "density")
        fields = {name: self.fields[name] for name in names}
        _roofline.write_particles(
            file, self.support, ETA * self.support / 2, VISCOSITY, self.mass, self.positions, **fields
        )


def compare(report: Report, side: int, program: Path | None, particles: Path) -> None:
    """sphear's sweep against every layout, its pair list against its sweep."""
    case, cubic, once = Case(side), Case(side, CubicSpline), Case(side, each_pair_once=True)
    measurements = [
        clocked("sweep", case.over, 5),
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

    def add(what: str, over: float, under: float, **asked: float) -> None:
        report.add(f"{side}x{side}, {what}", over / under, **asked)

    pairs = case.neighbours.pairs / case.count
    report.say(f"{side}x{side}, {pairs:.1f} neighbours, {case.count / times['sweep'] / 1e6:.1f} million particles/s")
    add("with packing / without", times["with packing"], times["sweep"])
    add("speed, each pair once / twice", times["sweep"], times["once"])
    if program:
        fastest = min(_roofline.FULL, key=times.__getitem__)
        add("speed, sphear / cell_auto", times["cell_auto"], times["sweep"], at_least=1.5)
        add(f"speed, sphear / fastest full layout ({fastest})", times[fastest], times["sweep"], at_least=0.6)
        for name in _roofline.FULL + _roofline.ONCE:
            add(f"speed, sphear / {name}", times[name], times["sweep"])
        add("speed, sphear, each pair once / half_aos", times["half_aos"], times["once"])
        add("speed, sort and list, sphear / C++", times["sort"] + times["build"], times["search"])
    add("sort and list in sweeps, Wendland C2", times["search"], times["sweep"], at_most=1.3)
    add("sort and list in sweeps, cubic spline", times["search"], times["cubic spline"], at_most=1.3)
    add("the sort alone in sweeps, Wendland C2", times["cell sort"], times["sweep"])
    add("sort and list of each pair once in sweeps of that kind", times["search once"], times["once"])


def main() -> None:
    report = Report(__doc__ or "")
    with tempfile.TemporaryDirectory() as folder:
        program = _roofline.build(Path(folder))
        if isinstance(program, str):
            report.say(program)
        for side in (100, 316):
            compare(report, side, program if isinstance(program, Path) else None, Path(folder) / "particles")
    for once in (False, True):
        one, two = (Case(316, threads=threads, each_pair_once=once) for threads in (1, 2))
        times = best_of(5, clocked("one", one.sweep.everywhere, 3), clocked("two", two.sweep.everywhere, 3))
        what = f"316x316, two threads / one, each pair {'once' if once else 'twice'}"
        report.add(what, times["one"] / times["two"], **({} if once else {"at_least": 1.8}))
    report.close()


if __name__ == "__main__":
    main()
