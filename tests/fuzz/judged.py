"""Malformed input answered and judged: one sentence, in time, in memory, and nothing left behind."""

from __future__ import annotations

import io
import os
import resource
import signal
import sys
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from unittest import mock

from sphear.cli import main
from sphear.errors import SphearError

from .calls import Call
from .commands import Command

LONGEST = 700  # letters of a sentence; the names of all settings are 400
NOTICE = "compiling (once; kept in "
SECONDS, BYTES = 20, 2 << 30  # of processor time
WAITED = 180  # seconds on the clock: others may be using the machine


class TooLong(BaseException):
    """The time is over; no handler of errors takes it for one."""


@contextmanager
def timed() -> Iterator[None]:
    """Limits of time and of all memory that the process has ever had."""

    def ring(*_: object) -> None:
        raise TooLong

    before = {number: signal.signal(number, ring) for number in (signal.SIGPROF, signal.SIGALRM)}
    signal.setitimer(signal.ITIMER_PROF, SECONDS)
    signal.alarm(WAITED)
    try:
        yield
    finally:
        signal.alarm(0)
        signal.setitimer(signal.ITIMER_PROF, 0)
        for number, handler in before.items():
            signal.signal(number, handler)


def fault_of_command(command: Command) -> str | None:
    """The fault of a command line's answer, in a few words; None where it is one sentence and status 2."""
    before = set(Path().iterdir())
    out, err = io.TextIOWrapper(io.BytesIO(), "utf-8"), io.TextIOWrapper(io.BytesIO(), "utf-8")
    status: object = "no exit"
    with mock.patch.multiple(sys, argv=["sphear", *command.arguments], stdout=out, stderr=err):
        try:
            with timed(), warnings.catch_warnings(record=True) as warned:
                warnings.simplefilter("always")
                main()
        except SystemExit as left:
            status = left.code
        except TooLong:
            return f"more than {SECONDS} s"
        except BaseException as error:  # noqa: BLE001 -- whatever comes is the finding
            return f"{type(error).__name__}: {str(error)[:200]}"
        out.flush()
        err.flush()
    said, printed = _text(err), _text(out)
    if warned:
        return f"a warning: {str(warned[0].message)[:200]}"
    if status != 2:
        return f"status {status}: {said[:200]}"
    if printed or set(Path().iterdir()) != before:
        return "output beside the sentence"
    if not (said.startswith("sphear: ") and said.endswith("\n")):
        return f"no sentence: {said[:200]!r}"
    return _fault_of_sentence(said.removeprefix("sphear: ")[:-1])


def fault_of_call(call: Call) -> str | None:
    """The fault of a call's answer, in a few words; None where it is an error of sphear with one sentence."""
    try:
        with timed(), warnings.catch_warnings(record=True) as warned:
            warnings.simplefilter("always")
            call.make()
    except SphearError as error:
        if warned:
            return f"a warning: {str(warned[0].message)[:200]}"
        return _fault_of_sentence(str(error))
    except TooLong:
        return f"more than {SECONDS} s"
    except BaseException as error:  # noqa: BLE001 -- whatever comes is the finding
        return f"{type(error).__name__}: {str(error)[:200]}"
    return "no error"


def _fault_of_sentence(sentence: str) -> str | None:
    if sentence.startswith(NOTICE):  # said before the answer, where something was not compiled yet
        sentence = sentence.partition("\n")[2]
    if len(sentence) > LONGEST:
        return f"{len(sentence)} letters: {sentence[:100]}"
    if not sentence.strip() or "\n" in sentence or "Traceback" in sentence:
        return f"not one line: {sentence[:100]!r}"
    if (most := resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024) > BYTES:
        return f"{most >> 20} MB"
    return None


def _text(stream: io.TextIOWrapper) -> str:
    buffer = stream.buffer
    assert isinstance(buffer, io.BytesIO)
    return buffer.getvalue().decode("utf-8", "surrogateescape")


@contextmanager
def in_folder(folder: Path) -> Iterator[None]:
    """Work in a folder that holds nothing but the file `taken`."""
    (folder / "taken").write_text("mine")
    before = Path.cwd()
    os.chdir(folder)
    try:
        yield
    finally:
        os.chdir(before)
