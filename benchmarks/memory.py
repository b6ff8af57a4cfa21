"""Peak memory of a patch test and of a flow with a million particles, in bytes a particle.

Each runs in a process of its own; what a process with 400 particles needs (Python, its libraries, compiled code) is
subtracted. The flow is a Taylor-Green vortex that makes three midpoint steps with summed density, the settings of Basa,
Quinlan & Lastiwka 2009, on one thread.
"""

from __future__ import annotations

import subprocess
import sys

from _bench import Report

PEAK = """
import resource
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * (1 if sys.platform == "darwin" else 1024))
"""
PATCH_TEST = """
import sys
from sphear.cases.patch_test import PatchTest
PatchTest(sizes=(int(sys.argv[1]),), viscosity=(sys.argv[2],), jitter=0.3).rows()
"""
FLOW = """
import sys
from sphear.cases.flow import FLOWS
from sphear.cases.flow.start import flow_settings
from sphear.schemes.weakly_compressible.flow import WeaklyCompressibleFlow
case = FLOWS["taylor-green"]
changes = {"resolution": int(sys.argv[1]), "viscosity": sys.argv[2], "threads": 1}
settings = flow_settings(case, changes, "basa2009")
WeaklyCompressibleFlow(case.problem(settings), settings).advance(3)
"""
SIDE = 1000


def peak(script: str, side: int, viscosity: str) -> int:
    """Bytes."""
    arguments = [sys.executable, "-c", script + PEAK, str(side), viscosity]
    return int(subprocess.check_output(arguments, text=True))


def main() -> None:
    report = Report(__doc__ or "")
    for name, script, terms in (
        ("patch test", PATCH_TEST, ("morris", "fatehi_manzari", "least_squares_4")),
        ("flow", FLOW, ("morris", "fatehi_manzari")),
    ):
        for viscosity in terms:
            peak(script, 20, viscosity)  # compiles
            bytes_each = (peak(script, SIDE, viscosity) - peak(script, 20, viscosity)) / SIDE**2
            report.add(f"{name}, {viscosity}", bytes_each, "bytes", at_most=400)
    report.close()


if __name__ == "__main__":
    main()
