"""One run in a folder at a time."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from platform import node
from typing import Any

import pytest

import sphear.results.lock as module
from sphear.errors import SphearError
from sphear.results.lock import locked

HOLDS = """
import os, sys, time
from pathlib import Path
from sphear.results.lock import locked
with locked(Path(sys.argv[1]), "a run"):
    print("held", flush=True)
    sys.stdin.read()
"""


@pytest.fixture(params=["flock", "no flock"])
def path(request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    if request.param == "no flock":
        monkeypatch.setattr(module, "fcntl", None)
    return tmp_path / ".case.lock"


def holder(path: Path) -> Any:
    process = subprocess.Popen(
        [sys.executable, "-c", HOLDS, str(path)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )
    assert process.stdout is not None
    assert process.stdout.readline() == "held\n"
    return process


def test_a_lock_is_gone_when_it_is_released(path: Path) -> None:
    for _ in range(2):
        with locked(path, "a run"):
            assert path.read_text() == f"{os.getpid()} {node()}\n"
        assert not path.exists()


def test_a_second_process_is_refused_in_one_sentence(path: Path) -> None:
    with holder(path) as other:
        said = f"^a run is being computed by process {other.pid} on {node()}: wait for its end or take another --out$"
        with pytest.raises(SphearError, match=said), locked(path, "a run"):
            pass
        assert other.poll() is None
        other.stdin.close()
        other.wait()
    with locked(path, "a run"):
        pass


def test_a_lock_of_a_process_that_was_killed_is_taken_over(path: Path) -> None:
    with holder(path) as other:
        other.kill()
        other.wait()
    assert path.exists()
    with locked(path, "a run"):
        assert path.read_text().split()[0] == str(os.getpid())


def test_a_lock_of_another_machine_names_the_file(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "fcntl", None)
    path.write_text("1 elsewhere\n")
    said = r"process 1 on elsewhere: .* if that process is gone, delete .*case\.lock$"
    with pytest.raises(SphearError, match=said), locked(path, "a run"):
        pass
