"""`sphear sweep`: table, files, what is computed again, Ctrl-C, and one sentence for each mistake."""

from __future__ import annotations

import csv
import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import sphear
import sphear.sweeps
from sphear.sweeps import SweepResult

Run = Callable[..., Any]

SMALL = ("sweep", "poiseuille", "--preset", "basa2009", "--set", "until=0.05", "--out", "results")
OVER = ("--over", "viscosity=morris,E", "--over", "resolution=8, 10")


def test_the_table_has_what_changes_and_how_each_run_ended(sphear: Run) -> None:
    outcome = sphear(*SMALL, *OVER)
    assert (outcome.status, outcome.err) == (0, "")
    for text in ("Sweep of poiseuille, 2 runs", "viscosity", "resolution", "t*", "rms error", "sweep.csv"):
        assert text in outcome.out


def test_json_is_one_document_and_the_file_is_the_same(sphear: Run) -> None:
    found = sphear(*SMALL, *OVER, "--json").json()
    assert found == json.loads(Path("results/sweep.json").read_text())
    assert (found["case"], found["fixed"]) == ("poiseuille", ["until"])
    assert found["over"] == {"viscosity": ["morris"], "resolution": [8, 10]}
    assert [row["settings"]["resolution"] for row in found["runs"]] == [8, 10]
    assert list(found["runs"][0]) == ["end", "settings", "metrics", "performance", "file"]
    stored = [json.loads((Path("results") / row["file"]).read_text()) for row in found["runs"]]
    assert [run["metrics"] for run in stored] == [row["metrics"] for row in found["runs"]]
    assert len(stored[0]["history"]) > 1


