"""Sweeps with names that only the program that starts them has given."""

from __future__ import annotations

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
