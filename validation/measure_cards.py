"""Measures what the card of each viscous term states and writes it to src/sphear/viscosity/measured.json.

Orders: L1 error of the Laplacian of sin(2 pi x) sin(2 pi y), or for radial terms of the velocity with that stream
function, cubic spline with a support of 3.14 dx: on a lattice from 160 to 320 particles a side; jittered by 0.3 dx from
80 to 160, mean of 8 seeds.
Conservation and dissipation: `sphear.cases.conservation`. Cost: `benchmarks/viscosity_cost.py`.

    python validation/measure_cards.py           # everything
    python validation/measure_cards.py --check   # compare with the committed file, except for the cost
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

from sphear.cases.conservation import conservation
from sphear.cases.patch_test import PatchTest
from sphear.viscosity import VISCOSITY
from sphear.viscosity.page import page

TARGET = Path(__file__).parents[1] / "src" / "sphear" / "viscosity" / "measured.json"
BENCHMARKS = Path(__file__).parents[1] / "benchmarks"
CARDS = Path(__file__).parents[1] / "docs" / "viscosity.md"


def order(name: str, jitter: float) -> float:
    """The order of the L1 error between two sizes."""
    sizes = (80, 160) if jitter else (160, 320)
    test = PatchTest(
        viscosity=(name,), sizes=sizes, field="sine", velocity=VISCOSITY[name].radial, jitter=jitter, seeds=8
    )
    return float(test.rows()[-1]["order"])


def measured() -> dict[str, dict[str, Any]]:
    """All facts of all terms but the cost."""
    facts = {}
    for name in VISCOSITY:
        facts[name] = {
            "order_lattice": round(order(name, 0.0), 2),
            "order_jittered": round(order(name, 0.3), 2),
            **conservation(VISCOSITY[name]).kept(),
        }
        print(name, facts[name])
    return facts


def main() -> int:
    """Write the file, or compare with it."""
    facts = measured()
    if "--check" in sys.argv:
        committed = json.loads(TARGET.read_text(encoding="utf-8"))
        different = [name for name in facts if any(committed[name][key] != facts[name][key] for key in facts[name])]
        print("different from the committed file:", ", ".join(different) or "nothing")
        return len(different)
    sys.path.insert(0, str(BENCHMARKS))
    from viscosity_cost import relative_costs

    for name, cost in relative_costs().items():
        facts[name]["cost"] = round(cost, 1)
    TARGET.write_text(json.dumps(facts, indent=2) + "\n", encoding="utf-8")
    CARDS.write_text(page(), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
