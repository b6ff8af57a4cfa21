"""Signals that wait until a compilation is over.

An exception that a signal handler raises while LLVM calls back into Python is swallowed there, or leaves the compiler
without its object code. So handlers are called after the compilation, in which nothing is lost that they could keep.
"""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

# Ctrl-C last: it raises, and the handlers before it are back in their places then
SIGNALS = [getattr(signal, name) for name in ("SIGTERM", "SIGHUP", "SIGINT") if hasattr(signal, name)]
_waiting = False


@contextmanager
def blocked_signals() -> Iterator[None]:
    """Hold back SIGTERM, SIGHUP and SIGINT for the block, also where they end the process without a handler."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, SIGNALS)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextmanager
def deferred_signals() -> Iterator[None]:
    """Keep SIGINT, SIGTERM and SIGHUP for the end of the block, where the handlers of before are called with them.

    Only signals that have a handler in Python wait, and only in the main thread, which alone runs handlers. In a block
    within such a block nothing changes: signals wait for the outer one.
    """
    global _waiting  # of the one thread that signals are handled in
    if _waiting or threading.current_thread() is not threading.main_thread():
        yield
        return
    came: dict[int, FrameType | None] = {}
    former: dict[int, Any] = {}
    try:
        _waiting = True
        for number in SIGNALS:
            handler = signal.getsignal(number)
            if callable(handler):
                former[number] = handler
                signal.signal(number, came.__setitem__)
        yield
    finally:
        _waiting = False
        for number, handler in former.items():
            signal.signal(number, handler)
        for number in [number for number in former if number in came]:
            former[number](number, came[number])
