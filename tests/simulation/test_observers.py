"""Observers: when they look, what they keep, and how they end a run."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import sphear
from sphear.errors import SphearError


def vortex(*observers: sphear.Observer) -> sphear.Simulation:
    """A Taylor-Green vortex in a periodic square, nu k^2 = 0.79."""

    def start(x: Any) -> Any:
        a, b = 2 * np.pi * x.T
        return np.column_stack((np.sin(a) * np.cos(b), -np.cos(a) * np.sin(b)))

    return sphear.Simulation(
        sphear.Rectangle((0, 0), (1, 1)),
        spacing=1 / 24,
        fluid=sphear.Fluid(kinematic_viscosity=0.01),
        boundaries={"x": sphear.Periodic(), "y": sphear.Periodic()},
        velocity=start,
        observers=observers,
        scheme=sphear.Incompressible(threads=1),
    )


def test_a_history_looks_at_the_start_at_even_times_and_at_the_end() -> None:
    flow = vortex(sphear.History(every=0.1)).run(until=0.35)
    dt, times = flow.flow.time_step, flow.history["time"]
    assert len(times) == 5
    assert times[0] == 0.0
    for at, time in zip((0.1, 0.2, 0.3, 0.35), times[1:], strict=True):
        assert at - 1e-9 <= time < at + dt
    decay = np.exp(-2 * 0.01 * 8 * np.pi**2 * times)
    assert np.allclose(flow.history["kinetic_energy"] / 0.25, decay, rtol=0.1)
    assert np.isnan(flow.history["divergence"][0])  # nothing was solved for yet


def test_a_history_by_steps() -> None:
    flow = vortex(sphear.History(steps=4)).step(10)
    assert flow.history["steps"].tolist() == [0, 4, 8, 10]


def test_a_profile_at_the_end_is_that_of_the_flow() -> None:
    profile = sphear.Profile("u", y=0.25, stations=9)
    flow = vortex(profile).run(until=0.1)
    exact = np.exp(-0.01 * 8 * np.pi**2 * flow.time) * np.sin(2 * np.pi * profile.at) * np.cos(np.pi / 2)
    assert len(profile.rows) == 1
    assert np.abs(profile.values - exact).max() < 0.06
    across = sphear.Profile("v", y=0.5, stations=9, every=0.05)
    flow = vortex(across).run(until=0.1)
    exact = np.exp(-0.01 * 8 * np.pi**2 * flow.time) * -np.cos(2 * np.pi * across.at) * np.sin(np.pi)
    assert len(across.rows) == 2
    assert np.abs(across.values - exact).max() < 0.06


def test_a_probe_follows_the_decay() -> None:
    probe = sphear.Probe((0.25, 0.5), every=0.05)
    vortex(probe).run(until=0.2)
    decay = np.exp(-0.01 * 8 * np.pi**2 * probe.times)
    assert np.allclose(probe.velocities[:, 0], -decay, atol=0.06)
    assert np.abs(probe.velocities[:, 1]).max() < 0.06


def test_snapshots_are_copies() -> None:
    kept = sphear.Snapshots(steps=2)
    flow = vortex(kept).step(4)
    assert [len(snapshot.positions) for snapshot in kept.rows] == [576, 576, 576]
    assert np.array_equal(kept.rows[-1].positions, flow.positions)
    assert not np.array_equal(kept.rows[0].positions, flow.positions)


def test_a_function_is_called_with_the_simulation() -> None:
    called = sphear.Call(lambda simulation: simulation.steps, steps=3)
    vortex(called).step(7)
    assert called.rows == [3, 6, 7]


def test_times_of_ones_own_are_looked_at_by_the_nearest_step_and_nothing_else_is() -> None:
    dt = vortex().flow.time_step
    at = (3.4 * dt, 0.0, 6.6 * dt, 6.8 * dt)
    several = [
        sphear.History(when=at),
        sphear.Snapshots(when=at),
        sphear.Probe((0.5, 0.5), when=at),
        sphear.Profile("u", x=0.5, when=at),
        sphear.Call(lambda simulation: simulation.steps, when=at),
    ]
    flow = vortex(*several).step(2).step(8)
    assert several[-1].rows == [0, 3, 7]
    assert np.allclose(flow.history["time"] / dt, [0, 3, 7])
    for observer in several:
        assert len(observer.rows) == 3


def test_a_function_and_a_profile_look_at_the_start_if_asked_to() -> None:
    called = sphear.Call(lambda simulation: simulation.steps, steps=3, at_start=True)
    profile = sphear.Profile("u", y=0.25, stations=5, at_start=True)
    flow = vortex(called, profile).step(4)
    assert called.rows == [0, 3, 4]
    assert [time for time, _ in profile.rows] == [0.0, flow.time]
    assert np.allclose(profile.rows[0][1], np.sin(2 * np.pi * profile.at) * np.cos(np.pi / 2), atol=0.02)


def test_what_broke_down_is_looked_at_as_the_end_only() -> None:
    dt = vortex().flow.time_step
    times, steps = sphear.Call(lambda simulation: simulation.steps, when=(dt, 2 * dt, 3 * dt)), sphear.History(steps=1)
    flow = vortex(times, steps)
    advance = flow.flow.advance

    def broken(count: int) -> None:
        advance(count)
        if flow.steps == 2:
            raise sphear.FlowFailure("so")

    flow.flow.advance = broken  # type: ignore[method-assign, assignment]
    with pytest.raises(sphear.FlowFailure, match="so"):
        flow.step(5)
    assert times.rows == [1]
    assert [row["steps"] for row in steps.rows] == [0, 1, 2]


def test_a_rule_ends_a_run() -> None:
    rule = sphear.StopWhen(lambda simulation: "slow" if simulation.time > 0.1 else None, steps=1)
    history = sphear.History(every=10.0)
    flow = vortex(rule, history).run(until=5.0)
    assert flow.end == "slow"
    assert 0.1 < flow.time < 0.1 + flow.flow.time_step
    assert history.rows[-1]["time"] == flow.time  # whoever looks at the end looks at that end


def test_an_observer_of_ones_own() -> None:
    class Largest(sphear.Observer):
        def look(self, run: Any) -> float:
            return float(np.abs(run.velocities).max())

    mine = Largest(every=0.1)
    vortex(mine).run(until=0.2)
    assert len(mine.rows) == 3
    assert mine.rows == sorted(mine.rows, reverse=True)


def test_progress_is_told_on_the_error_stream(capsys: pytest.CaptureFixture[str]) -> None:
    vortex(sphear.Progress(steps=1)).step(3)
    said = capsys.readouterr()
    assert said.out == ""
    assert "t = " in said.err
    assert "end: steps" in said.err


def test_an_interrupted_run_takes_its_rows_back(monkeypatch: pytest.MonkeyPatch) -> None:
    flow, whole = vortex(sphear.History(steps=1)), vortex(sphear.History(steps=1)).step(6)
    advance, made = flow.flow.advance, []

    def interrupted(steps: int) -> None:
        advance(steps)
        made.append(steps)
        if sum(made) == 3:
            raise KeyboardInterrupt

    with monkeypatch.context() as patched:
        patched.setattr(flow.flow, "advance", interrupted)
        with pytest.raises(KeyboardInterrupt):
            flow.step(6)
    assert len(flow.history["steps"]) == flow.steps + 1
    flow.step(6 - flow.steps)
    assert flow.history["kinetic_energy"].tolist() == whole.history["kinetic_energy"].tolist()


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: sphear.History(every=0), "the interval of History is a positive time, not 0"),
        (lambda: sphear.History(steps=0), "the interval of History is a positive number of steps, not 0"),
        (lambda: sphear.History(every=1.0, steps=1), "every so many steps or at times of its own: give one"),
        (lambda: sphear.Snapshots(steps=1, when=(1.0,)), "give one"),
        (lambda: sphear.Snapshots(when=()), "Snapshots looks at times from the start on, some of them, not at ()"),
        (lambda: sphear.Probe((0.5, 0.5), when=(0.1, -0.1)), "Probe looks at times from the start on"),
        (lambda: sphear.Call(str, when=(float("nan"),)), "Call looks at times from the start on"),
        (lambda: sphear.Profile("w", x=0.5), "there is no velocity component named 'w'"),
        (lambda: sphear.Profile("u"), "a profile lies along x=c or y=c"),
        (lambda: sphear.Profile("u", x=float("nan")), "a finite coordinate"),
        (lambda: sphear.Profile("u", x=0.5, stations=0), "a positive number of stations"),
        (lambda: sphear.Probe((1.0,)), "a probe stands at a point of two numbers"),
        (lambda: sphear.Call(3), "Call calls a function of the simulation, not 3"),  # type: ignore[arg-type]
    ],
)
def test_observers_that_are_none(make: Any, said: str) -> None:
    with pytest.raises(SphearError) as refused:
        make()
    assert said in str(refused.value)


def test_a_profile_outside_the_fluid() -> None:
    with pytest.raises(SphearError, match="the profile of u along x=3 is nowhere in the fluid"):
        vortex(sphear.Profile("u", x=3.0)).step()
