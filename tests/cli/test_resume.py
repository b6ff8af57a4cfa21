"""`sphear run --preset` and `--resume`."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from sphear.schemes.presets import PRESETS
from tests.cli.interrupting import interrupted_at

Run = Callable[..., Any]
SHORT = ("run", "poiseuille", "--preset", "basa2009", "--resolution", "10", "--until", "0.1")


def test_the_settings_of_a_preset_are_in_the_json(sphear: Run) -> None:
    settings = sphear("run", "poiseuille", "--preset", "basa2009", "--set", "max_steps=1", "--json").json()["settings"]
    resolved = {key: value for key, value in PRESETS["basa2009"].items() if value is not None}
    assert {key: settings[key] for key in resolved} == resolved


def test_other_options_go_before_those_of_a_preset(sphear: Run) -> None:
    command = ("run", "poiseuille", "--preset", "basa2009", "-v", "violeau", "--set", "continuation=mirror")
    settings = sphear(*command, "--set", "max_steps=1", "--json").json()["settings"]
    assert (settings["viscosity"], settings["continuation"]) == ("violeau", "mirror")
    assert settings["correction"] == PRESETS["basa2009"]["correction"]


WRONG = {
    "unknown preset": (["--preset", "base2009"], "no preset named 'base2009': did you mean basa2009"),
    "no folder": (["--resume"], "--resume goes on with the run of a folder: name it by --out DIR"),
    "no state": (["--resume", "--out", "results"], "there is no saved run in"),
}


@pytest.mark.parametrize("mistake", WRONG)
@pytest.mark.parametrize("json_too", [False, True])
def test_a_mistake_is_one_sentence(sphear: Run, mistake: str, json_too: bool) -> None:
    arguments, message = WRONG[mistake]
    outcome = sphear(*SHORT, *arguments, *(["--json"] if json_too else []))
    assert (outcome.status, outcome.out) == (2, "")
    assert message in outcome.err
    assert len(outcome.err.strip().splitlines()) == 1
    assert not list(Path.cwd().iterdir())


@pytest.fixture
def interrupted(sphear: Run, monkeypatch: pytest.MonkeyPatch) -> Any:
    """What a run leaves behind that Ctrl-C ends at its third output, with --out results."""
    with interrupted_at(3, monkeypatch):
        return sphear(*SHORT, "--out", "results", "--json")


def test_an_interrupted_run_says_how_to_go_on(interrupted: Any) -> None:
    assert (interrupted.status, interrupted.out) == (130, "")
    assert "--resume goes on from there" in interrupted.err
    assert len(interrupted.err.strip().splitlines()) == 1
    assert [path.name for path in Path("results").iterdir()] == ["poiseuille-state.npz"]


def test_resume_gives_what_an_uninterrupted_run_gives(sphear: Run, interrupted: Any) -> None:
    assert interrupted.status == 130
    resumed = sphear(*SHORT, "--out", "results", "--resume", "--json").json()
    assert resumed["metrics"] == sphear(*SHORT, "--json").json()["metrics"]
    assert not Path("results/poiseuille-state-before.npz").exists()


def test_another_start_into_the_folder_of_an_interrupted_run_is_refused(sphear: Run, interrupted: Any) -> None:
    state = Path("results/poiseuille-state.npz")
    kept = state.read_bytes()
    again = sphear(*SHORT, "--out", "results")
    assert (again.status, again.out) == (2, "")
    assert "holds a run that was interrupted: --resume goes on with it" in again.err
    assert state.read_bytes() == kept


@pytest.mark.parametrize(("earlier", "name"), [(("--until", "0.01"), "until"), (("--set", "max_steps=1"), "max_steps")])
def test_resume_to_an_earlier_end_is_refused(
    sphear: Run, interrupted: Any, earlier: tuple[str, ...], name: str
) -> None:
    command = ("run", "poiseuille", "--preset", "basa2009", "--resolution", "10", "--out", "results", "--resume")
    refused = sphear(*command, *(("--until", "0.1") if name == "max_steps" else ()), *earlier)
    assert (refused.status, refused.out) == (2, "")
    assert f"beyond {name} = " in refused.err
    assert Path("results/poiseuille-state.npz").exists()


@pytest.mark.parametrize(
    "about", ["{}", "[1]", '{"case": "poiseuille", "settings": {}, "history": [{}], "seconds": 1}']
)
def test_a_damaged_state_is_one_sentence(sphear: Run, about: str) -> None:
    Path("results").mkdir()
    np.savez("results/poiseuille-state.npz", about=np.array(about))
    outcome = sphear(*SHORT, "--out", "results", "--resume")
    assert (outcome.status, outcome.out) == (2, "")
    assert "there is no saved run in" in outcome.err


def test_resume_with_other_settings_is_refused(sphear: Run, interrupted: Any) -> None:
    assert interrupted.status == 130
    state = Path("results/poiseuille-state.npz")
    before = state.read_bytes()
    outcome = sphear(*SHORT, "--out", "results", "--resume", "--reynolds", "1")
    assert (outcome.status, outcome.out) == (2, "")
    assert "has reynolds = 0.5, not 1.0" in outcome.err
    assert state.read_bytes() == before


def test_particles_at_the_end_are_written(sphear: Run) -> None:
    assert sphear(*SHORT, "--out", "results", "--json").status == 0
    files = [path for path in Path("results").glob("*.csv") if "x0" in path.read_text().partition("\n")[0]]
    assert len(files) == 1
    table = np.genfromtxt(files[0], delimiter=",", names=True)
    assert len(table) == 100
    assert ((table["x1"] > -0.5) & (table["x1"] < 0.5)).all()
