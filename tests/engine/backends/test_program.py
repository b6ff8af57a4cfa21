"""Programs of the processor: stages one after the other, with room that grows, and failures that are told."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest

from sphear.boundaries import Box
from sphear.engine.backends.cpu import Program, Space
from sphear.engine.stages import (
    NOT_FINITE,
    NOT_POSITIVE,
    THROUGH_A_WALL,
    TOO_FAST,
    AtImages,
    CheckFinite,
    CheckPositive,
    Column,
    EnterBox,
    Images,
    Neighbours,
    PairSum,
    PerParticle,
    Rows,
    Stage,
)
from sphear.kernels import WendlandC2

Array = np.ndarray[Any, Any]

SPACING = 0.1
PERIODIC = Box((0.0, 0.0), (1.0, 1.0), ("periodic", "periodic"))
WALLS = Box((0.0, 0.0), (1.0, 1.0), ("walls", "walls"))
KERNEL = WendlandC2(0.15)


@dataclass(frozen=True)
class Smoothed:
    """sum_j a_j W_ij."""

    kernel: WendlandC2

    def pair(self, own: Any, other: Any, d: tuple[Any, ...], r2: Any) -> tuple[Any, ...]:
        return (other.amount * self.kernel.value(r2, len(d)),)

    def finish(self, own: Any, total: Any) -> tuple[Any, ...]:
        return (total[0],)


@dataclass(frozen=True)
class Grown:
    """A number that grows by a factor and an amount, and a sum that is kept."""

    factor: float
    keeps: bool = False

    def at(self, own: Any) -> dict[str, Any]:
        return {"kept": own.smoothed[0]} if self.keeps else {"amount": self.factor * own.amount + own.gained[0]}


def fields(count: int = 100, walls: int = 0) -> dict[str, Array]:
    generator = np.random.default_rng(0)
    return {
        "position": generator.random((count + walls, 2)),
        "velocity": np.zeros((count + walls, 2)),
        "amount": generator.random(count + walls) + 0.5,
        "kept": np.zeros(count + walls),
    }


def program(
    stages: list[Stage], arrays: dict[str, Array], box: Box = PERIODIC, threads: int = 1, walls: int = 0
) -> Program:
    space = Space(*box.arrays(), spacing=SPACING, support=KERNEL.radius)
    count = len(arrays["position"]) - walls
    return Program(stages, arrays, {"gained": np.array([2.0])}, space, count, threads)


def test_a_formula_changes_the_rows_that_it_is_for_alone() -> None:
    arrays = fields(walls=7)
    before = arrays["amount"].copy()
    assert program([PerParticle(Grown(3.0), Rows.WALLS)], arrays, walls=7).run(2).steps == 2
    np.testing.assert_array_equal(arrays["amount"][:100], before[:100])
    np.testing.assert_allclose(arrays["amount"][100:], 9 * before[100:] + 8)


@pytest.mark.parametrize("threads", [1, 2])
@pytest.mark.parametrize("count", [100, 3000])
def test_a_sum_over_pairs_is_that_of_another_search_however_much_room_it_needs(threads: int, count: int) -> None:
    """3,000 particles have 30 times the neighbours that the spacing says, so that all rooms have to grow."""
    arrays = fields(count)
    column = (("amount", Column(lambda own: own.amount, AtImages.SAME)),)
    stages: list[Stage] = [
        Images(1, on_walls=False),
        Neighbours(of_images=False),
        PairSum("smoothed", Smoothed(KERNEL), Rows.FLUID, column),
        PerParticle(Grown(0.0, keeps=True), Rows.FLUID),
    ]
    assert program(stages, arrays, threads=threads).run(1).cause == 0
    apart = arrays["position"][:, None] - arrays["position"]
    r2 = ((apart - np.round(apart)) ** 2).sum(axis=2)
    w = np.where(r2 < KERNEL.radius**2, KERNEL.value(np.minimum(r2, KERNEL.radius**2), 2), 0.0)
    np.fill_diagonal(w, 0.0)
    np.testing.assert_allclose(arrays["kept"], w @ arrays["amount"], rtol=1e-12)


@pytest.mark.parametrize(
    ("stage", "field", "value", "cause"),
    [
        (CheckFinite("velocity"), "velocity", np.nan, NOT_FINITE),
        (CheckFinite("velocity"), "velocity", np.inf, NOT_FINITE),
        (CheckPositive("amount"), "amount", 0.0, NOT_POSITIVE),
        (CheckPositive("amount"), "amount", np.nan, NOT_POSITIVE),
        (EnterBox(fastest=3.0), "velocity", 4.0, TOO_FAST),
        (EnterBox(fastest=3.0), "position", 1.2, THROUGH_A_WALL),
        (EnterBox(fastest=3.0), "position", np.nan, THROUGH_A_WALL),
    ],
)
def test_a_failure_names_its_cause_its_particle_and_its_stage(
    stage: Stage, field: str, value: float, cause: int
) -> None:
    arrays = fields()
    arrays[field][41] = value
    ended = program([PerParticle(Grown(1.0, keeps=False), Rows.WALLS), stage], arrays, WALLS).run(5)
    assert ended == (0, cause, 41, 1)


def test_particles_come_back_over_periodic_sides_and_off_mirrors() -> None:
    box = Box((0.0, 0.0), (1.0, 1.0), ("periodic", "walls"), upper_velocity=(0.5, 0.0))
    arrays = fields(2)
    arrays["position"][:] = [(-0.25, 0.5), (0.5, 1.02)]
    arrays["velocity"][:] = [(-1.0, 0.0), (0.2, 0.3)]
    assert program([EnterBox(fastest=9.0)], arrays, box).run(1).cause == 0
    np.testing.assert_allclose(arrays["position"], [(0.75, 0.5), (0.5, 0.98)])
    np.testing.assert_allclose(arrays["velocity"], [(-1.0, 0.0), (0.2, -0.3)])


def test_stages_of_part_of_a_step_run_alone() -> None:
    arrays = fields()
    before = arrays["amount"].copy()
    stages: list[Stage] = [PerParticle(Grown(2.0), Rows.FLUID), PerParticle(Grown(5.0), Rows.FLUID)]
    program(stages, arrays).run(1, 1, 2)
    np.testing.assert_allclose(arrays["amount"], 5 * before + 2)
