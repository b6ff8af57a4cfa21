"""Short flows by every choice there is, and the numbers that they give: what a change of the program must leave alone.

    python validation/same_numbers.py            # compute all, and compare with what is kept
    python validation/same_numbers.py --keep     # compute what is not kept yet, and keep it

Each flow makes 20 steps of few particles. Of positions, velocities, density and pressure their means, root mean squares
and two sums with weights that differ from particle to particle are kept, with all digits. Incompressible flows solve
for the pressure to 1e-12, so that the order of sums does not matter. Where a number should change, its flow is computed
again by `--flows NAME --keep`, and the changelog says why.
"""

from __future__ import annotations

import argparse
import json
import math
from pathlib import Path
from typing import Any

import numpy as np

KEPT = Path(__file__).with_suffix(".json")
STEPS = 20
CLOSE = 1e-10  # relative, of the root mean square of a field

EXPLICIT = {"scheme": "explicit", "preset": "basa2009", "reynolds": 1.0, "resolution": 12}
BEST = {"scheme": "explicit", "reynolds": 1.0, "resolution": 12}
CONTINUED = {**EXPLICIT, "density": "continuity"}
PROJECTION = {"scheme": "incompressible", "reynolds": 10.0, "resolution": 12, "tolerance": 1e-12}
PAPER = {**PROJECTION, "preset": "zheng2018"}

TERMS = (
    "takeda", "two_pass", "violeau", "cleary", "morris", "monaghan", "gotoh", "schwaiger", "oger", "espanol_revenga",
    "fatehi_manzari", "least_squares", "cleary_4.24", "least_squares_3",
)  # fmt: skip
SOLIDS = ("Circle((0.4, 0.5), 0.15)", "Rectangle((0.3, 0.3), (0.7, 0.65))")
CORRECTIONS = ("shepard", "renormalised", "bonet_lok")


def of(case: str, common: dict[str, Any], key: str, *values: Any, **changes: Any) -> dict[str, dict[str, Any]]:
    """A flow for each value of a setting."""
    name = {id(EXPLICIT): "explicit", id(BEST): "best", id(CONTINUED): "continuity", id(PROJECTION): "incompressible"}
    kind = name.get(id(common), "zheng2018")
    besides = "".join(f" {k}={v}" for k, v in changes.items())
    return {
        f"{kind} {case} {key}={value}{besides}": {"case": case, **common, **changes, key: value} for value in values
    }


FLOWS: dict[str, dict[str, Any]] = {
    "best cavity": {"case": "cavity", **BEST},
    "best taylor-green": {"case": "taylor-green", **BEST},
    "best couette": {"case": "couette", **BEST},
    "basa2009 cavity": {"case": "cavity", **EXPLICIT},
    "basa2009 couette": {"case": "couette", **EXPLICIT},
    **of("poiseuille", EXPLICIT, "viscosity", *TERMS),
    **of("poiseuille", EXPLICIT, "correction", *CORRECTIONS),
    **of("poiseuille", EXPLICIT, "continuation", "mirror", "linear", "quadratic"),
    **of("poiseuille", EXPLICIT, "equation_of_state", "linear", "ideal_gas"),
    **of("poiseuille", EXPLICIT, "pressure_reduction", "none", "hydrostatic"),
    **of("poiseuille", EXPLICIT, "walls", "adami", "fixed"),
    **of("poiseuille", EXPLICIT, "wall_particles", True),
    **of("poiseuille", EXPLICIT, "integrator", "kick_drift_kick"),
    **of("poiseuille", EXPLICIT, "kernel", "gaussian", "wendland_c4"),
    **of("poiseuille", EXPLICIT, "initial", "staggered", "relaxed"),
    **of("taylor-green", EXPLICIT, "transport", "shifting", "transport_velocity"),
    **of("cavity", CONTINUED, "walls", "adami", "mirror", continuation="linear", correction="none"),
    **of("poiseuille", CONTINUED, "wall_divergence", "slipping", "continued"),
    **of("poiseuille", CONTINUED, "diffusion_form", "molteni", "antuono", density_diffusion=0.1),
    **of("poiseuille", CONTINUED, "equation_of_state", "ideal_gas"),
    "incompressible poiseuille": {"case": "poiseuille", **PROJECTION},
    "incompressible couette": {"case": "couette", **PROJECTION},
    "incompressible taylor-green": {"case": "taylor-green", **PROJECTION},
    "incompressible dam-break": {"case": "dam-break", **PROJECTION, "resolution": 8},
    "incompressible cavity-cylinder": {"case": "cavity-cylinder", **PROJECTION, "resolution": 16, "spin": 0.5},
    "zheng2018 cavity": {"case": "cavity", **PAPER},
    "zheng2018 taylor-green": {"case": "taylor-green", **PAPER},
    **of("cavity", PROJECTION, "viscosity", *TERMS),
    **of("cavity", PROJECTION, "correction", *CORRECTIONS[1:], viscosity="morris"),
    **of("cavity", PROJECTION, "continuation", "mirror", "linear", "wall"),
    **of("cavity", PROJECTION, "walls", "adami", "sfdi", "natural"),
    **of("cavity", PROJECTION, "gradient", "sfdi"),
    **of("cavity", PROJECTION, "gradient", "symmetric", gradient_correction="none", pressure_level="least"),
    **of("cavity", PROJECTION, "projection", "start", "intermediate"),
    **of("cavity", PROJECTION, "shifting", "none", "xu"),
    **of("cavity", PROJECTION, "viscous_step", "crank_nicolson", "backward_euler"),
    **of("cavity", PROJECTION, "preconditioner", "amg", "jacobi"),
    **of("cavity", PROJECTION, "wall_divergence", "continued"),
    **of("cavity", PROJECTION, "solid", *SOLIDS, resolution=16),
    **of("poiseuille", PROJECTION, "solid", "Circle((0.2, 0.5), 0.13)", resolution=20),
}  # fmt: skip


