"""The runs behind figure 5: when a channel fails, for each viscous term, correction, equation of state and Re."""

from __future__ import annotations

from sphear.studies.basa2009.models import CORRECTIONS
from sphear.sweeps import Run, plan

TERMS = ("takeda", "two_pass", "violeau", "cleary", "cleary_4.24", "cleary_4.96333", "morris")
EQUATIONS = ("batchelor_tait", "ideal_gas")
REYNOLDS = (0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0, 3000.0, 10_000.0)
ERROR_REYNOLDS = 0.5  # of the plots of the error against time
BEST_REYNOLDS = (*REYNOLDS[:9], ERROR_REYNOLDS)  # up to 1000
BEST_STEPS = 4_000_000  # enough for the steady state at Re = 1000


def runs(quick: bool = False) -> list[Run]:
    """All runs; with `quick` two terms without correction at three Reynolds numbers."""
    return plan(
        "poiseuille",
        {
            "equation_of_state": EQUATIONS[:1] if quick else EQUATIONS,
            "correction": CORRECTIONS[:1] if quick else CORRECTIONS,
            "viscosity": ("violeau", "morris") if quick else TERMS,
            "reynolds": (0.3, ERROR_REYNOLDS, 10.0) if quick else (*REYNOLDS, ERROR_REYNOLDS),
        },
        preset="basa2009",
    )


def best_runs(quick: bool = False) -> list[Run]:
    """The same channel with the best settings, to the steady state.

    Velocities in the divergence at walls are continued: slipping ones cost channels an error in proportion to Re, 0.8 %
    at Re = 300.
    """
    fixed = {"wall_divergence": "continued", "integrator": "kick_drift_kick", "max_steps": BEST_STEPS}
    return plan("poiseuille", {"reynolds": (ERROR_REYNOLDS, 3.0) if quick else BEST_REYNOLDS}, fixed)
