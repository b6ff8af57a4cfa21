"""Sweeps with names that only the program that starts them has given."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import sphear
from sphear.sweeps import Store, plan, run_sweep
from sphear.sweeps.objects import Named, packed, received

ENERGY = "kinetic_energy"
CHOSEN: dict[str, Any] = {"scheme": "incompressible", "resolution": 12, "until": 0.01}


@pytest.mark.usefixtures("my_terms")
def test_a_decorated_term_kernel_and_correction_reach_worker_processes(tmp_path: Path) -> None:
    named = {"kernel": "my_kernel", "gradient_correction": "my_correction"}
    runs = plan("cavity", {"viscosity": ["mine", "tripled", "morris"]}, {**CHOSEN, **named})
    mine, tripled, morris = run_sweep(runs, Store(tmp_path))
    assert [result.end for result in (mine, tripled, morris)] == ["time"] * 3
    assert (mine.settings["viscosity"], mine.settings["kernel"]) == ("mine", "my_kernel")
    assert mine.metrics[ENERGY] == pytest.approx(morris.metrics[ENERGY])
    assert tripled.metrics[ENERGY] != pytest.approx(morris.metrics[ENERGY], rel=1e-3)


SCRIPT = """
import sphear
from sphear.sweeps import Store, plan, run_sweep


@sphear.viscous_term("of_script")
def of_script(kernel, correction, own, d, r2):
    return -2.0 * correction.radial(kernel, own.prepared, d, r2) / r2


if __name__ == "__main__":
    fixed = {"scheme": "incompressible", "resolution": 12, "until": 0.01}
    (result,) = run_sweep(plan("cavity", {"viscosity": ["of_script"]}, fixed), Store("results"))
    print(result.end, result.settings["viscosity"])
"""


def test_a_term_decorated_in_a_script_reaches_worker_processes(tmp_path: Path) -> None:
    (tmp_path / "script.py").write_text(SCRIPT)
    environment = {**os.environ, "PYTHONPATH": str(Path(sphear.__file__).parents[1])}
    run = [sys.executable, "script.py"]
    found = subprocess.run(run, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
    assert (found.stdout, found.stderr) == ("time of_script\n", "")


def test_a_name_whose_class_workers_cannot_import_is_refused(tmp_path: Path) -> None:
    @sphear.viscous_term("local")
    class Local(sphear.Morris):
        """One inside a function."""

    runs = plan("cavity", {"viscosity": ["local"]}, CHOSEN)
    with pytest.raises(sphear.SphearError, match=r"the viscosity 'local', Local of this sweep .* put the class into a"):
        run_sweep(runs, Store(tmp_path))


@pytest.mark.usefixtures("my_terms")
def test_the_name_that_is_sent_takes_the_place_of_an_older_one() -> None:
    (run,) = plan("cavity", {"viscosity": ["tripled"]}, CHOSEN)
    assert isinstance(run.sent["viscosity"], Named)
    payload, tripled = packed(run), sphear.VISCOSITY["tripled"]
    sphear.VISCOSITY.put("tripled", sphear.Gotoh(printed=True))
    assert received(payload)["viscosity"] == "tripled"
    assert sphear.VISCOSITY["tripled"] == tripled
