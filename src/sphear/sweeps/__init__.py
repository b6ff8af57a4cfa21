"""Sweeps: many runs of flows, on many processes, that go on where they were interrupted.

Importing this imports no compiler: a worker sets itself up before it does.
"""

from sphear.sweeps.plan import Run, plan
from sphear.sweeps.progress import Progress, SweepProgress
from sphear.sweeps.result import SweepResult
from sphear.sweeps.store import Store
from sphear.sweeps.sweep import SweepWarning, run_sweep

__all__ = ["Progress", "Run", "Store", "SweepProgress", "SweepResult", "SweepWarning", "plan", "run_sweep"]
