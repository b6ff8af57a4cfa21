"""Ctrl-C, and a sweep that is killed: what is stored stays, and no worker is left behind."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

import sphear
from sphear.sweeps import Store

from .conftest import SCRIPTED
from .sweep_functions import SLEEPS

pytestmark = pytest.mark.skipif(os.name != "posix", reason="process groups and signals are those of Unix")

Calls = Callable[[], list[int]]

SCRIPT = f"""
import sys
from sphear.sweeps import Store, plan, run_sweep
if __name__ == "__main__":
    runs = plan("poiseuille", {{"resolution": [10, 20, {SLEEPS}]}}, {{"until": 0.05}}, preset="basa2009")
    try:
        run_sweep(runs, Store(sys.argv[1]), workers=2, compute="{SCRIPTED}")
    except KeyboardInterrupt:
        print("interrupted")
"""


@pytest.fixture(autouse=True)
def interruptible() -> Iterator[None]:
    """A process whose parent ignores Ctrl-C ignores it too, as do all that a shell has put into the background."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.fixture
def underway(calls: Calls, store: Store, tmp_path: Path) -> Iterator[subprocess.Popen[str]]:
    """A sweep of three runs in a process group of its own: two are stored, and the third takes for ever."""
    (tmp_path / "script.py").write_text(SCRIPT)
    path = os.pathsep.join((str(Path(sphear.__file__).parents[1]), str(Path(__file__).parent)))
    process = subprocess.Popen(
        [sys.executable, str(tmp_path / "script.py"), str(store.folder.path)],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env={**os.environ, "PYTHONPATH": path},
        start_new_session=True,
    )  # fmt: skip
    try:
        until = time.monotonic() + 300
        while sorted(calls()) != [10, 20, SLEEPS] or len(list(store.folder.path.glob("*.json"))) < 2:
            assert process.poll() is None, process.communicate()
            assert time.monotonic() < until
            time.sleep(0.05)
        yield process
    finally:
        process.kill()
        process.communicate()


def test_ctrl_c_keeps_what_is_stored_and_the_sweep_goes_on(
    underway: subprocess.Popen[str], store: Store, sweep: Callable[..., Any], calls: Calls
) -> None:
    os.killpg(underway.pid, signal.SIGINT)  # a terminal sends it to all processes
    out, err = underway.communicate(timeout=300)  # ends when no worker holds the pipes any more
    assert (underway.returncode, out, err) == (0, "interrupted\n", "")
    assert sorted(path.suffix for path in store.folder.path.iterdir()) == [".json", ".json"]
    assert [result.end for result in sweep([10, 20, 30])] == 3 * ["time"]
    assert calls()[3:] == [30]


def test_the_workers_of_a_sweep_that_is_killed_end_too(underway: subprocess.Popen[str], store: Store) -> None:
    underway.kill()
    underway.communicate(timeout=300)
    assert sorted(path.suffix for path in store.folder.path.iterdir()) == [".json", ".json"]
