"""Whole steps of a flow: sort, images, pair list, sweeps and update, against hand-written C++.

One force evaluation a step (continuity, pressure, Morris viscosity, Wendland C2, about 26 neighbours) beside the same
step in whole_step.cpp, on one core; and the midpoint steps that matter most: the 20 x 20 channel with its walls, and
1000 x 1000 particles on all cores.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
import time
from pathlib import Path
from typing import Any

from _bench import Measurement, Report, best_of

from sphear.cases.flow import FLOWS
from sphear.cases.flow.start import flow_settings
from sphear.schemes.weakly_compressible.flow import WeaklyCompressibleFlow
from sphear.schemes.weakly_compressible.settings import WeaklyCompressibleSettings

ONE_EVALUATION: dict[str, Any] = {
    "density": "continuity",
    "kernel": "wendland_c2",
    "h_over_dx": 1.49,  # 26 to 28 neighbours
    "integrator": "kick_drift_kick",
    "pressure_reduction": "none",
    "threads": 1,
}


def flow(case: str, **settings: Any) -> WeaklyCompressibleFlow:
    """A flow that has made its first steps; what is not said is as in the paper, the cheapest there is."""
    chosen = flow_settings(FLOWS[case], settings, "basa2009")
    assert isinstance(chosen, WeaklyCompressibleSettings)
    made = WeaklyCompressibleFlow(FLOWS[case].problem(chosen), chosen)
    made.advance(2)
    return made


def stepping(name: str, made: WeaklyCompressibleFlow, steps: int) -> Measurement:
    """Seconds a step."""

    def measure() -> dict[str, float]:
        begin = time.perf_counter()
        made.advance(steps)
        return {name: (time.perf_counter() - begin) / steps}

    return measure


def build(folder: Path) -> Path | None:
    """The C++ program; None where it cannot be built."""
    compiler = next(filter(None, map(shutil.which, ("g++", "clang++"))), None)
    program, source = folder / "whole_step", Path(__file__).parent / "whole_step.cpp"
    options = ["-O3", "-march=native", "-ffast-math", "-std=c++17"]
    built = compiler and not subprocess.run([compiler, *options, source, "-o", program], capture_output=True).returncode
    return program if built else None


def by_hand(program: Path, side: int) -> Measurement:
    """Seconds a step of the best cell width."""

    def measure() -> dict[str, float]:
        lines = subprocess.check_output([program, str(side), "20"], text=True).splitlines()
        return {"C++": min(float(line.split()[1]) for line in lines)}

    return measure


def main() -> None:
    report = Report(__doc__ or "")
    with tempfile.TemporaryDirectory() as folder:
        program = build(Path(folder))
        if program is None:
            report.say(
                "whole_step.cpp needs an x86 processor with AVX2 and a C++ compiler: sphear's numbers stand alone."
            )
        for side in (50, 100, 200, 400):
            made = flow("taylor-green", resolution=side, initial="relaxed", reynolds=100, **ONE_EVALUATION)
            measurements = [stepping("sphear", made, max(2, 40_000 // side**2))]
            times = best_of(5, *measurements, *([by_hand(program, side)] if program else []))
            speed = side**2 / times["sphear"] / 1e6
            report.add(f"{side}x{side}, one evaluation a step", speed, "M/s", at_least=4.2)
            if program:
                report.add(f"{side}x{side}, speed, sphear / C++", times["C++"] / times["sphear"], at_least=0.35)
    channel = flow("poiseuille", resolution=20)
    report.add(
        "20x20 channel, midpoint steps", 1 / best_of(5, stepping("s", channel, 500))["s"], "steps/s", at_least=1500
    )
    for threads in (1, os.cpu_count() or 1):
        large = flow("taylor-green", resolution=1000, threads=threads)
        seconds = best_of(15, stepping("s", large, 1))["s"]
        asked = 2.0 if threads > 1 else None
        report.add(f"1000x1000, midpoint steps, {threads} threads", large.count / seconds / 1e6, "M/s", at_least=asked)
    report.close()


if __name__ == "__main__":
    main()
