"""PySPH's own lid-driven cavity from its start to an end, on one thread; run by an interpreter that has PySPH.

    python _pysph_whole_cavity.py SCHEME REYNOLDS SIDE UNTIL FILE

SCHEME is one of the example's, `tvf` or `edac`. Prints steps and processor seconds as JSON, and writes positions and
velocities of the fluid to FILE (.npz). Compilation is not counted. A run ends early where velocities are not finite.
"""

from __future__ import annotations

import contextlib
import io
import json
import sys
import tempfile
import time
from typing import Any

import numpy as np
from pysph.examples.cavity import LidDrivenCavity  # type: ignore[import-not-found]

CHECKED = 1000  # steps between two looks at the velocities


class Failed(Exception):
    """The flow broke down."""


class Timed(LidDrivenCavity):  # type: ignore[misc]
    """The example, which notes when its first and its last step end."""

    first: float | None = None

    def post_step(self, solver: Any) -> None:
        now = time.process_time()
        if self.first is None:
            self.first = now
        self.last, self.steps = now, solver.count
        if self.steps % CHECKED == 0 and not np.isfinite(self.fluid().u).all():
            raise Failed

    def fluid(self) -> Any:
        return next(particles for particles in self.particles if particles.name == "fluid")


def main() -> None:
    scheme, reynolds, side, until, file = sys.argv[1:]
    with (
        tempfile.TemporaryDirectory() as folder,
        contextlib.redirect_stdout(io.StringIO()),
        contextlib.suppress(Failed),
    ):
        app = Timed(fname="cavity", output_dir=folder)
        app.run(["--scheme", scheme, "--re", reynolds, "--nx", side, "--tf", until, "--disable-output",
                 "--no-openmp"])  # fmt: skip
    fluid = app.fluid()
    np.savez(file, positions=np.stack((fluid.x, fluid.y), 1), velocities=np.stack((fluid.u, fluid.v), 1))
    assert app.first is not None
    seconds = (app.last - app.first) * app.steps / max(app.steps - 1, 1)
    print(json.dumps({"steps": app.steps, "seconds": seconds}))


if __name__ == "__main__":
    main()
