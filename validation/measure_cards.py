"""Measures what the card of each viscous term states and writes it to src/sphear/viscosity/measured.json.

Orders, conservation and dissipation: `sphear.measured_card`. Cost: `benchmarks/viscosity_cost.py`.

    python validation/measure_cards.py           # everything
    python validation/measure_cards.py --check   # compare with the committed file, except for the cost
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

from sphear.cases.measured_card import measured_card
from sphear.viscosity import VISCOSITY
from sphear.viscosity.page import page

TARGET = Path(__file__).parents[1] / "src" / "sphear" / "viscosity" / "measured.json"
BENCHMARKS = Path(__file__).parents[1] / "benchmarks"
CARDS = Path(__file__).parents[1] / "docs" / "theory" / "viscosity.md"


def measured() -> dict[str, dict[str, Any]]:
    """All facts of all terms but the cost."""
    facts = {}
    for name in (name for name in VISCOSITY if name in VISCOSITY.published):
        facts[name] = measured_card(name).as_dict()
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
