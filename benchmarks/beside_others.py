"""sphear's transport-velocity cavity beside those of PySPH and JAX-SPH, 50 x 50 particles, on one core.

Walls after Adami et al. (2012), one force evaluation a step, 26 to 28 neighbours. Fluid particles times steps a second
count, of all programs; wall particles are extra work of each. PYSPH_PYTHON and JAX_SPH_PYTHON name interpreters that
have them, if this one has not.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

from _bench import Measurement, Report, best_of
from step import flow, stepping

SIDE = 50
# name, module, script, variable, steps, how many times as fast sphear is asked to be
OTHERS = (
    ("PySPH", "pysph", "_pysph_cavity.py", "PYSPH_PYTHON", 500, 5.0),
    ("JAX-SPH", "jax_sph", "_jax_sph_cavity.py", "JAX_SPH_PYTHON", 200, 20.0),
)


def other(name: str, module: str, script: str, variable: str, steps: int) -> Measurement | None:
    """Seconds a step of another program, in a process of its own; None where it is not installed."""
    interpreter = os.environ.get(variable, sys.executable)
    alone = {**os.environ, "OMP_NUM_THREADS": "1"}
    if subprocess.run([interpreter, "-c", f"import {module}"], env=alone, capture_output=True).returncode:
        return None
    command = [interpreter, str(Path(__file__).parent / script), str(SIDE), str(steps)]

    def measure() -> dict[str, float]:
        said = subprocess.run(command, env=alone, capture_output=True, text=True, check=True).stdout
        return {name: float(said.split()[-1])}

    return measure


def main() -> None:
    report = Report(__doc__ or "")
    cavity = flow("cavity", resolution=SIDE, threads=1, walls="adami", correction="none", pressure_reduction="none",
                  transport="transport_velocity", integrator="kick_drift_kick", kernel="wendland_c2",
                  h_over_dx=1.43)  # fmt: skip
    mine = stepping("sphear", cavity, 20)
    report.add("sphear", cavity.count / best_of(5, mine)["sphear"] / 1e6, "M/s")
    for name, module, script, variable, steps, asked in OTHERS:
        theirs = other(name, module, script, variable, steps)
        if theirs is None:
            report.say(f"{name} is not installed: skipped. {variable} may name an interpreter that has it.")
            continue
        times = best_of(20, mine, theirs)
        report.add(name, cavity.count / times[name] / 1e6, "M/s")
        report.add(f"speed, sphear / {name}", times[name] / times["sphear"], at_least=asked)
    report.close()


if __name__ == "__main__":
    main()
