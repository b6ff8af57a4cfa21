"""A sweep over all pairs (pressure and Morris viscosity), and the pair list, against hand-written C++.

The same particles, formula and core: sphear's compiled `Momentum` sweep and roofline.cpp, which does the same over the
memory layouts that particle codes use. Both are checked against each other, then timed in turn; of each layout the best
cell width and number of lanes counts.

    cell_auto   cells, vectorised by the compiler      csr_gather  pair list, vectorised by the compiler
    cell_vec    cells, explicit vectors                csr_aos     pair list, whole records transposed in registers
    sym_vec     cells, each pair once                  half_aos    the same, each pair once
"""

from __future__ import annotations

import shutil
import subprocess
import tempfile
from pathlib import Path

import numpy as np
from _bench import Array, Measurement, Report, best_of, clocked, difference, jittered_square

from sphear import CubicSpline, Kernel, Morris, Neighbours, NoCorrection, WendlandC2
from sphear.engine.sweep import Sweep
from sphear.interactions import Momentum
from sphear.neighbours.cells import cell_sort
from sphear.neighbours.pair_list import build_chunk

SUPPORT_OVER_DX = 3.09  # 29 neighbours
ETA = 0.1  # smoothing lengths
VISCOSITY = 0.01
FULL = ("cell_auto", "cell_vec", "csr_gather", "csr_aos")  # layouts that compute each pair twice, as sphear does
ONCE = ("sym_vec", "half_aos")


class Case:
    """Particles on a jittered lattice in open space, and sphear's sweep over them."""

    def __init__(self, side: int, threads: int = 1, kernel: type[Kernel] = WendlandC2) -> None:
        rng = np.random.default_rng(1)
        self.name = f"{side}x{side}"
        self.positions = jittered_square(side)
        self.count, self.mass, self.h = side**2, 1 / side**2, SUPPORT_OVER_DX / 2 / side
        self.density = 1 + 0.01 * rng.random(self.count)
        ones = np.ones(self.count)
        self.fields = {
            "velocity": rng.standard_normal((self.count, 2)),
            "pressure_over_density2": rng.random(self.count) / self.density**2,
            "mass": self.mass * ones,
            "volume": self.mass / self.density,
            "density": self.density,
            "dynamic_viscosity": VISCOSITY * ones,
        }
        self.interaction = Momentum(Morris(eta=ETA), kernel(self.h), NoCorrection())
        self.neighbours = Neighbours(self.positions, 2 * self.h, threads=threads)
        self.sweep = self.packed()
        self.out = np.empty((self.count, 2))
        self.target = [self.neighbours.particles(chunk) for chunk in self.neighbours.chunks]

    def packed(self) -> Sweep:
        return Sweep(self.interaction, self.neighbours, self.fields)

    def over(self) -> None:
        for chunk, target in zip(self.neighbours.chunks, self.target, strict=True):
            self.sweep.over(chunk, self.out, target)

    def search(self) -> Neighbours:
        return Neighbours(self.positions, 2 * self.h, threads=1)

    def sort_and_list(self) -> None:
        cells = cell_sort(self.positions, 2 * self.h)
        for chunk in self.neighbours.chunks:
            build_chunk(cells, self.neighbours.entry, chunk.begin, chunk.end, 2 * self.h, False)

    def write(self, file: Path) -> None:
        eta2, factor = (ETA * self.h) ** 2, 35 / (4 * np.pi * self.h**4)
        head = [self.count, 2 * self.h, eta2, 2 * VISCOSITY, -self.mass * factor]
        velocity, pressure = self.fields["velocity"], self.fields["pressure_over_density2"]
        np.concatenate((head, *self.positions.T, *velocity.T, pressure, 1 / self.density)).tofile(file)


