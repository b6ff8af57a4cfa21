"""Signals that come while code is compiled: heard, and heard afterwards."""

from __future__ import annotations

import os
import signal
import threading
from collections.abc import Iterator
from typing import Any

import pytest

from sphear.engine.cache.machine_code import MachineCode
from sphear.engine.interrupts import blocked_signals, deferred_signals
from tests.engine.cached import Cache, cache

__all__ = ["cache"]

pytestmark = pytest.mark.skipif(os.name != "posix", reason="signals are those of Unix")


class Stopped(BaseException):
    """What a handler raises."""


def stop(number: int, frame: object) -> None:
    raise Stopped(number)


def hit_while_deferred(number: signal.Signals, reached: list[int]) -> None:
    """A signal in the midst of an inner and an outer block, both of which go on to their end."""
    with deferred_signals():
        with deferred_signals():
            os.kill(os.getpid(), number)
            reached.append(1)
        os.kill(os.getpid(), number)
        reached.append(2)


@pytest.fixture(autouse=True)
def handlers() -> Iterator[None]:
    before = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)}
    signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    for number, handler in before.items():
        signal.signal(number, handler)


def test_ctrl_c_waits_for_the_end_of_the_block() -> None:
    reached: list[int] = []
    with pytest.raises(KeyboardInterrupt):
        hit_while_deferred(signal.SIGINT, reached)
    assert reached == [1, 2]
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def hit_while_blocked(reached: list[int]) -> None:
    with blocked_signals():
        signal.raise_signal(signal.SIGINT)  # of this thread: the test's process has others
        reached.append(1)


def test_files_are_written_to_their_end() -> None:
    reached: list[int] = []
    with pytest.raises(KeyboardInterrupt):
        hit_while_blocked(reached)
    assert reached == [1]
    assert not signal.pthread_sigmask(signal.SIG_BLOCK, [])


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP])
def test_other_signals_wait_where_they_have_a_handler(number: signal.Signals) -> None:
    signal.signal(number, stop)
    reached: list[int] = []
    with pytest.raises(Stopped, match=str(int(number))):
        hit_while_deferred(number, reached)
    assert reached == [1, 2]
    assert signal.getsignal(number) is stop


def test_a_signal_that_is_ignored_stays_ignored() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    with deferred_signals():
        os.kill(os.getpid(), signal.SIGINT)
    assert signal.getsignal(signal.SIGINT) is signal.SIG_IGN


def test_another_thread_leaves_handlers_alone() -> None:
    seen = []

    def other() -> None:
        with deferred_signals():
            seen.append(signal.getsignal(signal.SIGINT))

    thread = threading.Thread(target=other)
    thread.start()
    thread.join()
    assert seen == [signal.default_int_handler]


@pytest.mark.parametrize("moment", ["load_overload", "save_overload"])
def test_ctrl_c_while_compiling_is_heard_when_the_code_is_there(
    moment: str, cache: Cache, monkeypatch: pytest.MonkeyPatch
) -> None:
    usual = getattr(MachineCode, moment)

    def interrupted(*arguments: Any) -> Any:
        os.kill(os.getpid(), signal.SIGINT)
        return usual(*arguments)

    monkeypatch.setattr(MachineCode, moment, interrupted)
    with pytest.raises(KeyboardInterrupt):
        cache.found()
    monkeypatch.setattr(MachineCode, moment, usual)
    assert cache.found()
