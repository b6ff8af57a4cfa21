"""Signals: heard at once, heeded where nothing is lost, and the same as before afterwards."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from threading import Thread
from typing import Any

import pytest

from sphear.cases.flow import CaseRun
from sphear.cases.flow.history import CaseHistory
from sphear.cli.signals import Signals
from sphear.results import OutputFolder

pytestmark = pytest.mark.skipif(os.name != "posix", reason="signals are those of POSIX")
Run = Callable[..., Any]
CASE = ("run", "poiseuille", "--preset", "basa2009", "--resolution", "10", "--until", "0.1", "--out", "results")
SENT = {
    "SIGTERM": ((signal.SIGTERM,), 143),
    "SIGHUP": ((signal.SIGHUP,), 129),
    "Ctrl-C once": ((signal.SIGINT,), 130),
    "Ctrl-C twice": ((signal.SIGINT, signal.SIGINT), 130),
    "Ctrl-C thrice at once": ((signal.SIGINT,) * 3, 130),
}


@pytest.fixture(autouse=True)
def usual() -> Iterator[None]:
    """What a shell starts a command with; the test may have been started otherwise."""
    handlers: dict[int, Any] = {signal.SIGINT: signal.default_int_handler}
    handlers |= {signal.SIGTERM: signal.SIG_DFL, signal.SIGHUP: signal.SIG_DFL}
    before: list[tuple[int, Any]] = [(number, signal.signal(number, handlers[number])) for number in handlers]
    yield
    for number, handler in before:
        signal.signal(number, handler)


def send(name: str) -> None:
    for number in SENT[name][0]:
        os.kill(os.getpid(), number)


def whole(sphear: Run) -> Any:
    return sphear(*CASE[:-2], "--json").json()["metrics"]


@pytest.mark.parametrize("name", SENT)
def test_a_signal_in_a_run_keeps_the_present_state(sphear: Run, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    advance = CaseRun._advance

    def advanced(run: CaseRun, *arguments: Any) -> None:
        advance(run, *arguments)
        if run.flow.steps == 3:
            send(name)

    with monkeypatch.context() as patched:
        patched.setattr(CaseRun, "_advance", advanced)
        stopped = sphear(*CASE, "--json")
    assert (stopped.status, stopped.out) == (SENT[name][1], "")
    assert stopped.err == (
        "sphear: interrupted at t* = 0.05534; the state is in results, and the same command with --resume goes on from"
        " there\n"
    )
    assert [path.name for path in Path("results").iterdir()] == ["poiseuille-state.npz"]
    assert sphear(*CASE, "--resume", "--json").json()["metrics"] == whole(sphear)


@pytest.mark.parametrize("name", SENT)
@pytest.mark.parametrize("during", ["write_text", "write_table"])
def test_a_signal_while_results_are_written_keeps_the_state(
    sphear: Run, name: str, during: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    write = getattr(OutputFolder, during)

    def written(folder: OutputFolder, *arguments: Any) -> None:
        write(folder, *arguments)
        send(name)

    with monkeypatch.context() as patched:
        patched.setattr(OutputFolder, during, written)
        stopped = sphear(*CASE, "--json")
    assert (stopped.status, stopped.out) == (SENT[name][1], "")
    assert stopped.err == (
        "sphear: interrupted while results are written; the run has ended at t* = 0.1107 and its state is in"
        " results/poiseuille-state.npz: the same command with --resume writes the results\n"
    )
    assert sphear(*CASE, "--resume", "--json").json()["metrics"] == whole(sphear)
    assert not [path for path in Path("results").iterdir() if path.name.startswith(".")]


def test_a_signal_while_the_state_is_saved_waits(sphear: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    fsync = os.fsync

    def synced(descriptor: int) -> None:
        send("Ctrl-C twice")
        fsync(descriptor)

    with monkeypatch.context() as patched:
        patched.setattr(os, "fsync", synced)
        patched.setenv("SPHEAR_SAVE_SECONDS", "0")
        assert sphear(*CASE, "--json").status == 130
    assert sphear(*CASE, "--resume", "--json").json()["metrics"] == whole(sphear)


def test_handlers_are_those_from_before_afterwards(sphear: Run) -> None:
    sphear(*CASE[:-2], "--json")
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    assert signal.getsignal(signal.SIGTERM) == signal.SIG_DFL


def test_a_signal_that_is_ignored_stays_so() -> None:
    signal.signal(signal.SIGHUP, signal.SIG_IGN)
    with Signals() as signals:
        os.kill(os.getpid(), signal.SIGHUP)
        assert not signals.heard()


def test_another_thread_has_no_handlers() -> None:
    found: list[object] = []

    def inside() -> None:
        with Signals():
            found.append(signal.getsignal(signal.SIGTERM))

    thread = Thread(target=inside)
    thread.start()
    thread.join()
    assert found == [signal.SIG_DFL]


def test_a_third_ctrl_c_later_ends_the_process() -> None:
    code = (
        "import os, signal, sphear.cli.signals as module\n"
        "module.PATIENCE = 0.0\n"
        "with module.Signals():\n"
        "    for _ in range(2): os.kill(os.getpid(), signal.SIGINT)\n"
        "    print('still here', flush=True)\n"
        "    os.kill(os.getpid(), signal.SIGINT)\n"
        "    print('never')"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (-signal.SIGINT, "still here\n")


def test_the_status_is_that_of_ctrl_c_where_no_signal_was_heard() -> None:
    assert Signals().status == 130


def test_a_signal_without_a_folder_keeps_nothing_and_says_so(sphear: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    watch = CaseHistory.watch

    def watched(history: CaseHistory, run: CaseRun) -> None:
        watch(history, run)
        send("SIGTERM")

    monkeypatch.setattr(CaseHistory, "watch", watched)
    outcome = sphear(*CASE[:-2], "--json")
    assert (outcome.status, outcome.out) == (143, "")
    assert "nothing is kept: with --out DIR the run could be gone on with" in outcome.err
