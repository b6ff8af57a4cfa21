"""The explicit scheme around a cylinder in the cavity, Re = 100, beside the incompressible one.

    python validation/explicit_in_regions.py
    python validation/explicit_in_regions.py --table

Writes explicit_in_regions.json beside itself, and prints the table of docs/measurements/weakly-compressible.md; with
--table it prints what is written.
"""

from __future__ import annotations

import json
from argparse import ArgumentParser, RawDescriptionHelpFormatter
from pathlib import Path
from typing import Any

import numpy as np

from sphear.cases.flow import FLOWS, CaseRun

RESOLUTION, REYNOLDS, UNTIL = 50, 100.0, 10.0
MIRROR_POINTS = "incompressible, mirror points"
RUNS: dict[str, dict[str, Any]] = {
    MIRROR_POINTS: {"scheme": "incompressible"},
    "explicit, fixed": {"scheme": "explicit", "walls": "fixed"},
    "explicit, adami": {"scheme": "explicit", "walls": "adami"},
}
KEPT = Path(__file__).with_suffix(".json")


def computed(settings: dict[str, Any]) -> dict[str, Any]:
    """The kinetic energy against time, the profiles at the end, and what they took."""
    case = FLOWS["cavity-cylinder"]
    chosen = case.settings(**settings, resolution=RESOLUTION, reynolds=REYNOLDS, until=UNTIL)
    run = CaseRun(case, chosen).run()
    return {
        "settings": settings,
        "end": run.end,
        "steps": run.flow.steps,
        "time": [round(row["time"], 4) for row in run.history],
        "kinetic energy": [round(row["kinetic_energy"], 7) for row in run.history],
        "profiles": {name: np.round(values, 5).tolist() for name, values in case.profiles(chosen, run.flow).items()},
    }


def table(found: dict[str, dict[str, Any]]) -> str:
    """The rows of the table: energy, and how far both profiles are from those of the incompressible scheme."""
    rows = ["| | kinetic energy | u: mean, largest difference | v: mean, largest difference |", "|---|---|---|---|"]
    other = found[MIRROR_POINTS]["profiles"]
    for name, run in found.items():
        cells = []
        for component in "uv":
            off = np.abs(np.subtract(run["profiles"][component], other[component]))
            cells.append("" if name == MIRROR_POINTS else f"{off.mean():.4f}, {off.max():.4f}")
        rows.append(f"| {name} | {run['kinetic energy'][-1]:.5f} | {' | '.join(cells)} |")
    return "\n".join(rows)


def main() -> None:
    """Compute, write and print."""
    parser = ArgumentParser(description=__doc__, formatter_class=RawDescriptionHelpFormatter)
    parser.add_argument("--table", action="store_true", help="print what is written, and compute nothing")
    found: dict[str, dict[str, Any]] = {}
    if parser.parse_args().table:
        found = json.loads(KEPT.read_text(encoding="utf-8"))
    else:
        for name, settings in RUNS.items():
            found[name] = computed(settings)
            print(name, found[name]["end"], f"{found[name]['kinetic energy'][-1]:.5f}", flush=True)
        lines = ",\n ".join(f"{json.dumps(name)}: {json.dumps(run)}" for name, run in found.items())
        KEPT.write_text(f"{{\n {lines}\n}}\n", encoding="utf-8")
    print(table(found))


if __name__ == "__main__":
    main()
