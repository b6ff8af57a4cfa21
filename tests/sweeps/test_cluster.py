"""Runs on two Dask workers, one of which is killed."""

from __future__ import annotations

import socket
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

import sphear.sweeps.cluster
from sphear.errors import SphearError
from sphear.sweeps import Store, plan, run_sweep

from .sweep_functions import KILLS, RAISES

distributed = pytest.importorskip("distributed")
pytestmark = pytest.mark.filterwarnings("default")  # of Dask and what it uses

Sweep = Callable[..., Any]


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    import dask

    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(Path(__file__).parent)  # workers start with the path of their parent
        with (
            dask.config.set({"distributed.scheduler.allowed-failures": 0}),
            distributed.LocalCluster(
                n_workers=2, processes=True, threads_per_worker=1, dashboard_address=None, silence_logs=50
            ) as cluster,
        ):
            yield cluster.scheduler_address


def test_flows_on_two_workers_are_those_of_one_process(address: str, tmp_path: Path) -> None:
    runs = plan("poiseuille", {"resolution": [8, 9, 10]}, {"until": 0.05}, preset="basa2009")
    here = run_sweep(runs, Store(tmp_path / "here"))
    there = run_sweep(runs, Store(tmp_path / "there"), scheduler=address)
    for far, near in zip(there, here, strict=True):  # code just compiled and code from the cache may round differently
        assert far.metrics == pytest.approx(near.metrics)
    assert len(list((tmp_path / "there").iterdir())) == 3


def test_both_workers_are_used(address: str, sweep: Sweep) -> None:
    results = sweep([10, 20, 30, 40, 50, 60], scheduler=address)
    assert [result.settings["resolution"] for result in results] == [10, 20, 30, 40, 50, 60]
    assert len({result.performance["pid"] for result in results}) == 2


def test_a_worker_that_is_killed_loses_its_run_alone(address: str, sweep: Sweep) -> None:
    results = sweep([10, 80, KILLS, RAISES, 20, 30, 90], scheduler=address)
    assert [result.end for result in results if not result.lost] == 5 * ["time"]
    assert results[2].end == "lost: its worker was killed"
    assert results[3].end == "lost: ZeroDivisionError: there is nothing to divide by"


@pytest.mark.parametrize("address", ["tcp://127.0.0.1:9", "nonsense://somewhere", "nowhere"])
def test_a_scheduler_that_does_not_answer_is_one_sentence(
    address: str, sweep: Sweep, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sphear.sweeps.cluster, "CONNECT", 1.0)
    with pytest.raises(SphearError, match="does not answer"):
        sweep([10], scheduler=address)


def test_a_socket_that_says_nothing_is_not_waited_for_long(sweep: Sweep, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sphear.sweeps.cluster, "CONNECT", 0.5)
    with socket.create_server(("127.0.0.1", 0)) as mute:
        address = f"tcp://127.0.0.1:{mute.getsockname()[1]}"
        with pytest.raises(SphearError, match=r"does not answer: nothing came within 0\.5 s"):
            sweep([10], scheduler=address)


def test_a_scheduler_without_workers_is_waited_for_with_a_word_and_an_end(
    sweep: Sweep, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sphear.sweeps.cluster, "PATIENCE", 0.5)
    monkeypatch.setattr(sphear.sweeps.cluster, "LOOK", 0.1)
    said: list[str] = []
    with (
        distributed.LocalCluster(n_workers=0, processes=False, dashboard_address=None, silence_logs=50) as cluster,
        pytest.raises(SphearError, match=r"has had no workers for 0\.5 s: start some with dask worker"),
    ):
        sweep([10], scheduler=cluster.scheduler_address, say=said.append)
    assert len(said) == 1
    assert "has no workers: they are waited for, 0.5 s at most" in said[0]


def test_without_dask_the_extra_is_named(sweep: Sweep, monkeypatch: pytest.MonkeyPatch) -> None:
    def absent(name: str) -> None:
        raise ImportError(name)

    monkeypatch.setattr(sphear.sweeps.cluster, "import_module", absent)
    with pytest.raises(SphearError, match=r"needs the extra 'cluster': pip install 'sphear\[cluster\]'"):
        sweep([10], scheduler="tcp://127.0.0.1:8786")
