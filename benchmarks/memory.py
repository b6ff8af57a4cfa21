"""Peak memory of a patch test with a million particles, in bytes a particle.

Each runs in a process of its own; what a process with 400 particles needs (Python, its libraries, compiled code) is
subtracted.
"""

from __future__ import annotations

import subprocess
import sys

from _bench import Report

MEASURE = """
import resource, sys
from sphear.cases.patch_test import PatchTest
PatchTest(sizes=(int(sys.argv[1]),), viscosity=(sys.argv[2],), jitter=0.3).rows()
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * (1 if sys.platform == "darwin" else 1024))
"""
SIDE = 1000


def peak(side: int, viscosity: str) -> int:
    """Bytes."""
    arguments = [sys.executable, "-c", MEASURE, str(side), viscosity]
    return int(subprocess.check_output(arguments, text=True))


def main() -> None:
    report = Report(__doc__ or "")
    for viscosity in ("morris", "fatehi_manzari", "least_squares_4"):
        peak(20, viscosity)  # compiles
        bytes_each = (peak(SIDE, viscosity) - peak(20, viscosity)) / SIDE**2
        report.add(f"{viscosity}", bytes_each, "bytes", at_most=400)
    report.close()


if __name__ == "__main__":
    main()
