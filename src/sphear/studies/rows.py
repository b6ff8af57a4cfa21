"""Rows of numbers as they are kept and shown: chosen by their values, to some digits, in words."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, overload

Row = dict[str, Any]


@overload
def significant(value: float, digits: int = 5) -> float: ...
@overload
def significant(value: float | None, digits: int = 5) -> float | None: ...
def significant(value: float | None, digits: int = 5) -> float | None:
    """A number to so many significant digits, as it is kept; None of none."""
    return None if value is None else float(f"{value:.{digits}g}")


def select(rows: Sequence[Row], **wanted: Any) -> list[Row]:
    """The rows with these values."""
    return [row for row in rows if all(row[key] == value for key, value in wanted.items())]


def failed(row: Row) -> bool:
    """True if the run of a row broke down."""
    return str(row["end"]).startswith("failed")


def outcome(row: Row) -> str:
    """Say in a few words where the run of a row ended."""
    return f"failed at t = {row['time']:.3g}" if failed(row) else f"t = {row['time']:.3g}"
