"""`sphear run` as a process that Ctrl-C ends, and that goes on."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

import sphear

ENVIRONMENT = {**os.environ, "PYTHONPATH": str(Path(sphear.__file__).parents[1])}
SHORT = ("run", "poiseuille", "--preset", "basa2009", "--resolution", "10", "--until", "0.1")
# Ctrl-C in the fourth call of the compiled loop, the first of which makes no step
CTRL_C = """
import os, signal
from sphear.engine.backends.cpu import Program
run, calls = Program.run, []
def interrupted(*arguments):
    calls.append(1)
    result = run(*arguments)
    if len(calls) == 4:
        os.kill(os.getpid(), signal.SIGINT)
    return result
Program.run = interrupted
from sphear.cli import main
main()
"""


@pytest.fixture(autouse=True)
def interruptible() -> Iterator[None]:
    """A process whose parent ignores Ctrl-C ignores it too, as do all that a shell has put into the background."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def sphear_run(folder: Path, *arguments: str, code: str = "") -> tuple[int, str, str]:
    command = [sys.executable, *(("-c", code) if code else ("-m", "sphear")), *SHORT, *arguments]
    done = subprocess.run(
        command, cwd=folder, env=ENVIRONMENT, capture_output=True, text=True, timeout=300, check=False
    )
    return done.returncode, done.stdout, done.stderr


def test_a_run_that_ctrl_c_ends_says_how_to_go_on_and_does(tmp_path: Path) -> None:
    status, out, err = sphear_run(tmp_path, "--json", "--out", "results", code=CTRL_C)
    assert (status, out) == (130, "")
    assert err.startswith("sphear: interrupted at t* = 0.0")
    assert err.endswith("; the state is in results, and the same command with --resume goes on from there\n")
    assert [path.name for path in (tmp_path / "results").iterdir()] == ["poiseuille-state.npz"]
    status, out, err = sphear_run(tmp_path, "--json", "--out", "results", "--resume")
    assert (status, err) == (0, "")
    whole = json.loads(sphear_run(tmp_path, "--json")[1])
    # code just compiled and code from the cache may round differently
    assert json.loads(out)["metrics"] == pytest.approx(whole["metrics"])


def test_a_run_without_a_folder_says_that_nothing_is_kept(tmp_path: Path) -> None:
    status, out, err = sphear_run(tmp_path, "--json", code=CTRL_C)
    assert (status, out) == (130, "")
    assert err.startswith("sphear: interrupted at t* = 0.0")
    assert err.endswith("; nothing is kept: with --out DIR the run could be gone on with\n")
    assert list(tmp_path.iterdir()) == []
