"""Files that are whole or not there."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from sphear.whole import HOST, is_running, remove_partial, whole


def test_a_file_that_is_not_finished_leaves_the_one_before(tmp_path: Path) -> None:
    path = tmp_path / "a"
    path.write_text("first")

    def interrupted() -> None:
        with whole(path) as partial:
            partial.write_text("half")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        interrupted()
    assert [each.read_text() for each in tmp_path.iterdir()] == ["first"]


def test_the_file_before_may_be_kept(tmp_path: Path) -> None:
    path, before = tmp_path / "a", tmp_path / "b"
    for text in ("first", "second", "third"):
        with whole(path, before=before) as partial:
            partial.write_text(text)
    assert (before.read_text(), path.read_text()) == ("second", "third")


def ended_process() -> int:
    process = subprocess.Popen([sys.executable, "-c", ""])
    process.wait()
    return process.pid


@pytest.mark.skipif(os.name != "posix", reason="whether a process is there cannot be asked")
def test_what_killed_processes_left_is_removed_and_nothing_else(tmp_path: Path) -> None:
    gone = ended_process()
    litter = tmp_path / f".a.json.{HOST}-{gone}.partial"
    others = [
        tmp_path / f".b.json.{HOST}-{os.getpid()}.partial",
        tmp_path / f".c.json.{'0' * 8}-{gone}.partial",
        tmp_path / ".d.partial",
        tmp_path / "e.json",
    ]
    for path in (litter, *others):
        path.touch()
    remove_partial(tmp_path)
    assert sorted(tmp_path.iterdir()) == sorted(others)
    remove_partial(tmp_path / "not-there")


def test_a_process_that_runs_is_known() -> None:
    assert is_running(os.getpid())
    assert os.name != "posix" or not is_running(ended_process())
