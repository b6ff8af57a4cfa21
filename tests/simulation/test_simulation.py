"""Simulations that are composed of objects: the same flows as the cases have, and refusals in one sentence."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import sphear
from sphear.errors import SphearError

SQUARE = sphear.Rectangle((0, 0), (1, 1))
FLUID = sphear.Fluid(kinematic_viscosity=0.01)
LID = {"upper": sphear.NoSlip(velocity=(1.0, 0.0))}


def cavity(scheme: Any = None, **changes: Any) -> sphear.Simulation:
    given: dict[str, Any] = {"spacing": 0.05, "fluid": FLUID, "boundaries": LID, **changes}
    return sphear.Simulation(SQUARE, scheme=scheme, **given)


@pytest.mark.parametrize(
    ("name", "scheme"),
    [
        ("incompressible", sphear.Incompressible(viscosity=sphear.Oger(), threads=1)),
        ("explicit", sphear.WeaklyCompressible(threads=1)),
    ],
)
def test_a_cavity_is_the_case_of_that_name(name: str, scheme: Any) -> None:
    viscosity = "oger" if name == "incompressible" else "fatehi_manzari"
    case = sphear.flow("cavity", scheme=name, viscosity=viscosity, reynolds=100, resolution=20, threads=1).flow
    case.advance(12)
    found = cavity(scheme).step(12)
    assert found.time == pytest.approx(case.time, rel=1e-12)
    assert np.allclose(found.positions, case.positions, rtol=0, atol=1e-10)
    assert np.allclose(found.velocities, case.velocities, rtol=0, atol=1e-9)


def test_a_solid_is_the_case_with_a_cylinder() -> None:
    case = sphear.flow("cavity-cylinder", reynolds=100, resolution=24, spin=0.5, diameter=0.4, threads=1).flow
    case.advance(3)
    region = SQUARE - sphear.Circle((0.5, 0.5), 0.2, name="cylinder")
    boundaries = {**LID, "cylinder": sphear.NoSlip(spin=0.5)}
    found = sphear.Simulation(
        region, spacing=1 / 24, fluid=FLUID, boundaries=boundaries, scheme=sphear.Incompressible(threads=1)
    )
    found.step(3)
    assert np.allclose(found.velocities, case.velocities, rtol=0, atol=1e-12)


def test_a_run_goes_on_to_a_later_time() -> None:
    whole, parts = cavity().run(until=0.2), cavity()
    parts.run(until=0.1).run(until=0.2)
    assert np.array_equal(parts.positions, whole.positions)
    assert (parts.time, parts.end) == (whole.time, "time")
    assert 0.2 <= whole.time < 0.2 + whole.flow.time_step


def test_a_saved_state_is_gone_on_with(tmp_path: Path) -> None:
    first = cavity().run(until=0.1)
    first.save(tmp_path / "state.npz")
    again = cavity().restore(tmp_path / "state.npz")
    assert again.time == first.time
    assert np.array_equal(again.step(2).positions, first.step(2).positions)
    with pytest.raises(SphearError, match="has boundaries"):
        cavity(boundaries={}, speed=1.0).restore(tmp_path / "state.npz")


def test_it_prints_its_physics_its_numerics_and_its_steps() -> None:
    text = str(cavity(sphear.Incompressible(viscosity=sphear.Cleary(xi=4.24))))
    for said in (
        "rectangle from (0, 0) to (1, 1)", "Fluid(density=1, kinematic_viscosity=0.01)", "NoSlip(velocity=(1.0, 0.0))",
        "100, of the speed 1", "400, 0.05 apart", "cleary_4.24", "cfl allows 0.0314", "t = 0, 0 steps",
    ):  # fmt: skip
        assert said in text
    assert repr(cavity()) == "<Simulation of 400 particles: t = 0, 0 steps>"


def test_a_failure_is_raised_and_stays(monkeypatch: pytest.MonkeyPatch) -> None:
    flow = cavity()
    monkeypatch.setattr(flow, "implausible", lambda: "failed: nonsense")
    with pytest.raises(sphear.FlowFailure, match="nonsense"):
        flow.run(until=0.5)
    assert flow.end == "failed: nonsense"
    with pytest.raises(sphear.FlowFailure, match="nonsense"):
        flow.step()


def test_fluid_between_sliding_plates_turns_linear() -> None:
    """Couette's flow, periodic along x; exact in the limit."""
    flow = sphear.Simulation(
        sphear.Rectangle((0, 0), (0.5, 1)),
        spacing=1 / 12,
        fluid=sphear.Fluid(density=2.0, dynamic_viscosity=1.0),
        boundaries={"x": sphear.Periodic(), **LID},
        scheme="weakly_compressible",
    ).run(until=3.0)
    assert np.abs(flow.velocities[:, 0] - flow.positions[:, 1]).max() < 1e-3
    assert flow.density.mean() == pytest.approx(2.0, rel=1e-3)


def test_fluid_that_fills_a_part_has_a_surface() -> None:
    flow = sphear.Simulation(
        sphear.Rectangle((0, 0), (3, 2)),
        spacing=0.125,
        fluid=sphear.Fluid(kinematic_viscosity=0.01),
        body_force=(0.0, -1.0),
        filled=sphear.Rectangle((0, 0), (1, 1)),
        scheme=sphear.Incompressible(continuation="linear"),
        speed=2.0,
    )
    assert len(flow.positions) == 64
    flow.run(until=0.5)
    assert 1.1 < flow.positions[:, 0].max() < 1.3  # of 1, and sqrt(g a) t / 2 further at most
    assert flow.positions[:, 1].mean() < 0.5


