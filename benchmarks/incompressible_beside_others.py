"""A step of the incompressible scheme beside one with an unpreconditioned solver, and beside PySPH's.

Each on one core. PYSPH_PYTHON names an interpreter that has PySPH, if this one has not.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
from _bench import Measurement, Report, best_of, clocked, own_clock
from scipy.sparse.linalg import LinearOperator, bicgstab

from sphear.cases.flow import FLOWS
from sphear.pressure import Solution
from sphear.schemes.base import Flow, flow_of
from sphear.schemes.incompressible import pressures

WARM_UP = 20  # steps, until particles are disordered and the pressure is known


def cavity(side: int, **settings: Any) -> Flow:
    """A cavity at Re = 1000 some steps after its start."""
    case = FLOWS["cavity"]
    chosen = case.settings(scheme="incompressible", reynolds=1000.0, resolution=side, threads=1, **settings)
    made = flow_of(case.problem(chosen), chosen)
    made.advance(WARM_UP)
    return made


def unpreconditioned(system: Any, right: Any, guess: Any, name: Any, tolerance: float, floor: float) -> Solution:
    """SciPy's BiCGSTAB on the same system from the same guess to the same tolerance, constants taken out as well."""

    def times(vector: Any) -> Any:
        product = system.matrix @ vector
        return product - product.mean()

    balanced = right - right.mean()
    operator = LinearOperator(system.matrix.shape, matvec=times, dtype=np.float64)
    values, fault = bicgstab(operator, balanced, guess, rtol=tolerance, maxiter=5000)
    if fault:
        raise SystemExit("plain BiCGSTAB did not converge")
    residual = float(np.linalg.norm(balanced - times(values)) / np.linalg.norm(balanced))
    return Solution(values, 0, residual, 0.0, "bicgstab", "none")


def free(system: Any, right: Any, guess: Any, name: Any, tolerance: float, floor: float) -> Solution:
    """No solve at all: what no solver can be faster than."""
    return Solution(guess, 0, 0.0, 0.0, "none", "none")


def exchanged(flow: Flow, name: str, solver: Any, cold: bool) -> Measurement:
    """The same step again and again, its solver exchanged, from the last pressure or from none."""
    with_it, state = pressures.solve, flow.state()

    def measure() -> dict[str, float]:
        flow.restore(state)
        if cold:
            flow.pressure[:] = 0.0
        pressures.solve = solver
        begin = own_clock()
        try:
            flow.advance(1)
        finally:
            pressures.solve = with_it
        return {name: own_clock() - begin}

    return measure


def beside_plain_solver(report: Report, side: int, tolerance: float, cold: bool) -> None:
    """A step beside the same with SciPy's plain BiCGSTAB, and beside one whose pressure costs nothing."""
    solvers = {"sphear": pressures.solve, "plain": unpreconditioned, "free": free}
    flows = [(cavity(side, tolerance=tolerance), name, solver) for name, solver in solvers.items()]
    times = best_of(10, *(exchanged(flow, name, solver, cold) for flow, name, solver in flows))
    begun = "from nothing" if cold else "from the last pressure"
    report.add(f"cavity {side}x{side}, to {tolerance:g} {begun}, a step", 1e3 * times["sphear"], "ms")
    asked = {"at_least": 20} if side == 100 else {}
    report.add("  speed over unpreconditioned BiCGSTAB", times["plain"] / times["sphear"], **asked)
    report.add("  that of a solve that costs nothing", times["plain"] / times["free"])
    of_solves = (times["plain"] - times["free"]) / (times["sphear"] - times["free"])
    report.add("  speed of the solve alone", of_solves)


def pysph(side: int, steps: int) -> Measurement | None:
    """Seconds a step of PySPH's ISPH, in a process of its own; None where it is not installed."""
    interpreter = os.environ.get("PYSPH_PYTHON", sys.executable)
    alone = {**os.environ, "OMP_NUM_THREADS": "1"}
    if subprocess.run([interpreter, "-c", "import pysph"], env=alone, capture_output=True).returncode:
        return None
    command = [interpreter, str(Path(__file__).parent / "_pysph_isph.py"), str(side), str(steps)]

    def measure() -> dict[str, float]:
        said = subprocess.run(command, env=alone, capture_output=True, text=True, check=True).stdout
        return {"PySPH": float(said.split()[-1])}

    return measure


def main() -> None:
    report = Report(__doc__ or "")
    for side, tolerance, cold in ((100, 1e-4, False), (100, 1e-6, True), (200, 1e-6, True)):
        beside_plain_solver(report, side, tolerance, cold)

    case = FLOWS["taylor-green"]
    chosen = case.settings(scheme="incompressible", resolution=50, threads=1)
    vortex = flow_of(case.problem(chosen), chosen)
    vortex.advance(WARM_UP)
    mine, theirs = clocked("sphear", lambda: vortex.advance(1)), pysph(50, 30)
    if theirs is None:
        report.say("PySPH is not installed: skipped. PYSPH_PYTHON may name an interpreter that has it.")
    else:
        times = best_of(20, mine, theirs)
        report.add("Taylor-Green 50x50, a step", 1e3 * times["sphear"], "ms")
        report.add("  speed over PySPH's ISPH", times["PySPH"] / times["sphear"], at_least=15)
    report.close()


if __name__ == "__main__":
    main()
