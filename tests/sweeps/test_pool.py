"""Runs on processes: order, threads, what is lost when a worker dies, and what is told."""

from __future__ import annotations

import multiprocessing
import os
import threading
import time
from collections.abc import Callable
from typing import Any

import pytest

from sphear.errors import SphearError
from sphear.sweeps import Store, SweepProgress
from sphear.sweeps.events import Started
from sphear.sweeps.pool import on_processes

from .conftest import SCRIPTED, runs
from .sweep_functions import ENDS, FAILS, KILLS, RAISES, SLEEPS

Sweep = Callable[..., Any]
Calls = Callable[[], list[int]]


def test_results_come_in_the_order_of_the_runs(sweep: Sweep) -> None:
    results = sweep([10, 30, 20, 40], workers=2)
    assert [result.settings["resolution"] for result in results] == [10, 30, 20, 40]
    assert 1 <= len({result.performance["pid"] for result in results} - {os.getpid()}) <= 2


def test_long_runs_come_first(sweep: Sweep, calls: Calls) -> None:
    sweep([10, 30, 20, 40])
    assert calls() == [40, 30, 20, 10]


def test_short_runs_come_first_where_that_is_asked_for(sweep: Sweep, calls: Calls) -> None:
    sweep([10, 30, 20, 40], longest_first=False)
    assert calls() == [10, 20, 30, 40]


def test_a_worker_is_kept_for_all_its_runs_and_has_one_thread(sweep: Sweep) -> None:
    results = sweep([10, 20, 30])
    assert len({result.performance["pid"] for result in results}) == 1
    assert {result.performance["threads"] for result in results} == {"1"}


@pytest.mark.parametrize("workers", [1, 2])
def test_a_worker_that_is_killed_loses_its_run_alone(workers: int, sweep: Sweep) -> None:
    results = sweep([10, KILLS, 20, 80, 30], workers=workers)
    assert [result.lost for result in results] == [False, True, False, False, False]
    assert results[1].end == "lost: its worker was killed by SIGKILL"
    assert results[1].settings["resolution"] == KILLS


def test_a_worker_that_ends_and_a_run_that_raises(sweep: Sweep) -> None:
    ended, raised, other = sweep([ENDS, RAISES, 10])
    assert ended.end == "lost: its worker ended with status 3"
    assert raised.end == "lost: ZeroDivisionError: there is nothing to divide by"
    assert other.end == "time"


def test_what_is_no_result_is_lost(sweep: Sweep) -> None:
    (result,) = sweep([10], compute="sweep_functions:nonsense")
    assert result.end == "lost: what came back is no result"
    (result,) = sweep([10], compute="sweep_functions:nothing")
    assert result.end.startswith("lost: AttributeError")


def test_where_the_sweep_stands_is_told(sweep: Sweep) -> None:
    sweep([10])
    states: list[SweepProgress] = []
    sweep([10, 20, FAILS, KILLS], workers=2, progress=states.append)
    first, last = states[0], states[-1]
    assert first == SweepProgress(runs=4, done=1, stored=1, running=0, failed=0, lost=0, seconds_left=None)
    assert last == SweepProgress(runs=4, done=3, stored=1, running=0, failed=1, lost=1, seconds_left=0.0)
    assert 1 <= max(state.running for state in states) <= 2
    assert str(last) == "3 of 4 runs done, 0 running, 1 failed, 1 lost, about 0 s left"


@pytest.mark.parametrize("workers", [0, -1])
def test_no_workers_are_refused(workers: int, sweep: Sweep) -> None:
    with pytest.raises(SphearError, match="workers must be at least 1"):
        sweep([10], workers=workers)


def test_closed_early_it_ends_its_workers_at_once(calls: Calls) -> None:
    events = on_processes(runs([SLEEPS, 10]), 2, SCRIPTED)
    assert isinstance(next(events), Started)
    until = time.monotonic() + 300
    while SLEEPS not in calls():
        assert time.monotonic() < until
        time.sleep(0.05)
    began = time.monotonic()
    events.close()
    assert time.monotonic() - began < 300  # the run itself takes 600
    assert multiprocessing.active_children() == []
    assert not [thread for thread in threading.enumerate() if thread.name == "sphear-sweep"]


def test_a_disk_that_is_full_ends_the_sweep(sweep: Sweep, store: Store, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(run: object, result: object) -> None:
        raise SphearError("the disk is full")

    monkeypatch.setattr(store, "put", full)
    with pytest.raises(SphearError, match="the disk is full"):
        sweep([10, SLEEPS], workers=2)
    assert multiprocessing.active_children() == []


def test_workers_that_do_not_start_are_one_sentence(sweep: Sweep, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sphear.sweeps.pool.prepare", os.abort)
    with pytest.raises(SphearError, match="worker processes do not start"):
        sweep([10])
