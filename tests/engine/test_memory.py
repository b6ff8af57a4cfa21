"""Freed memory is kept where the C library can be told so, and nowhere else is anything wrong."""

from __future__ import annotations

import ctypes
from typing import Any

import pytest

from sphear.engine.memory import keep_freed_memory


def test_the_c_library_is_told_both_thresholds(monkeypatch: pytest.MonkeyPatch) -> None:
    told = []

    class Library:
        def mallopt(self, parameter: int, value: int) -> int:
            told.append((parameter, value))
            return 1

    monkeypatch.setattr(ctypes, "CDLL", lambda name: Library())
    keep_freed_memory()
    assert told == [(-1, 2**31 - 1), (-3, 2**31 - 1)]  # M_TRIM_THRESHOLD and M_MMAP_THRESHOLD of glibc


@pytest.mark.parametrize("error", [OSError, TypeError, AttributeError])
def test_another_system_is_left_alone(error: type[Exception], monkeypatch: pytest.MonkeyPatch) -> None:
    def missing(name: Any) -> Any:
        raise error

    monkeypatch.setattr(ctypes, "CDLL", missing)
    keep_freed_memory()
