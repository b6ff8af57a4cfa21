"""Builds and runs roofline.cpp: the right-hand side of the momentum equation, hand-written over many layouts."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import numpy as np
from _bench import Array, Measurement, difference

FULL = ("cell_auto", "cell_vec", "csr_gather", "csr_aos")  # layouts that compute each pair twice
ONCE = ("sym_vec", "half_aos")
TOLERANCE = 1e-10  # of the largest acceleration


def build(folder: Path) -> Path | str:
    """The program, or a sentence that says why there is none."""
    compiler = next(filter(None, map(shutil.which, ("g++", "clang++"))), None)
    if compiler is None:
        return "There is no C++ compiler here, so sphear's numbers stand alone."
    program, source = folder / "roofline", Path(__file__).parent / "roofline.cpp"
    options = ["-O3", "-march=native", "-ffast-math", "-std=c++17"]
    done = subprocess.run([compiler, *options, source, "-o", program], capture_output=True)
    if done.returncode:
        return "roofline.cpp needs an x86 processor and GCC 12 or Clang, so sphear's numbers stand alone."
    return program


def write_particles(
    file: Path,
    support: float,
    eta: float,
    viscosity: float,
    mass: float,
    positions: Array,
    velocity: Array,
    pressure_over_density2: Array,
    density: Array,
) -> None:
    """The particles of the unit square as the program reads them; Wendland C2 with h = support / 2."""
    factor = 35 / (4 * np.pi * (support / 2) ** 4)
    head = [len(positions), support, eta**2, 2 * viscosity, -mass * factor]
    np.concatenate((head, *positions.T, *velocity.T, pressure_over_density2, 1 / density)).tofile(file)


def check(program: Path, particles: Path, expected: Array) -> None:
    """Every layout must find these accelerations (N, 2)."""
    results = particles.with_suffix(".results")
    lines = subprocess.check_output([program, particles, results], text=True).splitlines()
    accelerations = np.fromfile(results).reshape(len(lines), 2, -1)
    for line, found in zip(lines, accelerations, strict=True):
        name = line.split()[0]
        if name in FULL + ONCE and not difference(found.T, expected) < TOLERANCE:
            raise SystemExit(f"{name} differs from sphear by {difference(found.T, expected):.1e} of the largest")


def measurement(program: Path, particles: Path) -> Measurement:
    """One short run of the program: the least time of each layout, over cell widths and numbers of lanes."""

    def measure() -> dict[str, float]:
        times: dict[str, float] = {}
        for line in subprocess.check_output([program, particles], text=True).splitlines():
            name, _, _, seconds = line.split()
            times[name] = min(float(seconds), times.get(name, np.inf))
        return times

    return measure
