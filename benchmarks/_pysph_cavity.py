"""Seconds a step of PySPH's own transport-velocity cavity; run by an interpreter that has PySPH.

    python _pysph_cavity.py SIDE STEPS

Prints the least mean over a tenth of the steps, without output to files, on one thread.
"""

from __future__ import annotations

import contextlib
import io
import sys
import tempfile
import time
from typing import Any

from pysph.examples.cavity import LidDrivenCavity  # type: ignore[import-not-found]


class Timed(LidDrivenCavity):  # type: ignore[misc]
    """The example, which notes when each step ends."""

    def initialize(self) -> None:
        self.ends: list[float] = []

    def post_step(self, solver: Any) -> None:
        self.ends.append(time.perf_counter())


def main() -> None:
    side, steps = int(sys.argv[1]), int(sys.argv[2])
    with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()):
        app = Timed(fname="cavity", output_dir=folder)
        app.run(["--nx", str(side), "--max-steps", str(steps), "--disable-output", "--no-openmp"])
    chunk = max(1, steps // 10)
    print(min((b - a) / chunk for a, b in zip(app.ends, app.ends[chunk:])))  # noqa: B905


if __name__ == "__main__":
    main()
