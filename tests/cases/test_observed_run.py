"""Runs of cases that are observed, that go on beyond their ends, and whose history has numbers of one's own."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import sphear
from sphear.cases.flow.poiseuille import POISEUILLE
from sphear.errors import SphearError

SMALL: dict[str, Any] = {"resolution": 10, "threads": 1}


def channel(*observers: sphear.Observer, beyond: tuple[str, ...] = (), **settings: Any) -> sphear.CaseRun:
    return sphear.flow("poiseuille", preset="basa2009", observers=observers, beyond=beyond, **{**SMALL, **settings})


def test_observers_look_at_times_of_the_flow_and_change_nothing() -> None:
    plain = channel(until=1.0).run()
    at = [time * plain.unit for time in (0.0, 0.2, 0.5, 1.0)]
    looks = sphear.Call(lambda run: run.flow.time, when=at)
    probe = sphear.Probe((0.5, 0.0), steps=20)
    run = channel(looks, probe, until=1.0).run()
    assert np.allclose(looks.rows, at, rtol=0, atol=0.5001 * run.flow.time_step)
    assert run.flow.steps > 40
    assert len(probe.rows) == 2 + (run.flow.steps - 1) // 20  # at the start, at each interval, at the end
    assert run.history == plain.history
    assert np.array_equal(run.flow.velocities, plain.flow.velocities)


def test_a_rule_of_ones_own_ends_a_run_of_a_case() -> None:
    run = channel(sphear.StopWhen(lambda run: "so" if run.flow.steps >= 7 else "", steps=1), until=1.0).run()
    assert (run.end, run.flow.steps, run.history[-1]["steps"]) == ("so", 7, 7)


def test_a_run_goes_on_beyond_the_steady_state() -> None:
    steady = channel(until=30.0).run()
    assert steady.end == "steady"
    beyond = channel(beyond=("steady",), until=30.0).run()
    assert beyond.end == "time"
    assert beyond.history[-1]["time"] == pytest.approx(30.0, rel=1e-3)
    assert steady.history[:-1] == beyond.history[: len(steady.history) - 1]


def test_a_run_goes_on_beyond_an_error_that_is_too_large() -> None:
    """Without pressure reduction the compressible channel is unstable (figure 2)."""
    gas: dict[str, Any] = {"equation_of_state": "ideal_gas", "pressure_reduction": "none", "until": 0.4}
    failed = channel(reynolds=0.3, **gas).run()
    assert failed.end.startswith("failed: the RMS error of")
    beyond = channel(reynolds=0.3, beyond=("failed",), **gas).run()
    assert beyond.flow.steps > failed.flow.steps
    assert beyond.history[-1]["rms_error"] > failed.history[-1]["rms_error"]


def test_a_breakdown_ends_a_run_that_goes_on_beyond_failures() -> None:
    run = channel(beyond=("failed",), until=0.1)
    run.flow.velocities[0] = np.inf
    assert run.run().end.startswith("failed: the flow failed at")


def test_numbers_of_ones_own_are_saved_with_the_history(tmp_path: Path) -> None:
    def started(until: float) -> sphear.CaseRun:
        settings = POISEUILLE.settings(**SMALL, until=until)
        return sphear.CaseRun(POISEUILLE, settings, measured=lambda run: {"greatest": float(run.flow.velocities.max())})

    first = started(0.01).run()
    first.save(tmp_path / "state.npz")
    again = started(0.02)
    again.restore(tmp_path / "state.npz")
    again.run()
    assert [row["greatest"] for row in again.history[: len(first.history)]] == [
        row["greatest"] for row in first.history
    ]
    assert again.history[-1]["greatest"] == again.flow.velocities.max() > first.history[-1]["greatest"]


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"observers": [3]}, "an observer is an Observer, such as History"),
        ({"beyond": ("stedy",)}, "no end of poiseuille to go on beyond named 'stedy': did you mean steady"),
    ],
)
def test_what_is_no_observer_and_no_end_is_refused(changes: dict[str, Any], said: str) -> None:
    with pytest.raises(SphearError, match=said):
        sphear.flow("poiseuille", **changes)
