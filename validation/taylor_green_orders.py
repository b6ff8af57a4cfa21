"""The observed order of the whole scheme in dx for each viscous term: a decaying Taylor-Green vortex at Re = 100.

    python validation/taylor_green_orders.py [--workers N]

The best settings but for the term, with one evaluation a step. The particles start without the pressure of the exact
flow, and the sound that this makes, of the order of U / c0, stays in the velocities; the energy feels compressibility
by its square. c0 = 160 U keeps both small, and one term at a lower sound speed tells how much they are. Writes
taylor_green_orders.json beside itself; an interrupted run goes on where it stopped.
"""

from __future__ import annotations

import argparse
import json
import math
from pathlib import Path
from typing import Any

from sphear.results.finite import finite
from sphear.studies.kept import swept
from sphear.sweeps import SweepResult, plan
from sphear.viscosity import VISCOSITY

SIDES = (16, 32, 64)
UNTIL = 0.2
SOUND_SPEED = 160.0
SLOWER, COMPARED = 40.0, "fatehi_manzari"  # one term at another sound speed


def order(errors: list[float | None]) -> float | None:
    """Between the two finest; None where a run failed, or where the error changes its sign."""
    coarse, fine = errors[-2:]
    return None if not coarse or not fine or coarse * fine <= 0 else math.log2(coarse / fine)


def row(term: str, results: list[SweepResult]) -> dict[str, Any]:
    """Errors at each size and their orders."""
    l2 = [None if result.failed else result.metrics["l2_error"] for result in results]
    energy = [None if result.failed else result.metrics["kinetic_energy_ratio"] - 1 for result in results]
    return {"viscosity": term, "energy_errors": energy, "energy_order": order(energy), "l2_errors": l2,
            "l2_order": order(l2)}  # fmt: skip


def main() -> None:
    """Compute, print and write."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--workers", type=int, default=1)
    workers = parser.parse_args().workers
    fixed = {"integrator": "kick_drift_kick", "reynolds": 100.0, "until": UNTIL, "threads": 1}
    fast, slow = (
        swept(
            plan("taylor-green", {"viscosity": terms, "resolution": SIDES}, {**fixed, "sound_speed": speed}),
            "taylor-green-orders", workers, print,
        )
        for terms, speed in ((list(VISCOSITY), SOUND_SPEED), ([COMPARED], SLOWER))
    )  # fmt: skip
    rows = [row(term, [one for one in fast if one.settings["viscosity"] == term]) for term in VISCOSITY]
    slower = {"sound_speed": SLOWER, **row(COMPARED, slow)}
    for entry in (*rows, slower):
        print(entry)
    about = {"case": "taylor-green", "settings": {**fixed, "sound_speed": SOUND_SPEED, "resolution": SIDES}}
    content = json.dumps(finite({**about, "rows": rows, "slower_sound": slower}), indent=1) + "\n"
    Path(__file__).with_suffix(".json").write_text(content, encoding="utf-8")


if __name__ == "__main__":
    main()
