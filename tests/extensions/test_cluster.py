"""A sweep on a Dask worker that has no file of the extension: what it names is sent along whole."""

from __future__ import annotations

from pathlib import Path

import pytest

from sphear.extensions import loading
from sphear.sweeps import Store, plan, run_sweep

from .conftest import FILE

distributed = pytest.importorskip("distributed")
pytestmark = pytest.mark.filterwarnings("default")  # of Dask and what it uses


def test_what_a_file_names_reaches_a_worker_without_the_file(tmp_path: Path) -> None:
    with distributed.LocalCluster(
        n_workers=1, processes=True, threads_per_worker=1, dashboard_address=None, silence_logs=50
    ) as cluster:
        loading.load([str(FILE)])
        over = {"viscosity": ["mine", "tripled", "by_function", "morris"]}
        runs = plan(
            "cavity", over, {"scheme": "incompressible", "resolution": 12, "until": 0.01, "kernel": "my_kernel"}
        )
        mine, tripled, function, morris = run_sweep(runs, Store(tmp_path), scheduler=cluster.scheduler_address)
    assert [result.end for result in (mine, tripled, function, morris)] == ["time"] * 4
    energies = [result.metrics["kinetic_energy"] for result in (mine, function, tripled)]
    assert energies[:2] == pytest.approx([morris.metrics["kinetic_energy"]] * 2)
    assert energies[2] != pytest.approx(energies[0], rel=1e-3)