MIDDLE = sphear.Circle((0.5, 0.5), 0.2)
WRONG: dict[str, tuple[dict[str, Any], str]] = {
    "no wall": ({"boundaries": {"uper": sphear.NoSlip()}}, "there is no wall named 'uper': did you mean upper"),
    "no condition": ({"boundaries": {"upper": 3}}, "the boundary 'upper' has a condition, such as NoSlip(), not 3"),
    "no mapping": ({"boundaries": 3}, "boundaries are given by name"),
    "through itself": ({"boundaries": {"upper": sphear.NoSlip(velocity=(0, 1))}}, "moves through the wall"),
    "a circle slides": ({"region": SQUARE - MIDDLE, "boundaries": {"circle": sphear.NoSlip(velocity=(1, 0))}},
                        "the wall 'circle' is a circle, which turns with a spin"),
    "a side turns": ({"boundaries": {"upper": sphear.NoSlip(spin=1)}}, "the wall 'upper' is straight"),
    "gone": ({"boundaries": {"x": sphear.Periodic(), "left": sphear.FreeSlip()}, "region": SQUARE - MIDDLE},
             "there is no wall 'left'"),
    "a wall repeats": ({"boundaries": {"upper": sphear.Periodic()}}, "a flow repeats along an axis, x or y"),
    "two names": ({"region": SQUARE - MIDDLE - sphear.Circle((0.2, 0.2), 0.1)}, "two shapes have walls named 'circle'"),
    "spacing": ({"spacing": -1}, "the spacing of the particles is a positive length, not -1"),
    "too coarse": ({"spacing": 0.5}, "narrower than the support of the kernel"),
    "fluid": ({"fluid": 3}, "the fluid is a Fluid, such as Fluid(kinematic_viscosity=0.01), not 3"),
    "region": ({"region": "square"}, "a region is a shape, such as Rectangle((0, 0), (1, 1)), not 'square'"),
    "unbounded": ({"region": ~MIDDLE, "boundaries": {}}, "a region is bounded"),
    "scheme": ({"scheme": "implicit"}, "there is no scheme named 'implicit'"),
    "no scheme": ({"scheme": 3}, "a flow is computed by WeaklyCompressible or Incompressible, not by 3"),
    "mirrors around a solid": (
        {"region": SQUARE - MIDDLE, "scheme": sphear.WeaklyCompressible(walls=sphear.MirrorParticles())},
        "walls=mirror reflect particles at the sides of a box",
    ),
    "observer": ({"observers": [print]}, "an observer is an Observer, such as History(every=0.1)"),
    "velocities": ({"velocity": np.ones(3)}, "velocities at the start are one for all or of the shape (400, 2)"),
    "nothing moves": ({"boundaries": {}}, "nothing moves this fluid at the start: say how fast it will be"),
    "free slip of another model": (
        {"boundaries": {**LID, "lower": sphear.FreeSlip()}, "scheme": sphear.WeaklyCompressible(walls="adami")},
        "fluid slips along walls of walls=mirror",
    ),
    "filled": ({"filled": 3}, "the part that is filled is a shape"),
    "filled nowhere": ({"filled": sphear.Circle((9, 9), 1)}, "holds no particle of the region"),
}  # fmt: skip


@pytest.mark.parametrize("case", WRONG)
def test_what_does_not_go_together_is_said_in_one_sentence(case: str) -> None:
    changes, said = WRONG[case]
    given = {"region": SQUARE, "spacing": 0.05, "fluid": FLUID, "boundaries": LID, **changes}
    with pytest.raises(SphearError) as refused:
        sphear.Simulation(given.pop("region"), **given)
    assert said in str(refused.value)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda flow: flow.run(until=0.0), "a run goes on to a time later than 0"),
        (lambda flow: flow.step(0), "steps are made in a positive number"),
        (lambda flow: flow.history, "this simulation has no history"),
    ],
)
def test_calls_that_mean_nothing(call: Any, said: str) -> None:
    with pytest.raises(SphearError, match=said):
        call(cavity())


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ({}, "give one of them"),
        ({"kinematic_viscosity": 1.0, "dynamic_viscosity": 1.0}, "give one of them"),
        ({"kinematic_viscosity": -1.0}, "the kinematic viscosity of a fluid"),
        ({"kinematic_viscosity": 1.0, "density": 0}, "the density of a fluid is a positive number, not 0"),
        ({"dynamic_viscosity": "thick"}, "the dynamic viscosity of a fluid"),
    ],
)
def test_fluids_that_are_none(wrong: dict[str, Any], said: str) -> None:
    with pytest.raises(SphearError, match=said):
        sphear.Fluid(**wrong)


def test_the_other_viscosity_follows() -> None:
    assert sphear.Fluid(density=1000.0, dynamic_viscosity=1e-3).kinematic_viscosity == pytest.approx(1e-6)
    assert sphear.Fluid(density=1000.0, kinematic_viscosity=1e-6).dynamic_viscosity == pytest.approx(1e-3)


@pytest.mark.parametrize(
    ("wrong", "said"),
    [({"velocity": "fast"}, "the velocity of a wall"), ({"spin": "fast"}, "the spin of a wall"),
     ({"velocity": (1, 0), "spin": 1}, "slides with a velocity or turns with a spin")],
)  # fmt: skip
def test_walls_that_cannot_move_so(wrong: dict[str, Any], said: str) -> None:
    with pytest.raises(SphearError, match=said):
        sphear.NoSlip(**wrong)