def compiled(folder: Path) -> Path | str:
    """The C++ program, or a sentence that says why there is none."""
    compiler = next(filter(None, map(shutil.which, ("g++", "clang++"))), None)
    if compiler is None:
        return "No C++ compiler here: sphear's numbers alone."
    program, source = folder / "roofline", Path(__file__).parent / "roofline.cpp"
    options = ["-O3", "-march=native", "-ffast-math", "-std=c++17"]
    built = subprocess.run([compiler, *options, str(source), "-o", str(program)], capture_output=True)
    return program if built.returncode == 0 else "roofline.cpp needs x86 and GCC 12 or Clang: sphear's numbers alone."


def hand_written(program: Path, case: Case, folder: Path) -> Measurement:
    """The C++ program on the case's particles, once its results are those of sphear."""
    particles, results = folder / "particles", folder / "results"
    case.write(particles)

    def measure(*results: Path) -> dict[str, float]:
        lines = subprocess.check_output([program, particles, *results], text=True).splitlines()
        times: dict[str, float] = {}
        for name, _, _, seconds in map(str.split, lines):
            times[name] = min(float(seconds), times.get(name, np.inf))
        return times

    names = [line.split()[0] for line in subprocess.check_output([program, particles, results], text=True).splitlines()]
    case.over()
    accelerations: Array = np.fromfile(results).reshape(len(names), 2, case.count)
    for name, found in zip(names, accelerations, strict=True):
        if name in FULL + ONCE and not difference(found.T, case.out) < 1e-10:
            raise SystemExit(f"{name} differs from sphear by {difference(found.T, case.out):.1e}")
    return measure


def compare(report: Report, case: Case, program: Path | str, folder: Path) -> None:
    cubic = Case(round(case.count**0.5), kernel=CubicSpline)
    mine = [
        clocked("sweep", case.over, 5),
        clocked("with packing", lambda: (case.packed(), case.over()), 5),
        clocked("cubic spline", cubic.over, 5),
        clocked("Neighbours", case.search, 3),
        clocked("sort and list", case.sort_and_list, 3),
    ]
    times = best_of(10, *mine, *([hand_written(program, case, folder)] if isinstance(program, Path) else []))
    report.add(f"{case.name}, sphear, {case.neighbours.pairs / case.count:.1f} neighbours",
               case.count / times["sweep"] / 1e6, "M/s")  # fmt: skip
    report.add(f"{case.name}, sphear with packing", case.count / times["with packing"] / 1e6, "M/s")
    if isinstance(program, Path):
        speed = {name: times[name] / times["sweep"] for name in FULL + ONCE}
        fastest = min(FULL, key=lambda name: times[name])
        for name in FULL + ONCE:
            report.add(f"{case.name}, sphear / {name}", speed[name], at_least=1.5 if name == "cell_auto" else None)
        report.add(f"{case.name}, sphear / fastest full layout ({fastest})", speed[fastest], at_least=0.6)
        report.add(f"{case.name}, with packing / fastest with packing",
                   (times[fastest] + times["pack"]) / times["with packing"])  # fmt: skip
        report.add(
            f"{case.name}, Neighbours / C++ sort and list", (times["sort"] + times["build"]) / times["Neighbours"]
        )
    for kernel, sweep in (("Wendland C2", "sweep"), ("cubic spline", "cubic spline")):
        report.add(f"{case.name}, {kernel}, Neighbours in sweeps", times["Neighbours"] / times[sweep], at_most=1.3)
        report.add(f"{case.name}, {kernel}, sort and list in sweeps", times["sort and list"] / times[sweep])


def main() -> None:
    report = Report(__doc__ or "")
    with tempfile.TemporaryDirectory() as name:
        program = compiled(Path(name))
        if isinstance(program, str):
            report.say(program)
        for side in (100, 316):
            compare(report, Case(side), program, Path(name))
    one, two = Case(316), Case(316, threads=2)
    times = best_of(5, clocked("1", one.sweep.everywhere, 3), clocked("2", two.sweep.everywhere, 3))
    report.add("316x316, two threads / one", times["1"] / times["2"], at_least=1.8)
    report.close()


if __name__ == "__main__":
    main()
