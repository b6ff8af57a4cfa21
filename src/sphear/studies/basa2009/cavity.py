"""The runs behind figures 8 to 10: the lid-driven cavity with each viscous term and correction."""

from __future__ import annotations

from sphear.studies.basa2009.models import CORRECTIONS, MODELS
from sphear.sweeps import Run, plan

TERMS = tuple(MODELS.values())
UNTIL = {100.0: 20.0, 1000.0: 80.0}
PARTICLES = 50  # a side


def runs(quick: bool = False) -> list[Run]:
    """All runs, those of Re = 100 first; with `quick` one term at Re = 100 with fewer particles and for less long."""
    if quick:
        return plan("cavity", {"viscosity": ("morris",)}, {"resolution": 20, "until": 2.0}, preset="basa2009")
    return [
        run
        for reynolds, until in UNTIL.items()
        for run in plan(
            "cavity",
            {"correction": CORRECTIONS, "viscosity": TERMS},
            {"reynolds": reynolds, "until": until, "resolution": PARTICLES},
            preset="basa2009",
        )
    ]
