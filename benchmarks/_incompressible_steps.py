"""Steps of an incompressible flow by the sphear that is imported, whichever source tree that is.

    python _incompressible_steps.py CASE SIDE THREADS STEPS

Prints the folder of the package, milliseconds a step (the least mean of `BLOCK` steps), particles and peak memory in
bytes, as JSON. Only names of the front door are used, so that other trees have them too.
"""

from __future__ import annotations

import json
import sys
import time
from pathlib import Path

import sphear

WARM_UP = 20  # steps, until particles are disordered and the pressure is known
BLOCK = 5


def peak_memory() -> int:
    """Bytes that this process has had at most; 0 where the system does not say."""
    if sys.platform == "win32":
        return 0
    import resource

    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * (1 if sys.platform == "darwin" else 1024)


def main() -> None:
    case, side, threads, steps = sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), int(sys.argv[4])
    chosen = {"scheme": "incompressible", "reynolds": 1000.0, "resolution": side, "threads": threads}
    flow = sphear.flow(case, **chosen).flow
    flow.advance(WARM_UP)
    blocks = []
    for _ in range(max(1, steps // BLOCK)):
        begin = time.perf_counter()
        flow.advance(BLOCK)
        blocks.append((time.perf_counter() - begin) / BLOCK)
    said = {"package": str(Path(sphear.__file__).parent), "milliseconds": 1e3 * min(blocks), "particles": flow.count}
    print(json.dumps(said | {"memory": peak_memory()}))


if __name__ == "__main__":
    main()
