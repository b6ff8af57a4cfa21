"""Rows of kept numbers: chosen, shortened, and told."""

from __future__ import annotations

import pytest

from sphear.studies.rows import failed, outcome, select, significant

ROWS = [
    {"term": "a", "size": 1, "end": "time", "time": 40.0},
    {"term": "b", "size": 1, "end": "failed: so", "time": 3.14159},
]


@pytest.mark.parametrize(
    ("value", "digits", "kept"),
    [(3.14159265, 5, 3.1416), (123456.0, 3, 123000.0), (-1.26e-9, 2, -1.3e-9), (None, 5, None)],
)
def test_numbers_are_kept_to_some_digits(value: float | None, digits: int, kept: float | None) -> None:
    assert significant(value, digits) == kept


def test_rows_are_chosen_by_all_values() -> None:
    assert select(ROWS, size=1) == ROWS
    assert select(ROWS, size=1, term="b") == ROWS[1:]
    assert select(ROWS, term="c") == []


def test_how_a_run_ended_is_told_with_its_time() -> None:
    assert [failed(row) for row in ROWS] == [False, True]
    assert [outcome(row) for row in ROWS] == ["t = 40", "failed at t = 3.14"]
