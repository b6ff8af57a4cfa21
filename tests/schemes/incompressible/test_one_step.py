"""Whole steps of each combination of settings against another program, `plain`."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from sphear.boundaries import Box
from sphear.boundaries.shapes import Dummies
from sphear.schemes.incompressible.flow import IncompressibleFlow
from sphear.schemes.incompressible.settings import IncompressibleSettings
from sphear.schemes.presets import preset_settings
from sphear.schemes.problem import Problem
from tests.particles import jittered
from tests.schemes.incompressible.plain import Plain

COUNT = 9
STEP, STEPS = 0.002, 2
USUAL = {"viscosity": "oger"}
PAPER = preset_settings("zheng2018", "incompressible")

# what is set, and the sides of the box
COMBINATIONS: list[tuple[str, str, dict[str, Any]]] = [
    ("paper", "cavity", PAPER),
    ("paper, channel", "channel", {**PAPER, "viscosity": "schwaiger", "alpha": 0.3}),
    ("paper, periodic", "periodic", {**PAPER, "viscosity": "morris"}),
    ("usual", "cavity", USUAL),
    ("usual, periodic", "periodic", {**USUAL, "alpha": 0.05}),
    ("adami", "cavity", {**USUAL, "walls": "adami", "continuation": "mirror", "viscosity": "morris"}),
    (
        "adami, channel",
        "channel",
        {**USUAL, "walls": "adami", "wall_divergence": "continued", "alpha": 1.0, "laplacian": "oger"},
    ),
    ("natural", "cavity", {**USUAL, "walls": "natural", "continuation": "linear", "shifting": "xu"}),
    ("natural, channel", "channel", {**USUAL, "walls": "natural", "viscosity": "schwaiger", "laplacian": "oger"}),
    ("mirror points, symmetric", "channel", {**PAPER, "walls": "mirror_points", "alpha": 0.0, "shifting": "xu"}),
    ("mirror points, gotoh", "cavity", {**USUAL, "viscosity": "gotoh", "projection": "intermediate", "alpha": 0.2}),
    ("other laplacians", "channel", {**USUAL, "laplacian": "schwaiger", "walls": "sfdi", "continuation": "linear"}),
    ("laplacian of gotoh", "periodic", {**USUAL, "laplacian": "gotoh", "h_over_dx": 1.4}),
    ("crank_nicolson", "cavity", {**USUAL, "viscosity": "morris", "viscous_step": "crank_nicolson"}),
    ("backward_euler", "channel", {**PAPER, "viscosity": "morris", "viscous_step": "backward_euler"}),
]


def problem(sides: str) -> Problem:
    """Jittered particles with random velocities, so that no term vanishes; the upper wall slides."""
    dx = 1 / COUNT
    kinds: Any = {"cavity": ("walls", "walls"), "channel": ("periodic", "walls"), "periodic": ("periodic",) * 2}[sides]
    positions = jittered((COUNT, COUNT), 0.4, seed=0, dx=dx)
    positions[:, 0] += 0.77 * (sides != "cavity")  # outside of the periodic box
    return Problem(
        positions=positions,
        velocities=np.asarray(np.random.default_rng(1).normal(size=positions.shape)),
        box=Box((0.0, 0.0), (1.0, 1.0), kinds, upper_velocity=(0.7, 0.0) if sides != "periodic" else ()),
        body_force=(3.0, -2.0),
        spacing=dx,
        density=1.7,
        kinematic_viscosity=0.13,
        speed=4.0,
        length=1.0,
    )


def flow(sides: str, changes: dict[str, Any]) -> IncompressibleFlow:
    chosen = {"h_over_dx": 1.57, "tolerance": 1e-13, "time_step": STEP, "preconditioner": "jacobi", **changes}
    settings = IncompressibleSettings.model_validate(chosen)
    return IncompressibleFlow(problem(sides), settings)


@pytest.mark.parametrize(("name", "sides", "changes"), COMBINATIONS, ids=[name for name, _, _ in COMBINATIONS])
def test_steps_are_those_of_another_program(
    name: str, sides: str, changes: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("sphear.schemes.incompressible.viscous.TOLERANCE", 1e-14)
    fast = flow(sides, changes)
    behind = fast.discretisation.walls
    walls = None if behind is None else behind.dummies
    slow = Plain(fast.problem, fast.settings, walls, fast.time_step, fast.alpha)
    fast.advance(STEPS)
    for _ in range(STEPS):
        slow.step()
    moved = np.abs(slow.u - fast.problem.velocities).max()
    assert moved > 0.01
    np.testing.assert_allclose(fast.pressures.fluid, slow.p, rtol=0, atol=1e-11 * np.abs(slow.p).max())
    np.testing.assert_allclose(fast.velocities, slow.u, rtol=0, atol=1e-11 * moved)
    away = fast.positions - slow.x
    away -= np.rint(away) * np.array(fast.problem.periodic)  # periods are of length one
    np.testing.assert_allclose(away, 0.0, rtol=0, atol=1e-12)


@pytest.mark.parametrize("wall_model", ["sfdi", "mirror_points"])
def test_wall_particles_continue_the_lattice(wall_model: str) -> None:
    """As deep as the kernel reaches, from half a spacing behind the wall on; with sfdi on the wall too."""
    walls = flow("channel", {"walls": wall_model, "viscosity": "morris"}).discretisation.walls
    assert walls is not None
    dummies: Dummies = walls.dummies
    dx, on_wall = 1 / COUNT, [0.0] if wall_model == "sfdi" else []
    rows = np.array([*on_wall, 0.5, 1.5, 2.5, 3.5]) * dx
    np.testing.assert_allclose(np.unique(dummies.depths.round(10)), rows, atol=1e-9)
    upper = dummies.positions[:, 1] > 0.5
    np.testing.assert_allclose(dummies.positions[upper, 1] - 1.0, dummies.depths[upper], atol=1e-12)
    np.testing.assert_array_equal(dummies.velocities[upper], [[0.7, 0.0]] * int(upper.sum()))
    np.testing.assert_array_equal(dummies.normals[~upper], [[0.0, 1.0]] * int((~upper).sum()))
    assert len(dummies.positions) == 2 * len(rows) * COUNT
