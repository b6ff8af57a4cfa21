"""A run stops now and then, to listen and to save: what it finds knows nothing of that."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from sphear.cases.flow import FLOWS, CaseRun
from sphear.cases.flow import run as module
from sphear.cases.flow.history import CaseHistory
from sphear.errors import SphearError
from sphear.schemes.presets import PRESETS
from sphear.simulation import pace
from sphear.simulation.pace import Savings, Slices
from sphear.simulation.saved import About, read, write

RUNS: dict[str, tuple[str, dict[str, Any]]] = {
    "explicit": ("poiseuille", {**PRESETS["basa2009"], "resolution": 10, "until": 0.3}),
    "kick drift kick": (
        "poiseuille",
        {**PRESETS["basa2009"], "resolution": 10, "until": 0.3, "integrator": "kick_drift_kick"},
    ),
    "incompressible": ("cavity", {"scheme": "incompressible", "resolution": 10, "until": 1.2}),
}
FEW = 5  # outputs of a run, so that there are steps between them


def start(which: str = "explicit", **changes: Any) -> CaseRun:
    case, settings = RUNS[which]
    return CaseRun(FLOWS[case], FLOWS[case].settings(**{**settings, "threads": 1, **changes}))


@pytest.fixture(autouse=True)
def few_outputs(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "OUTPUTS", FEW)


@pytest.fixture
def single_steps(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pace, "SLICE", 0.0)


def stopped_after(run: CaseRun, slices: int, keep: Path | None = None) -> CaseRun:
    calls = iter(range(10**6))
    with pytest.raises(KeyboardInterrupt):
        run.run(keep=keep, stopped=lambda: next(calls) == slices)
    return run


def equal(one: CaseRun, other: CaseRun) -> bool:
    assert (one.end, one.flow.time, one.flow.steps) == (other.end, other.flow.time, other.flow.steps)
    assert one.history == other.history
    for name, values in other.flow.state().items():
        np.testing.assert_array_equal(one.flow.state()[name], values)
    return True


@pytest.mark.parametrize("which", RUNS)
def test_slices_change_nothing(which: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pace, "SLICE", 1e9)
    whole = start(which).run()
    assert whole.flow.steps > 2 * len(whole.history)
    monkeypatch.setattr(pace, "SLICE", 0.0)
    assert equal(start(which).run(), whole)


@pytest.mark.parametrize("which", RUNS)
def test_a_run_that_is_stopped_between_outputs_keeps_the_present_state(
    which: str, single_steps: None, tmp_path: Path
) -> None:
    path, whole = tmp_path / "state.npz", start(which).run()
    stopped = stopped_after(start(which), 4, path)
    assert stopped.flow.steps == 4
    assert stopped.saved == stopped.flow.time / stopped.unit
    again = start(which)
    again.restore(path)
    assert again.flow.steps == 4
    assert equal(again.run(), whole)


def test_a_run_that_is_stopped_can_go_on_as_it_is(single_steps: None) -> None:
    assert equal(stopped_after(start(), 7).run(), start().run())


def test_an_output_that_ctrl_c_prevented_is_made_when_the_run_goes_on(
    single_steps: None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    whole, path = start().run(), tmp_path / "state.npz"

    def interrupt(history: CaseHistory, run: CaseRun) -> None:
        raise KeyboardInterrupt

    run = start()
    with monkeypatch.context() as patched:
        patched.setattr(CaseHistory, "watch", interrupt)
        with pytest.raises(KeyboardInterrupt):
            run.run(keep=path)
    assert run.history == []
    again = start()
    again.restore(path)
    assert equal(again.run(), whole)


@pytest.mark.parametrize("which", RUNS)
def test_a_run_that_ended_goes_on_to_a_later_end(which: str, tmp_path: Path) -> None:
    path, later = tmp_path / "state.npz", 2 * RUNS[which][1]["until"]
    longer = start(which, until=later).run()
    first = start(which).run(keep=path)
    assert first.end == "time"
    again = start(which, until=later)
    again.restore(path)
    again.run()
    for name, values in longer.flow.state().items():
        np.testing.assert_array_equal(again.flow.state()[name], values)
    appended = [row for row in longer.history if row["steps"] > first.flow.steps]
    assert again.history == first.history + appended


def test_a_run_that_ended_and_goes_on_to_the_same_end_makes_no_step(tmp_path: Path) -> None:
    path = tmp_path / "state.npz"
    first = start().run(keep=path)
    again = start()
    again.restore(path)
    assert equal(again.run(), first)
    assert again.seconds == first.seconds


def test_a_run_stops_at_a_step_that_ends_at_its_end() -> None:
    run = start(until=None, time_step=0.001, max_steps=10**6)
    run = start(until=100 * 0.001 / run.unit, time_step=0.001)
    assert run.run().flow.steps == 100


def test_the_state_of_a_run_that_fails_is_the_last_before_it(tmp_path: Path) -> None:
    path = tmp_path / "state.npz"
    failed = start(sound_speed=0.2, until=5.0).run(keep=path)
    assert failed.end.startswith("failed: ")
    about, state = read(path)
    assert about.end == ""
    assert int(state["clock"][1]) < failed.flow.steps
    again = start(sound_speed=0.2, until=5.0)
    again.restore(path)
    assert again.run().end == failed.end
    assert again.history == failed.history


class Disk:
    """A disk that is full at its first writings."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, full: int) -> None:
        self.tried, self.full, self._write = 0, full, write
        monkeypatch.setattr(module, "write", self.write)
        monkeypatch.setenv("SPHEAR_SAVE_SECONDS", "0")

    def write(self, path: Path, about: About, state: dict[str, Any]) -> None:
        self.tried += 1
        if self.tried <= self.full:
            raise OSError(28, "No space left on device")
        self._write(path, about, state)


