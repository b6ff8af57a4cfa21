"""`sphear run`: its JSON, its files, and what it refuses."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Run = Callable[..., Any]

SHORT = ("run", "poiseuille", "--until", "0.02")


def test_json_is_one_document(sphear: Run) -> None:
    found = sphear(*SHORT, "--json").json()
    assert list(found) == ["case", "settings", "metrics", "performance"]
    assert found["settings"]["until"] == 0.02
    assert found["metrics"]["time"] == pytest.approx(0.02, rel=0.5)


def test_set_changes_any_setting(sphear: Run) -> None:
    found = sphear(*SHORT, "--set", "wall-velocity=mirror", "--set", "h_over_dx=1.3", "--json").json()
    assert (found["settings"]["wall_velocity"], found["settings"]["h_over_dx"]) == ("mirror", pytest.approx(1.3))


def test_files_are_written(sphear: Run, tmp_path: Path) -> None:
    assert sphear(*SHORT, "--out", tmp_path / "results").status == 0
    written = {path.name for path in (tmp_path / "results").iterdir()}
    assert written == {"poiseuille.json", "poiseuille.csv", "poiseuille.png", "poiseuille.svg"}


def test_the_start_names_what_was_chosen(sphear: Run) -> None:
    out = sphear(*SHORT).out
    for part in ("400 particles", "Re = 0.5", "nu = 1", "sound speed 20", "neighbours", "viscous limit"):
        assert part in out


@pytest.mark.parametrize(
    ("arguments", "part"),
    [
        (["poiseuile"], "did you mean poiseuille"),
        (["poiseuille", "--set", "kernal=gaussian"], "did you mean kernel"),
        (["poiseuille", "--set", "kernel"], "KEY=VALUE"),
        (["poiseuille", "--set", "kernel=gausian"], "gaussian"),
        (["poiseuille", "--viscosity", "moris"], "did you mean morris"),
        (["poiseuille", "--reynolds", "0"], "reynolds"),
        (["poiseuille", "--reynolds", "nan"], "reynolds"),
        (["poiseuille", "--until", "-1"], "until"),
        (["poiseuille", "--set", "time_step=1"], "beyond the viscous limit"),
        (["poiseuille", "--resolution", "2"], "too coarse"),
        (["poiseuille", "--set", "wall_velocity=cubic"], "wall velocity"),
        (["poiseuille", "--viscosity", "oger", "--correction", "shepard"], "its own correction"),
    ],
)
def test_mistakes_are_one_sentence(sphear: Run, arguments: list[str], part: str) -> None:
    outcome = sphear("run", *arguments)
    assert (outcome.status, outcome.out) == (2, "")
    assert part in outcome.err
    assert outcome.err.startswith("sphear: ")
    assert outcome.err.count("\n") == 1


def test_a_time_step_beyond_its_limit_is_taken_when_forced(sphear: Run) -> None:
    outcome = sphear("run", "poiseuille", "--set", "time_step=0.0009", "--set", "max_steps=3", "--force")
    assert outcome.status == 0
    assert "warning: the time step is beyond its limit" in outcome.out
