"""What is stored, what is taken from there, and what is computed again."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import sphear
from sphear.cases.flow import FLOWS, CaseRun
from sphear.errors import SphearError
from sphear.sweeps import Store, plan, run_sweep
from sphear.sweeps.result import HISTORY, of_record, record

from .conftest import runs
from .sweep_functions import FAILS, KILLS, RAISES

Sweep = Callable[..., Any]
Calls = Callable[[], list[int]]


def test_a_stored_run_is_not_computed_again(sweep: Sweep, calls: Calls) -> None:
    first = sweep([10, 20])
    assert sweep([10, 20]) == first
    assert sorted(calls()) == [10, 20]


def test_a_run_that_failed_is_a_result(sweep: Sweep, calls: Calls) -> None:
    for _ in range(2):
        (result,) = sweep([FAILS])
        assert (result.failed, result.lost, result.end) == (True, False, "failed: it broke down")
    assert calls() == [FAILS]


def test_a_run_whose_worker_was_killed_is_computed_again_each_time(sweep: Sweep, calls: Calls, store: Store) -> None:
    for _ in range(3):
        assert [result.lost for result in sweep([KILLS])] == [True]
    assert calls() == [KILLS, KILLS, KILLS]
    assert not store.folder.path.exists()


def test_a_run_that_ended_with_an_exception_is_tried_once_more_and_says_why(sweep: Sweep, calls: Calls) -> None:
    said: list[str] = []
    reason = "ZeroDivisionError: there is nothing to divide by"
    for _ in range(3):
        (result,) = sweep([RAISES], say=said.append)
        assert result.end == f"lost: {reason}"
    assert calls() == [RAISES, RAISES]
    assert [sentence.split(" (")[0] for sentence in said] == [
        "1 run that ended with an exception is computed again",
        "1 run has ended with an exception 2 times; remove the file for another attempt",
    ]
    assert all(reason in sentence for sentence in said)


def test_what_is_new_is_computed_and_nothing_else(sweep: Sweep, calls: Calls) -> None:
    sweep([10, 20])
    results = sweep([20, 30, 10])
    assert [result.settings["resolution"] for result in results] == [20, 30, 10]
    assert calls()[2:] == [30]


def test_a_run_that_comes_up_again_is_computed_once(store: Store, calls: Calls) -> None:
    one, other = runs([10, 20])
    results = run_sweep([one, other, one], store, compute="sweep_functions:scripted")
    assert results[0] is results[2]
    assert sorted(calls()) == [10, 20]


@pytest.mark.parametrize("text", ["", "{", "[]", '{"case": "poiseuille"}', "\x00\xff"])
def test_a_file_that_is_not_whole_is_ignored_and_replaced(text: str, sweep: Sweep, store: Store) -> None:
    (run,) = runs([10])
    (result,) = sweep([10])
    store.path(run).write_text(text)
    said: list[str] = []
    assert store.get(run) is None
    assert sweep([10], say=said.append)[0].metrics == result.metrics
    assert len(said) == 1
    assert "1 stored result is not its run's and is computed again" in said[0]
    assert store.get(run) is not None


def test_what_another_process_left_behind_is_ignored(sweep: Sweep, store: Store) -> None:
    (run,) = runs([10])
    store.folder.path.mkdir()
    (store.folder.path / f".{run.key}.json.77.partial").write_text("{")
    assert store.get(run) is None
    assert sweep([10])[0].end == "time"


def test_numbers_that_json_does_not_know_are_none_at_once_and_later(sweep: Sweep) -> None:
    assert [sweep([10])[0].metrics["time"] for _ in range(2)] == [None, None]


def test_a_store_that_cannot_be_is_refused(tmp_path: Path) -> None:
    (tmp_path / "taken").touch()
    with pytest.raises(SphearError, match="is a file"):
        Store(tmp_path / "taken")


def test_a_long_history_is_thinned_and_keeps_its_ends() -> None:
    flow = sphear.flow("poiseuille", preset="basa2009", resolution=10, until=0.05).run()
    flow.history = [{**flow.history[0], "steps": float(step)} for step in range(1234)]
    kept = [row["steps"] for row in record(flow)["history"]]
    assert len(kept) == HISTORY
    assert (kept[0], kept[-1]) == (0, 1233)
    assert kept == sorted(set(kept))


def test_a_flow_is_stored_as_it_was_computed(store: Store) -> None:
    (run,) = plan("poiseuille", {"resolution": [10]}, {"until": 0.05}, preset="basa2009")
    (result,) = run_sweep([run], store)
    alone = record(CaseRun(FLOWS[run.case], run.settings).run())
    assert result.end == alone["end"]
    # code just compiled and code from the cache may round differently
    assert result.metrics == pytest.approx(alone["metrics"])
    assert [row["steps"] for row in result.history] == [row["steps"] for row in alone["history"]]
    assert result.history[-1] == pytest.approx(alone["history"][-1])
    assert store.get(run) == result
    stored = json.loads(store.path(run).read_text())
    assert list(stored) == ["format", "case", "settings", "metrics", "end", "performance", "history", "versions"]
    assert stored["settings"]["sound_speed"] > 0
    assert of_record(stored) == result
