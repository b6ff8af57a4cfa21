"""A lid-driven cavity by sphear's incompressible scheme with its default settings, on one thread.

    python _sphear_cavity.py REYNOLDS SIDE UNTIL

Prints steps, processor seconds and the mean deviation of both profiles as JSON; compilation is not counted.
"""

from __future__ import annotations

import json
import math
import sys
import time

import sphear
from sphear.cases.flow import FLOWS


def main() -> None:
    reynolds, side, until = float(sys.argv[1]), int(sys.argv[2]), float(sys.argv[3])
    chosen = {"scheme": "incompressible", "reynolds": reynolds, "resolution": side, "until": until, "threads": 1}
    sphear.flow("cavity", **chosen).flow.advance(3)  # compiles
    begin = time.process_time()
    run = sphear.flow("cavity", **chosen).run()
    seconds = time.process_time() - begin
    found = FLOWS["cavity"].summary(run.settings, run.flow)
    deviation = 0.5 * (found.get("u_mean_deviation", math.nan) + found.get("v_mean_deviation", math.nan))
    failed = run.end.startswith("failed") or not math.isfinite(deviation)
    print(json.dumps({"steps": run.flow.steps, "seconds": seconds, "deviation": "inf" if failed else deviation}))


if __name__ == "__main__":
    main()
