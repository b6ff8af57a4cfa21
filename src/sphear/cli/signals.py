"""Signals that ask a command to stop: heard at once, heeded where nothing is lost."""

from __future__ import annotations

import os
import signal
import threading
import time
from types import FrameType, TracebackType
from typing import Any

HEARD = ("SIGINT", "SIGTERM", "SIGHUP")
PATIENCE = 1.0  # seconds after which the third Ctrl-C ends the process; keys that bounce are faster


class Signals:
    """Ctrl-C, SIGTERM and SIGHUP as a question that the command asks when it likes, instead of an end.

    What was done with them before is done again afterwards, and a signal that is ignored (`nohup`, a shell's
    background) stays so. The third Ctrl-C, if it comes later than a second after the first, ends the process.

    Attributes:
        number: of the first signal that came; None before.
    """

    def __init__(self) -> None:
        self.number: int | None = None
        self._times: list[float] = []
        self._before: dict[int, Any] = {}

    def __enter__(self) -> Signals:
        if threading.current_thread() is threading.main_thread():
            for name in HEARD:
                number = getattr(signal, name, None)  # not every system has all
                if number is not None and signal.getsignal(number) not in (signal.SIG_IGN, None):
                    self._before[number] = signal.signal(number, self._hear)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        for number, before in self._before.items():
            signal.signal(number, before)

    def heard(self) -> bool:
        """True if a signal has come."""
        return self.number is not None

    @property
    def status(self) -> int:
        """The exit status: 128 and the number of the signal, which is Ctrl-C's if none was heard."""
        return 128 + (signal.SIGINT if self.number is None else self.number)

    def _hear(self, number: int, frame: FrameType | None) -> None:
        self.number = self.number or number
        if number == signal.SIGINT:
            self._times.append(time.monotonic())
            if len(self._times) > 2 and self._times[-1] - self._times[0] > PATIENCE:
                signal.signal(number, signal.SIG_DFL)
                os.kill(os.getpid(), number)
