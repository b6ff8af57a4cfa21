"""Runs that are interrupted, kept and gone on with; and what the best settings give."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from sphear.cases.flow import FLOWS, CaseRun
from sphear.errors import SphearError
from sphear.schemes.presets import BY_SCHEME, PRESETS

SETTINGS: dict[str, dict[str, Any]] = {
    "basa2009": {**PRESETS["basa2009"], "resolution": 10, "until": 0.1},
    "best": {"resolution": 20, "until": 0.1},
    "kick drift kick": {**PRESETS["basa2009"], "integrator": "kick_drift_kick", "resolution": 10, "until": 0.1},
}


def start(which: str = "basa2009", case: str = "poiseuille", **changes: Any) -> CaseRun:
    return CaseRun(FLOWS[case], FLOWS[case].settings(**{**SETTINGS[which], **changes}))


def interrupt(run: CaseRun, path: Path, outputs: int = 3) -> CaseRun:
    """Ctrl-C at one of the outputs."""

    def progress(text: str) -> None:
        if len(run.history) == outputs:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run.run(progress, path)
    return run


@cache
def whole(which: str) -> CaseRun:
    return start(which).run()


@pytest.mark.parametrize("which", SETTINGS)
def test_an_interrupted_run_goes_on_as_if_nothing_had_happened(which: str, tmp_path: Path) -> None:
    interrupt(start(which), tmp_path / "state.npz")
    again = start(which)
    again.restore(tmp_path / "state.npz")
    assert len(again.history) == 3
    again.run()
    assert again.end == whole(which).end == "time"
    assert len(again.history) > 4
    assert again.history == whole(which).history
    for name in ("positions", "velocities", "density", "pressure"):
        np.testing.assert_array_equal(getattr(again.flow, name), getattr(whole(which).flow, name))


def test_what_is_restored_is_what_was_saved(tmp_path: Path) -> None:
    first = interrupt(start(), tmp_path / "state.npz")
    again = start()
    again.restore(tmp_path / "state.npz")
    assert (again.flow.time, again.flow.steps) == (first.flow.time, first.flow.steps)
    assert (again.history, again.seconds) == (first.history, first.seconds)
    for name, values in first.flow.state().items():
        np.testing.assert_array_equal(again.flow.state()[name], values)


def test_an_interrupted_run_can_be_interrupted_again(tmp_path: Path) -> None:
    path = tmp_path / "state.npz"
    interrupt(start(), path)
    second = start()
    second.restore(path)
    interrupt(second, path, outputs=5)
    third = start()
    third.restore(path)
    assert third.run().history == whole("basa2009").history


def test_only_the_state_is_left_in_the_folder(tmp_path: Path) -> None:
    interrupt(start(), tmp_path / "state.npz")
    assert [path.name for path in tmp_path.iterdir()] == ["state.npz"]


def test_nothing_is_kept_unless_asked(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    run = start()

    def progress(text: str) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run.run(progress)
    assert list(tmp_path.iterdir()) == []


def test_a_run_may_go_on_for_longer_than_was_planned(tmp_path: Path) -> None:
    interrupt(start(), tmp_path / "state.npz")
    longer = start(until=0.2)
    longer.restore(tmp_path / "state.npz")
    assert longer.run().history[-1]["time"] == pytest.approx(0.2, rel=0.02)


def refusal(run: CaseRun, path: Path) -> str:
    """The one sentence."""
    before = run.flow.state()
    with pytest.raises(SphearError) as raised:
        run.restore(path)
    text = str(raised.value)
    assert "\n" not in text
    for name, values in before.items():  # and nothing of the flow has changed
        np.testing.assert_array_equal(run.flow.state()[name], values)
    return text


def test_the_state_of_another_case_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "state.npz"
    interrupt(start(), path)
    assert "is of poiseuille, not of couette" in refusal(start(case="couette", reynolds=0.5), path)


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"reynolds": 1.0}, "has reynolds = 0.5, not 1.0"),
        ({"viscosity": "violeau"}, "has viscosity = morris, not violeau"),
        ({"resolution": 20}, "has resolution = 10, not 20"),
    ],
)
def test_the_state_of_other_settings_is_refused(changes: dict[str, Any], sentence: str, tmp_path: Path) -> None:
    path = tmp_path / "state.npz"
    interrupt(start(), path)
    assert sentence in refusal(start(**changes), path)


def test_a_state_that_is_not_there_is_refused(tmp_path: Path) -> None:
    assert "there is no saved run in" in refusal(start(), tmp_path / "state.npz")


def test_a_file_that_is_no_state_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "state.npz"
    path.write_text("no state")
    assert "there is no saved run in" in refusal(start(), path)


def test_arrays_without_a_run_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "state.npz"
    np.savez(path, x=np.zeros(3))
    assert "there is no saved run in" in refusal(start(), path)


def test_the_best_settings_are_ten_times_as_accurate_as_the_papers() -> None:
    """Morris' term has an error of 2 % at t* = 5 here."""
    case = FLOWS["poiseuille"]
    done = CaseRun(case, case.settings(reynolds=0.5, resolution=20, until=1.0)).run()
    assert done.end == "time"
    assert done.history[-1]["rms_error"] < 0.003


@pytest.mark.parametrize(
    ("case", "scheme", "preset"),
    [(name, scheme, preset) for name in FLOWS for scheme in FLOWS[name].defaults for preset in BY_SCHEME[scheme]],
)
def test_every_preset_fits_every_case(preset: str, case: str, scheme: str) -> None:
    chosen = FLOWS[case].preset(preset, scheme)
    settings = FLOWS[case].settings(scheme=scheme, **chosen)
    assert settings.scheme == scheme
    assert all(getattr(settings, key) == value for key, value in chosen.items())