def test_the_csv_file_has_the_rows(sphear: Run) -> None:
    found = sphear(*SMALL, *OVER, "--json").json()
    with Path("results/sweep.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    more = ["failure_time", "seconds", "file"]
    assert list(rows[0]) == ["viscosity", "resolution", "end", "time", "rms_error", *more]
    assert [row["file"] for row in rows] == [row["file"] for row in found["runs"]]
    assert [float(row["seconds"]) for row in rows] == [row["performance"]["seconds"] for row in found["runs"]]
    assert [float(row["rms_error"]) for row in rows] == [row["metrics"]["rms_error"] for row in found["runs"]]


def test_what_is_stored_is_not_computed_again(sphear: Run) -> None:
    sphear(*SMALL, "--over", "resolution=8,10")
    before = {path: path.stat().st_mtime_ns for path in Path("results/runs").iterdir()}
    sphear(*SMALL, "--over", "resolution=10,9,8", "--workers", "2")
    after = {path: path.stat().st_mtime_ns for path in Path("results/runs").iterdir()}
    assert (len(before), len(after)) == (2, 3)
    assert before.items() <= after.items()


def test_a_flow_that_failed_is_a_result(sphear: Run) -> None:
    command = (
        "sweep",
        "poiseuille",
        "--preset",
        "basa2009",
        "--set",
        "until=5",
        "--over",
        "sound_speed=0.2",
        "--json",
        "--out",
        "results",
    )
    (row,) = sphear(*command).json()["runs"]
    assert row["end"].startswith("failed: ")
    assert row["metrics"]["failure_time"] > 0


@pytest.mark.parametrize("as_json", [False, True])
def test_runs_that_were_lost_are_said(as_json: bool, sphear: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    def all_lost(runs: list[Any], *_: object, **__: object) -> list[SweepResult]:
        return [SweepResult(run.case, run.given, {}, "lost: its worker was killed by SIGKILL") for run in runs]

    monkeypatch.setattr("sphear.sweeps.run_sweep", all_lost)
    outcome = sphear(*SMALL, *OVER, *(["--json"] if as_json else []))
    sentence = "2 runs were lost (its worker was killed by SIGKILL): the same command runs what is missing again"
    assert (outcome.status, outcome.err) == (1, f"sphear: {sentence}\n")
    assert "lost: its worker was killed" in outcome.out
    assert json.loads(Path("results/sweep.json").read_text())["runs"][0]["file"] is None


@pytest.mark.skipif(os.name != "posix", reason="process groups and signals are those of Unix")
def test_ctrl_c_says_how_to_go_on(tmp_path: Path) -> None:
    before = signal.signal(signal.SIGINT, signal.default_int_handler)  # a child ignores what its parent does
    stored = tmp_path / "results" / "runs"
    command = (
        "sweep",
        "poiseuille",
        "--preset",
        "basa2009",
        "--set",
        "until=1e9",
        "--over",
        "max_steps=2,3,100000000",
        "--workers",
        "2",
    )
    process = subprocess.Popen(
        [sys.executable, "-m", "sphear", *command, "--out", "results"],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=tmp_path, start_new_session=True,
        env={**os.environ, "PYTHONPATH": str(Path(sphear.__file__).parents[1])},
    )  # fmt: skip
    try:
        until = time.monotonic() + 300
        while len(list(stored.glob("*.json"))) < 2:
            assert process.poll() is None, process.communicate()
            assert time.monotonic() < until
            time.sleep(0.05)
        os.killpg(process.pid, signal.SIGINT)
        out, err = process.communicate(timeout=300)  # ends when no worker holds the pipes any more
    finally:
        process.kill()
        signal.signal(signal.SIGINT, before)
    sentence = "interrupted; 2 of 3 runs are stored in results/runs, and the same command goes on from there"
    assert (process.returncode, out, err) == (130, "", f"sphear: {sentence}\n")
    assert {path.suffix for path in stored.iterdir()} == {".json"}
    assert not (tmp_path / "results" / "sweep.json").exists()


CASE = ["poiseuille", "--out", "results"]
THOUSAND = "reynolds=" + ",".join(str(number) for number in range(1, 1001))
WRONG: dict[str, tuple[list[str], str]] = {
    "no case": (["--out", "results"], "missing argument 'CASE'"),
    "unknown case": (["poisseuille", "--over", "resolution=10", "--out", "r"], "did you mean poiseuille"),
    "no folder": (["poiseuille", "--over", "resolution=10"], "missing option '--out'"),
    "empty folder": (["poiseuille", "--over", "resolution=10", "--out", " "], "the output folder needs a name"),
    "nothing": (CASE, "sweep needs something to sweep over, such as --over resolution=10,20,40"),
    "no equals": ([*CASE, "--over", "resolution"], "--over takes KEY=V1,V2,..., such as --over resolution=10,20,40"),
    "no values": ([*CASE, "--over", "resolution="], "--over resolution needs values separated by commas"),
    "a gap": ([*CASE, "--over", "resolution=10,,20"], "--over resolution needs values separated by commas"),
    "twice": ([*CASE, "--over", "reynolds=1", "--over", "reynolds=2"], "--over reynolds is given twice"),
    "unknown key": ([*CASE, "--over", "resolutoin=10"], "no setting named 'resolutoin': did you mean resolution"),
    "unknown --set": ([*CASE, "--over", "reynolds=1", "--set", "kernl=a"], "no setting named 'kernl'"),
    "--set alone": ([*CASE, "--over", "reynolds=1", "--set", "kernel"], "--set takes KEY=VALUE, such as --set kernel="),
    "both": ([*CASE, "--over", "reynolds=1", "--set", "reynolds=2"], "reynolds is given by --over and by --set"),
    "value": ([*CASE, "--over", "reynolds=1,some"], "the setting reynolds should be a valid number"),
    "name": ([*CASE, "--over", "viscosity=morris,moris"], "no viscosity named 'moris': did you mean morris"),
    "together": ([*CASE, "--over", "resolution=20,3"], "the resolution of 3 is too coarse"),
    "no workers": ([*CASE, "--over", "reynolds=1", "--workers", "0"], "workers must be at least 1, not 0"),
    "half a worker": ([*CASE, "--over", "reynolds=1", "--workers", "0.5"], "invalid value for '--workers'"),
    "two ways": ([*CASE, "--over", "reynolds=1", "--workers", "2", "--scheduler", "tcp://a:1"], "choose one"),
    "no address": ([*CASE, "--over", "reynolds=1", "--scheduler", ""], "--scheduler needs an address"),
    "too many": ([*CASE, "--over", THOUSAND, "--over", "seed=" + ",".join(map(str, range(101)))], "1000 x 101 values"),
    "no scheduler": ([*CASE, "--over", "reynolds=1", "--scheduler", "nonsense://a"], "nonsense://a"),
}


@pytest.mark.parametrize("what", WRONG)
@pytest.mark.parametrize("as_json", [False, True])
def test_a_mistake_is_one_sentence(what: str, as_json: bool, sphear: Run) -> None:
    arguments, sentence = WRONG[what]
    outcome = sphear("sweep", *arguments, *(["--json"] if as_json else []))
    assert (outcome.status, outcome.out) == (2, "")
    assert sentence in outcome.err
    assert len(outcome.err.strip().splitlines()) == 1
    assert not list(Path.cwd().iterdir())
