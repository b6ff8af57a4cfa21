"""The folder of a run: its results are replaced by nobody, its state is there until they are, and it can go on."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from sphear.cases.flow import CaseRun
from sphear.cases.flow import run as module
from sphear.results import OutputFolder
from sphear.results.lock import locked
from sphear.whole import HOST
from tests.cli.interrupting import interrupted_at

Run = Callable[..., Any]
CASE = ("run", "poiseuille", "--preset", "basa2009", "--resolution", "10", "--out", "results")
FILES = {f"poiseuille{end}" for end in (".json", ".csv", "-particles.csv", ".png", ".svg", "-state.npz")}


def files() -> set[str]:
    return {path.name for path in Path("results").iterdir()}


def written() -> Any:
    return json.loads(Path("results/poiseuille.json").read_text())


@pytest.fixture
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    """No figure, which takes longest."""
    monkeypatch.setattr(OutputFolder, "write_figure", lambda self, name, figure: None)
    monkeypatch.setattr("sphear.cli.run._figure", lambda flow: None)


def test_results_of_another_run_are_not_replaced(sphear: Run, quick: None) -> None:
    assert sphear(*CASE, "--until", "0.1", "--json").status == 0
    before = written()
    refused = sphear(*CASE, "--until", "0.1", "--reynolds", "1")
    assert (refused.status, refused.out) == (2, "")
    assert refused.err == (
        "sphear: results holds the results of a run of poiseuille: --resume goes on with that, --overwrite replaces it,"
        " another --out keeps both\n"
    )
    assert written() == before
    assert sphear(*CASE, "--until", "0.1", "--reynolds", "1", "--overwrite", "--json").status == 0
    assert written()["settings"]["reynolds"] == 1.0
    assert (
        sphear(
            "run",
            "couette",
            "--preset",
            "basa2009",
            "--resolution",
            "10",
            "--until",
            "0.01",
            "--out",
            "results",
            "--json",
        ).status
        == 0
    )


def test_results_without_a_state_are_not_replaced_either(sphear: Run, quick: None) -> None:
    Path("results").mkdir()
    Path("results/poiseuille.json").write_text("{}")
    assert "holds the results of a run" in sphear(*CASE).err
    assert Path("results/poiseuille.json").read_text() == "{}"


def test_a_run_that_ended_is_extended(sphear: Run, quick: None) -> None:
    assert sphear(*CASE, "--until", "0.1", "--json").status == 0
    first = written()["history"]
    extended = sphear(*CASE, "--until", "0.2", "--resume", "--json").json()
    history = written()["history"]
    assert history[: len(first)] == first
    straight = sphear(*CASE[:-2], "--until", "0.2", "--json").json()
    assert extended["metrics"] == straight["metrics"]
    assert files() == {name for name in FILES if not name.endswith(("png", "svg"))}


def test_resume_and_overwrite_are_refused_together(sphear: Run) -> None:
    outcome = sphear(*CASE, "--resume", "--overwrite")
    assert (outcome.status, "choose one" in outcome.err) == (2, True)


def test_a_second_run_in_the_folder_is_refused(sphear: Run) -> None:
    Path("results").mkdir()
    with locked(Path("results/.poiseuille.lock"), "it"):
        outcome = sphear(*CASE, "--overwrite")
    assert (outcome.status, outcome.out) == (2, "")
    assert "poiseuille in results is being computed by process" in outcome.err
    assert files() == set()


def test_results_that_cannot_be_written_are_written_later(
    sphear: Run, monkeypatch: pytest.MonkeyPatch, quick: None
) -> None:
    def fills_up(path: Path, text: str, encoding: str) -> None:
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patched:
        patched.setattr(Path, "write_text", fills_up)
        outcome = sphear(*CASE, "--until", "0.1", "--json")
    assert (outcome.status, outcome.out) == (1, "")
    assert outcome.err == (
        "sphear: results/poiseuille.json cannot be written: No space left on device; the run has ended at t* = 0.1107"
        " and its state is in results/poiseuille-state.npz: the same command with --resume writes the results\n"
    )
    assert files() == {"poiseuille-state.npz"}
    monkeypatch.setattr(CaseRun, "_advance", None)  # nothing is computed
    resumed = sphear(*CASE, "--until", "0.1", "--resume", "--json").json()
    assert resumed == {key: value for key, value in written().items() if key != "history"}
    assert resumed["metrics"]["end"] == "time"


def test_a_state_that_cannot_be_saved_is_one_sentence(
    sphear: Run, monkeypatch: pytest.MonkeyPatch, quick: None
) -> None:
    def full(*arguments: Any) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(module, "write", full)
    outcome = sphear(*CASE, "--until", "0.1")
    assert outcome.status == 0
    assert outcome.err == (
        "sphear: the state cannot be saved in results/poiseuille-state.npz: No space left on device\n"
    )
    assert "End: time." in outcome.out


def test_a_damaged_state_is_replaced_by_the_one_before_and_that_is_said(
    sphear: Run, monkeypatch: pytest.MonkeyPatch, quick: None
) -> None:
    monkeypatch.setenv("SPHEAR_SAVE_SECONDS", "0")
    with interrupted_at(5, monkeypatch):
        assert sphear(*CASE, "--until", "0.1").status == 130
    state = Path("results/poiseuille-state.npz")
    state.write_bytes(state.read_bytes()[:-100])
    Path(f"results/.poiseuille.json.{HOST}-{2**22 + 1}.partial").touch()  # of a process that cannot be there
    resumed = sphear(*CASE, "--until", "0.1", "--resume", "--json")
    assert resumed.err == f"sphear: the state in {state} was damaged: the one before it is taken\n"
    assert json.loads(resumed.out)["metrics"] == sphear(*CASE[:-2], "--until", "0.1", "--json").json()["metrics"]
    assert files() == {name for name in FILES if not name.endswith(("png", "svg"))}
