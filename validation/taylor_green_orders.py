"""The observed order of the whole scheme in dx for each viscous term: a decaying Taylor-Green vortex at Re = 100.

    python validation/taylor_green_orders.py [--workers N]

Modern settings but for the term, c0 = 40 U so that compressibility (of the order of the Mach number squared) stays
below the errors that are looked for. Writes taylor_green_orders.json beside itself; an interrupted run goes on where it
stopped.
"""

from __future__ import annotations

import argparse
import json
import math
from pathlib import Path

from sphear.results.finite import finite
from sphear.schemes.presets import PRESETS
from sphear.studies.kept import swept
from sphear.sweeps import plan
from sphear.viscosity import VISCOSITY

SIDES = (16, 32, 64)
UNTIL = 0.2
SOUND_SPEED = 40.0


def main() -> None:
    """Compute, print and write."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--workers", type=int, default=1)
    workers = parser.parse_args().workers
    fixed = {**PRESETS["modern"], "reynolds": 100.0, "until": UNTIL, "sound_speed": SOUND_SPEED, "threads": 1}
    fixed.pop("viscosity")
    runs = plan("taylor-green", {"viscosity": list(VISCOSITY), "resolution": SIDES}, fixed)
    found = swept(runs, "taylor-green-orders", workers, print)
    rows = []
    for term in list(VISCOSITY):
        mine = [result for result in found if result.settings["viscosity"] == term]
        errors = [None if result.failed else result.metrics["l2_error"] for result in mine]
        energy = [None if result.failed else result.metrics["kinetic_energy_ratio"] for result in mine]
        known = [error for error in errors[-2:] if error]
        order = math.log2(known[0] / known[1]) if len(known) == 2 else None
        rows.append({"viscosity": term, "l2_errors": errors, "kinetic_energy_ratios": energy, "order": order})
        print(term, errors, order)
    about = {"case": "taylor-green", "settings": {**fixed, "resolution": SIDES}, "rows": rows}
    Path(__file__).with_suffix(".json").write_text(json.dumps(finite(about), indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
