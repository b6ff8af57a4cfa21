"""Observed orders of incompressible flow in the spacing and in the time step, for each viscous term.

    python validation/incompressible_orders.py

- `spacing`: a manufactured flow in a closed square at Re = 100, t = 1/2, with alpha = 0, because the source
  mistakes the 0.3 % error of density sums in sheared neighbourhoods for crowding, and one term with other settings; a
  Taylor-Green vortex at Re = 100, t = 1/5, alpha = 0, from particles that are relaxed and from a lattice. The time step
  falls with the spacing.
- `time`: the manufactured flow with 64 particles a side and steps that are halved.

Errors are norms over the exact norm, of velocity and of pressure. Writes incompressible_orders.json beside itself.
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

from sphear.cases.flow import FLOWS
from sphear.cases.manufactured import manufactured, relative_errors
from sphear.references.manufactured import ClosedVortex
from sphear.references.taylor_green import TaylorGreen
from sphear.schemes.base import FlowFailure
from sphear.schemes.incompressible.flow import IncompressibleFlow
from sphear.schemes.incompressible.settings import IncompressibleSettings
from sphear.studies.kept import as_text
from sphear.viscosity import VISCOSITY

SIZES = (32, 64, 128)
TERM, REYNOLDS = "fatehi_manzari", 100.0
IN_TIME, HALVINGS = 64, 4
Errors = tuple[float, float]
BROKEN = (math.inf, math.inf)


def closed_vortex(size: int, **changes: Any) -> Errors:
    """Errors of velocity and pressure at t = 1/2."""
    exact = ClosedVortex(1.0 / REYNOLDS)
    return _errors(IncompressibleFlow(manufactured(exact, size), IncompressibleSettings(**changes)), 0.5, exact)


def vortex(size: int, **changes: Any) -> Errors:
    """The same of a Taylor-Green vortex at t = 1/5."""
    case = FLOWS["taylor-green"]
    settings = case.settings(scheme="incompressible", resolution=size, reynolds=REYNOLDS, **changes)
    assert isinstance(settings, IncompressibleSettings)
    flow = IncompressibleFlow(case.problem(settings), settings)
    return _errors(flow, 0.2, TaylorGreen(1.0 / REYNOLDS))


def _errors(flow: IncompressibleFlow, until: float, exact: ClosedVortex | TaylorGreen) -> Errors:
    """Errors of a flow then; infinite of one that broke down."""
    try:
        flow.advance(round(until / flow.time_step))
    except FlowFailure:
        return BROKEN
    return relative_errors(flow, exact)


def row(what: str, found: Sequence[Errors], **about: Any) -> dict[str, Any]:
    """Errors and the orders between them."""
    result: dict[str, Any] = {"flow": what, **about}
    for name, errors in zip(("velocity", "pressure"), zip(*found, strict=True), strict=True):
        result[name] = [float(f"{error:.3g}") if math.isfinite(error) else None for error in errors]
        result[f"{name}_orders"] = [
            round(math.log2(a / b), 2) if math.isfinite(a + b) else None for a, b in pairwise(errors)
        ]
    print(result, flush=True)
    return result


def in_space() -> list[dict[str, Any]]:
    """A row for each flow and term."""
    others: list[dict[str, Any]] = [
        {}, {"alpha": 0.0, "projection": "start"}, {"alpha": 0.0, "laplacian": TERM},
        {"alpha": 0.0, "walls": "adami"}, {"alpha": 0.0, "continuation": "linear"},
        {"alpha": 0.0, "wall_divergence": "continued"},
    ]  # fmt: skip
    chosen: list[tuple[str, Callable[..., Errors], dict[str, Any]]] = [
        *(("manufactured", closed_vortex, {"viscosity": term, "alpha": 0.0}) for term in VISCOSITY),
        *(("manufactured", closed_vortex, {"viscosity": TERM, **other}) for other in others),
        *(
            ("taylor-green", vortex, {"viscosity": term, "alpha": 0.0, "initial": start})
            for start in ("relaxed", "lattice")
            for term in VISCOSITY
        ),
        ("taylor-green", vortex, {"viscosity": TERM, "initial": "relaxed"}),
        ("taylor-green", vortex, {"viscosity": TERM, "initial": "lattice"}),
    ]
    return [row(what, [flow(size, **changes) for size in SIZES], **changes) for what, flow, changes in chosen]


def in_time() -> list[dict[str, Any]]:
    """A row for each place where forces may be found."""
    steps = [0.5 / (80 * 2**k) for k in range(HALVINGS)]
    rows = []
    for projection in ("midpoint", "start", "intermediate"):
        changes = {"viscosity": TERM, "alpha": 0.0, "projection": projection}
        found = [closed_vortex(IN_TIME, time_step=step, **changes) for step in steps]
        rows.append(row("manufactured", found, **changes, size=IN_TIME, time_steps=steps))
    return rows


def main() -> None:
    """Compute, print and write."""
    argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter).parse_args()
    kept = {"sizes": SIZES, "spacing": in_space(), "time": in_time()}
    Path(__file__).with_suffix(".json").write_text(as_text(kept), encoding="utf-8")


if __name__ == "__main__":
    main()
