"""Map where flows hold: every case, scheme and preset at resolutions that are no round numbers, Re from 1e-3 to 1e5.

    python validation/robustness.py --workers 2      # everything that is not kept yet
    python validation/robustness.py --kinds cavity   # the kinds whose name has that in it
    python validation/robustness.py --table          # draw up what is kept

Each run goes on until its particles are disordered or, where viscosity limits the step, for so many steps. Kept are how
it ended, what it made of its energy and how far its particles went; a run that is kept with the same settings is not
made again. Stopped, it goes on where it stood.
"""

from __future__ import annotations

import argparse
import json
import math
import time
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path
from typing import Any

KEPT = Path(__file__).with_suffix(".json")
RESOLUTIONS = (13, 17, 19, 23, 29, 37, 43, 53)
FEW = (13, 29)  # resolutions of what is neither default nor a preset
REYNOLDS = (1e-3, 1.0, 100.0, 1e3, 1e4, 1e5)
STEPS = {"explicit": 4000, "incompressible": 250}
OUTPUTS = 12  # of a run, at which it is looked at
UNTIL = {
    "poiseuille": 5.0,
    "couette": 5.0,
    "taylor-green": 1.5,
    "cavity": 3.0,
    "cavity-cylinder": 3.0,
    "dam-break": 3.3,
}

DEFAULT: dict[str, Any] = {}
IMPLICIT = {"viscous_step": "crank_nicolson"}
KINDS: dict[str, tuple[str, dict[str, Any]]] = {
    f"{case} {scheme} {name}": (case, {"scheme": scheme, **changes})
    for case in UNTIL
    for scheme, name, changes in (
        ("explicit", "default", DEFAULT),
        ("explicit", "basa2009", {"preset": "basa2009"}),
        ("incompressible", "default", DEFAULT),
        ("incompressible", "zheng2018", {"preset": "zheng2018"}),
        ("incompressible", "crank_nicolson", IMPLICIT),
    )
    if not (scheme == "explicit" and case in ("cavity-cylinder", "dam-break"))
    if not (name == "zheng2018" and case == "dam-break")  # its walls need fluid on all sides
}
FIELDS = (
    "kinetic_energy",
    "energy_residual",
    "energy_created",
    "density_deviation",
    "smallest_distance",
    "largest_gap",
)


def wanted(part: str) -> Iterator[tuple[str, int, float]]:
    """The runs, those of defaults and small ones first."""
    chosen = [kind for kind in KINDS if part in kind]
    for kinds in ([k for k in chosen if k.endswith("default")], [k for k in chosen if not k.endswith("default")]):
        for resolution in RESOLUTIONS:
            for kind in kinds:
                if resolution in FEW or not kind.endswith("crank_nicolson"):
                    for reynolds in REYNOLDS:
                        yield kind, resolution, reynolds


def run(kind: str, resolution: int, reynolds: float) -> dict[str, Any]:
    """Compute a run, and say what became of it."""
    import numpy as np

    import sphear
    from sphear.cases.flow import run as runs
    from sphear.errors import SphearError
    from sphear.schemes.watch import unresolved

    runs.OUTPUTS = OUTPUTS
    case, changes = KINDS[kind]
    began = time.monotonic()
    try:
        made = sphear.flow(
            case,
            **changes,
            resolution=resolution,
            reynolds=reynolds,
            until=UNTIL[case],
            max_steps=STEPS[changes["scheme"]],
            threads=1,
        )
    except SphearError as error:
        return {"end": f"refused: {error}"}
    problem = made.flow.problem
    said = unresolved(problem)
    made.run()
    velocities = made.flow.velocities
    with np.errstate(all="ignore"):
        speed = float(np.sqrt((velocities**2).sum(axis=1).max()))
        energies = [row.get("kinetic_energy", math.nan) for row in made.history]
    last = made.history[-1]
    return {
        "end": made.end[:200],
        "time": made.flow.time,
        "steps": made.flow.steps,
        "moved": min(problem.speed * made.flow.time / problem.spacing, 1e9),
        "cell_reynolds": problem.speed * problem.spacing / problem.kinematic_viscosity,
        "unresolved": len(said),
        "speed": speed / problem.speed,
        "largest_energy": max(energies),
        **{name: last[name] for name in FIELDS if name in last},
        "largest_created": max((row.get("energy_created", 0.0) for row in made.history), default=0.0),
        "seconds": round(time.monotonic() - began, 2),
    }


def rounded(value: Any) -> Any:
    """Numbers with four digits, and None where there is none."""
    if isinstance(value, float):
        return float(f"{value:.4g}") if math.isfinite(value) else None
    return value


def known() -> dict[str, Any]:
    """What is kept, by kind, resolution and Reynolds number."""
    found: dict[str, Any] = json.loads(KEPT.read_text()) if KEPT.exists() else {}
    return found


def compute(part: str, workers: int) -> None:
    """Compute what is not kept, and keep each run as it ends."""
    kept = known()
    missing = [one for one in wanted(part) if f"{one[0]} {one[1]} {one[2]:g}" not in kept]
    print(f"{len(missing)} runs to be made, {len(kept)} kept")
    saved = time.monotonic()
    with ProcessPoolExecutor(workers) as pool:
        runs = {pool.submit(run, *one): one for one in missing}
        for number, ended in enumerate(as_completed(runs), 1):
            kind, resolution, reynolds = runs[ended]
            kept[f"{kind} {resolution} {reynolds:g}"] = {k: rounded(v) for k, v in ended.result().items()}
            if time.monotonic() - saved > 5.0 or number == len(missing):
                keep(kept)
                saved = time.monotonic()


def keep(kept: dict[str, Any]) -> None:
    """Write what is kept, a run a line."""
    beside = KEPT.with_suffix(".tmp")
    beside.write_text(
        "{\n" + ",\n".join(f"{json.dumps(k)}: {json.dumps(v)}" for k, v in sorted(kept.items())) + "\n}\n"
    )
    beside.replace(KEPT)


def table(part: str) -> str:
    """How many runs of each kind and Reynolds number held, least and told failures, and what others made of energy."""
    kept = known()
    rows = [
        "| case, scheme, settings | " + " | ".join(f"{reynolds:g}" for reynolds in REYNOLDS) + " |"
        " fails from cell Re | failed untold | energy made, most |",
        "|---" * (len(REYNOLDS) + 4) + "|",
    ]
    for kind in KINDS:
        runs = {key: value for key, value in kept.items() if key.startswith(kind + " ") and part in kind}
        ran = {key: one for key, one in runs.items() if not one["end"].startswith("refused")}
        failed = {key: one for key, one in ran.items() if one["end"].startswith("failed")}
        cells = [one["cell_reynolds"] for one in failed.values()]
        made = [one["largest_created"] or 0.0 for key, one in ran.items() if key not in failed]
        untold = sum(not one["unresolved"] for one in failed.values())
        of_each = []
        for reynolds in REYNOLDS:
            here = [key for key in ran if key.endswith(f" {reynolds:g}")]
            of_each.append(f"{len(here) - sum(key in failed for key in here)}/{len(here)}")
        if ran:
            rows.append(
                f"| `{kind}` | {' | '.join(of_each)} | {f'{min(cells):.2g}' if cells else ''} | {untold or ''} |"
                f" {max(made, default=0.0):.3f} |"
            )
    return "\n".join(rows)


if __name__ == "__main__":
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--workers", type=int, default=1)
    arguments.add_argument("--kinds", default="")
    arguments.add_argument("--table", action="store_true")
    given = arguments.parse_args()
    if not given.table:
        compute(given.kinds, given.workers)
    print(table(given.kinds))