def test_a_state_that_cannot_be_saved_ends_no_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path, whole, said = tmp_path / "state.npz", start().run(), list[str]()
    disk = Disk(monkeypatch, full=2)
    run = start().run(keep=path, warn=said.append)
    assert equal(run, whole)
    assert said == [f"the state cannot be saved in {path}: No space left on device, the run goes on and tries again"]
    assert disk.tried > 3
    assert read(path)[0].history == whole.history


def test_a_last_state_that_cannot_be_saved_is_said(
    single_steps: None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    said = list[str]()
    Disk(monkeypatch, full=10**6)
    run = start()
    with pytest.raises(KeyboardInterrupt):
        run.run(keep=tmp_path / "state.npz", stopped=lambda: run.flow.steps == 3, warn=said.append)
    assert len(said) == 2
    assert said[1].endswith("state.npz: No space left on device")
    assert run.saved is None


def test_slices_take_half_a_second() -> None:
    slices = Slices()
    assert slices.steps == 1
    slices.measured(10, 1.0)
    assert slices.steps == 5
    slices.measured(1, 60.0)
    assert slices.steps == 1


class Clock:
    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.now = 100.0
        monkeypatch.delenv("SPHEAR_SAVE_SECONDS")
        monkeypatch.setattr(time, "monotonic", lambda: self.now)


def test_the_state_is_saved_every_ten_seconds(monkeypatch: pytest.MonkeyPatch) -> None:
    clock, savings = Clock(monkeypatch), Savings(1e6, 0)
    clock.now += 9.9
    assert not savings.due(5)
    clock.now += 0.1
    assert savings.due(5)
    savings.tried(clock.now - 0.05, 5)
    clock.now += 10.0
    assert savings.due(6)


def test_saving_that_takes_long_is_done_at_each_hundredth_of_the_run(monkeypatch: pytest.MonkeyPatch) -> None:
    clock, savings = Clock(monkeypatch), Savings(1000, 0)
    savings.tried(clock.now - 2.0, 0)
    clock.now += 20.0
    assert not savings.due(9)
    assert savings.due(10)
    clock.now += 180.0
    assert savings.due(9)


@pytest.mark.parametrize("text", ["soon", "-1", "nan"])
def test_seconds_that_are_none_are_refused(text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SPHEAR_SAVE_SECONDS", text)
    with pytest.raises(SphearError, match=r"^the environment variable SPHEAR_SAVE_SECONDS must be a number of seconds"):
        Savings(1.0, 0)
