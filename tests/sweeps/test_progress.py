"""How long a sweep will still take."""

from __future__ import annotations

import pytest

from sphear.sweeps import SweepProgress, SweepResult
from sphear.sweeps.events import Finished, Lost, Started
from sphear.sweeps.progress import Tracker

from .conftest import runs

ENDED = SweepResult("poiseuille", {}, {}, "time")
LOST = SweepResult("poiseuille", {}, {}, "lost: its worker was killed by SIGKILL")


def test_time_left_is_that_of_the_other_runs_at_the_same_pace() -> None:
    now = 0.0
    todo = runs([40, 20, 10])
    tracker = Tracker([], todo, clock=lambda: now)
    pace = 10.0 / todo[0].cost
    assert tracker.state().seconds_left is None
    tracker.started(Started(todo[0]))
    now = 10.0
    tracker.ended(Finished(todo[0], {}), ENDED)
    assert tracker.state().seconds_left == pytest.approx(pace * (todo[1].cost + todo[2].cost))
    tracker.started(Started(todo[1]))
    now = 10.0 + pace * todo[1].cost / 2
    assert tracker.state().seconds_left == pytest.approx(pace * (todo[1].cost / 2 + todo[2].cost))
    tracker.ended(Lost(todo[1], ""), LOST)
    assert tracker.state().seconds_left == pytest.approx(pace * todo[2].cost)
    assert (tracker.state().done, tracker.state().lost) == (1, 1)


def test_workers_share_what_is_left_but_not_one_run() -> None:
    now = 0.0
    todo = runs([20, 21, 22, 23])
    tracker = Tracker([], todo, clock=lambda: now)
    for run in todo[:2]:
        tracker.started(Started(run))
    now = 10.0
    for run in todo[:2]:
        tracker.ended(Finished(run, {}), ENDED)
    pace = 20.0 / (todo[0].cost + todo[1].cost)
    assert tracker.state().seconds_left == pytest.approx(pace * max(todo[3].cost, (todo[2].cost + todo[3].cost) / 2))


@pytest.mark.parametrize(
    ("seconds", "text"), [(0.4, "0 s"), (119, "119 s"), (150, "2 min"), (7100, "118 min"), (1e4, "3 h")]
)
def test_in_words(seconds: float, text: str) -> None:
    state = SweepProgress(runs=9, done=3, stored=1, running=2, failed=0, lost=0, seconds_left=seconds)
    assert str(state) == f"3 of 9 runs done, 2 running, about {text} left"
