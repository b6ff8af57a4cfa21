"""Work that is handed out to threads."""

from __future__ import annotations

import threading
import time

import pytest

from sphear.engine.threads import on_threads


@pytest.mark.parametrize("threads", [1, 2, 5])
def test_results_come_in_the_order_of_the_items(threads: int) -> None:
    assert on_threads(lambda k: k * k, range(7), threads) == [k * k for k in range(7)]


def test_items_are_done_side_by_side() -> None:
    """Each item waits for the other: one thread would wait for ever."""
    met = threading.Barrier(2, timeout=60)
    assert sorted(on_threads(lambda _: met.wait(), range(2), 2)) == [0, 1]


def test_the_thread_that_calls_takes_its_part() -> None:
    met = threading.Barrier(2, timeout=60)

    def of(_: int) -> int:
        met.wait()
        return threading.get_ident()

    assert threading.get_ident() in on_threads(of, range(2), 2)


@pytest.mark.parametrize("wrong", [0, 3])
def test_an_error_is_raised_when_nothing_is_at_work_any_more(wrong: int) -> None:
    at_work = set()

    def of(k: int) -> None:
        at_work.add(k)
        try:
            if k == wrong:
                raise ValueError(k)
            time.sleep(0.01)
        finally:
            at_work.remove(k)

    with pytest.raises(ValueError, match=str(wrong)):
        on_threads(of, range(4), 2)
    assert not at_work
