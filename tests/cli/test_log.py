"""What a log file and a pipe get: lines now and then, and tables as wide as they are asked to be."""

from __future__ import annotations

import io
import time
from collections.abc import Callable
from typing import Any

import pytest

from sphear.cli import output
from sphear.errors import SphearError
from sphear.results import Column, Table

TABLE = Table(
    "t", tuple(Column(str(k), f"column {k}", ".6g") for k in range(20)), [{str(k): 123456 for k in range(20)}]
)


class Clock:
    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.now = 0.0
        monkeypatch.setattr(time, "monotonic", lambda: self.now)


@pytest.fixture
def lines(monkeypatch: pytest.MonkeyPatch) -> Callable[[float, str], list[str]]:
    """The moments, in whole seconds, at which a run that tells twice a second gets a line."""

    def told(until: float, first: str) -> list[str]:
        clock, stream = Clock(monkeypatch), io.StringIO()
        monkeypatch.setenv("SPHEAR_PROGRESS_SECONDS", first)
        tell = output.now_and_then("cavity", stream)
        while clock.now < until:
            clock.now += 0.5
            tell(f"{clock.now:g}")
        return stream.getvalue().splitlines()

    return told


def test_a_log_file_gets_a_line_when_twice_the_time_has_passed(lines: Any) -> None:
    assert lines(200, "10") == [f"cavity: {second}" for second in (10, 20, 40, 80, 160)]
    assert lines(200, "") == lines(200, "10")


def test_a_log_file_gets_a_line_every_ten_minutes_at_least(lines: Any) -> None:
    last = [int(line.split()[1]) for line in lines(4000, "10")][-3:]
    assert [second - last[0] for second in last] == [0, 600, 1200]


def test_no_lines_are_wanted(lines: Any) -> None:
    assert lines(200, "0") == []


def test_no_stream_is_no_error() -> None:
    output.now_and_then("cavity", None)("text")


def test_seconds_that_are_none_are_one_sentence(sphear: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SPHEAR_PROGRESS_SECONDS", "often")
    with pytest.raises(SphearError, match="SPHEAR_PROGRESS_SECONDS must be a number of seconds, not 'often'"):
        output.now_and_then("cavity", None)


@pytest.mark.parametrize(("columns", "width"), [("60", 60), ("100", 100), (None, 200), ("wide", 200)])
def test_a_file_gets_tables_as_wide_as_columns_says(
    columns: str | None, width: int, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.delenv("COLUMNS", raising=False)
    if columns is not None:
        monkeypatch.setenv("COLUMNS", columns)
    output.print_tables([TABLE])
    longest = max(len(line.rstrip()) for line in capsys.readouterr().out.splitlines())
    assert width - 12 < longest <= width
