"""How long the first use of a formula takes: traced and compiled with an empty cache, and loaded from a full one.

Each formula has a process of its own, in which the neighbours are found first, so that the compiler is awake. The time
is that of a viscous acceleration of a few hundred particles, with all sweeps that it needs.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile

from _bench import Report

MEASURE = """
import sys, time
import numpy as np
from sphear import VISCOSITY, Domain, NoCorrection, Particles, WendlandC2
dimension = int(sys.argv[2])
ticks = (np.arange(8) + 0.5) / 8
positions = np.stack(np.meshgrid(*[ticks] * dimension), -1).reshape(-1, dimension)
domain = Domain((0,) * dimension, (1,) * dimension)
particles = Particles.read(positions, kernel=WendlandC2(0.22), volumes=0.1, domain=domain)
ones = np.ones(len(positions))
begin = time.perf_counter()
particles.viscous_acceleration(np.sin(positions), ones, ones, VISCOSITY[sys.argv[1]], NoCorrection())
print(time.perf_counter() - begin)
"""
FORMULAS = (("morris", 2), ("morris", 3), ("fatehi_manzari", 3), ("least_squares_4", 2), ("least_squares_4", 3))


def seconds(viscosity: str, dimension: int, cache: str) -> float:
    arguments = [sys.executable, "-c", MEASURE, viscosity, str(dimension)]
    environment = os.environ | {"SPHEAR_CACHE_DIR": cache}
    return float(subprocess.check_output(arguments, text=True, env=environment))


def main() -> None:
    report = Report(__doc__ or "")
    for viscosity, dimension in FORMULAS:
        first, second = [], []
        for _ in range(2):
            with tempfile.TemporaryDirectory() as cache:
                first.append(seconds(viscosity, dimension, cache))
                second.append(seconds(viscosity, dimension, cache))
        report.add(f"{viscosity} in {dimension}-D, empty cache", min(first), "s")
        report.add(f"{viscosity} in {dimension}-D, full cache", min(second), "s")
    report.close()


if __name__ == "__main__":
    main()