def numbers(settings: dict[str, Any]) -> dict[str, list[float]]:
    """Means, root mean squares and weighted sums of each field after so many steps."""
    import sphear

    given = {"threads": 1, "max_steps": STEPS, **settings}
    run = sphear.flow(given.pop("case"), beyond=("steady", "failed"), **given).run()
    assert run.flow.steps == STEPS, run.end
    flow = run.flow
    found = {}
    for name in ("positions", "velocities", "density", "pressure"):
        values = np.asarray(getattr(flow, name)).reshape(flow.count, -1)
        at = np.arange(flow.count)[:, None]
        found[name] = [
            float(number)
            for number in (
                values.mean(),
                np.sqrt((values**2).mean()),
                *((values * np.cos(k * at + k)).mean() for k in (1, 2)),
            )
        ]
    return found


def deviation(found: dict[str, list[float]], known: dict[str, list[float]]) -> float:
    """The largest difference of two flows' numbers over the root mean square of their field."""
    largest = 0.0
    for name, values in known.items():
        scale = max(values[1], 1e-12)
        largest = max(largest, *(abs(a - b) / scale for a, b in zip(found[name], values, strict=True)))
    return largest if math.isfinite(largest) else math.inf


def main() -> int:
    """Compute, and compare or keep; 1 where numbers have changed."""
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--keep", action="store_true", help="keep what is not kept yet, or is named")
    arguments.add_argument("--flows", default="", help="only those whose name has that in it")
    given = arguments.parse_args()
    kept: dict[str, Any] = json.loads(KEPT.read_text()) if KEPT.exists() else {}
    changed = 0
    for name, settings in FLOWS.items():
        if given.flows not in name or (given.keep and name in kept and not given.flows):
            continue
        found = numbers(settings)
        if given.keep:
            kept[name] = found
            lines = ",\n".join(f"{json.dumps(key)}: {json.dumps(kept[key])}" for key in FLOWS if key in kept)
            KEPT.write_text("{\n" + lines + "\n}\n")
            print(f"{name}: kept", flush=True)
        elif name not in kept:
            print(f"{name}: not kept", flush=True)
        else:
            off = deviation(found, kept[name])
            changed += off > CLOSE
            print(f"{name}: {'same' if off <= CLOSE else 'CHANGED'}, {off:.1e}", flush=True)
    print(f"{changed} changed")
    return int(changed > 0)


if __name__ == "__main__":
    raise SystemExit(main())
