"""Seconds a step of PySPH's own incompressible Taylor-Green vortex; run by an interpreter that has PySPH.

    python _pysph_isph.py SIDE STEPS

Prints the least time of a step, without output to files, on one thread.
"""

from __future__ import annotations

import contextlib
import io
import sys
import tempfile
import time
from typing import Any

from pysph.examples.taylor_green import TaylorGreen  # type: ignore[import-not-found]


class Timed(TaylorGreen):  # type: ignore[misc]
    """The example, which notes when each step ends."""

    ends: list[float]

    def post_step(self, solver: Any) -> None:
        self.__dict__.setdefault("ends", []).append(time.perf_counter())


def main() -> None:
    side, steps = int(sys.argv[1]), int(sys.argv[2])
    with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()):
        app = Timed(fname="taylor_green", output_dir=folder)
        app.run(["--scheme", "isph", "--nx", str(side), "--perturb", "0.2", "--max-steps", str(steps),
                 "--disable-output", "--no-openmp"])  # fmt: skip
    print(min(b - a for a, b in zip(app.ends, app.ends[1:])))  # noqa: B905


if __name__ == "__main__":
    main()
