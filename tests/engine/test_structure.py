"""Formulas made of formulas, in tuples too: which numbers are parameters, and what decides the code."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import count
from typing import Any

import numpy as np
import pytest

from sphear import CORRECTIONS, CubicSpline, Kernel, Particles, WendlandC2
from sphear.engine.formula import Sum, traced
from sphear.engine.structure import kind, parameters, with_symbols
from sphear.interactions import Continuity, DensityDiffusion, PressureForce, Rates, Shifting
from sphear.operators.pipeline import Operation, run
from tests.particles import jittered

KERNEL, NONE = CubicSpline(1.5), CORRECTIONS["none"]


@dataclass(frozen=True)
class Scaled(Sum):
    factor: float
    kernel: Kernel

    def pair(self, own: Any, other: Any, d: Any, r2: Any) -> Any:
        return (self.factor * other.volume * self.kernel.value(r2, len(d)),)


@dataclass(frozen=True)
class Together(Sum):
    first: float
    parts: tuple[Scaled, ...]
    names: tuple[str, ...] = ()
    last: float = 7.0

    def pair(self, own: Any, other: Any, d: Any, r2: Any) -> Any:
        return tuple(part.pair(own, other, d, r2)[0] * self.last + self.first for part in self.parts)


@dataclass(frozen=True)
class Signs(Sum):
    kernel: Kernel
    signs: tuple[int, ...]

    def pair(self, own: Any, other: Any, d: Any, r2: Any) -> Any:
        return tuple(sign * (other.volume * self.kernel.value(r2, len(d))) for sign in self.signs)


def together(*numbers: float, kernel: type[Kernel] = CubicSpline) -> Together:
    first, one, h, other, wide, last = numbers
    return Together(first, (Scaled(one, kernel(h)), Scaled(other, CubicSpline(wide))), ("a",), last)


SOME = together(1.0, 2.0, 3.0, 4.0, 5.0, 6.0)


def test_parameters_are_those_of_all_parts_in_their_order() -> None:
    assert parameters(SOME) == [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]
    assert parameters(Together(1.0, ())) == [1.0, 7.0]


def test_the_numbers_of_parts_do_not_decide_the_code() -> None:
    assert kind(SOME) == kind(together(6.0, 5.0, 4.0, 3.0, 2.0, 1.0))
    assert len({kind(SOME), kind(together(6.0, 5.0, 4.0, 3.0, 2.0, 1.0))}) == 1  # it is a key


DIFFERENT = {
    "a part less": Together(1.0, SOME.parts[:1], ("a",)),
    "their order": together(1.0, 2.0, 3.0, 4.0, 5.0, 6.0, kernel=WendlandC2),
    "other words": Together(1.0, SOME.parts, ("b",)),
}


@pytest.mark.parametrize("other", DIFFERENT.values(), ids=DIFFERENT)
def test_the_parts_themselves_decide_it(other: Together) -> None:
    assert kind(other) != kind(SOME)


def test_the_order_of_parts_decides_it() -> None:
    one = Together(1.0, (Scaled(1.0, WendlandC2(1.0)), Scaled(1.0, CubicSpline(1.0))))
    assert kind(one) != kind(Together(1.0, one.parts[::-1]))


def test_symbols_stand_in_for_the_numbers_of_parts() -> None:
    numbers = count()
    copy = with_symbols(SOME, lambda: f"p{next(numbers)}")
    assert copy.first, copy.last == ("p0", "p5")
    assert [(part.factor, part.kernel.h) for part in copy.parts] == [("p1", "p2"), ("p3", "p4")]
    assert all(type(part) is Scaled and isinstance(part.kernel, CubicSpline) for part in copy.parts)
    assert copy.names == ("a",)
    assert SOME.first == 1.0


def test_each_part_of_a_sweep_has_its_own_numbers() -> None:
    """Compiled once, called with others."""
    places = jittered((6, 6), 0.3, seed=0)
    known = {"volume": np.full(len(places), 1.0)}
    neighbours = Particles.read(places, kernel=CubicSpline(1.6), volumes=1.0).neighbours

    def sums(formula: Any) -> Any:
        return run(Operation((formula,)), neighbours, known).values

    one = sums(Scaled(1.0, CubicSpline(1.2)))[:, 0], sums(Scaled(1.0, CubicSpline(1.6)))[:, 0]
    for numbers in ((0.0, 2.0, 1.2, -3.0, 1.6, 5.0), (0.0, -1.0, 1.6, 4.0, 1.2, 0.5)):
        _, factor, h, other, _, last = numbers
        first, second = one if h == 1.2 else one[::-1]
        expected = np.stack((last * factor * first, last * other * second), axis=1)
        np.testing.assert_allclose(sums(together(*numbers)), expected, rtol=1e-12)


def test_a_flow_is_a_tuple_of_parts() -> None:
    rates = Rates((
        PressureForce(KERNEL, NONE, "products", subtracted=125e3), Continuity(KERNEL, NONE),
        DensityDiffusion(KERNEL, 0.1, 30.0), Shifting(KERNEL, 0.6, 3.0, 1.0),
    ))  # fmt: skip
    assert parameters(rates) == [1.5, 125e3, 0.1, 30.0, 0.6, 3.0, 1.0]  # the kernel is the same in all
    without = Rates((PressureForce(KERNEL, NONE, "products"), *rates.parts[1:]))
    assert kind(without) != kind(rates)
    assert len(parameters(without)) == len(parameters(rates)) - 1


def test_equal_parts_share_their_numbers_and_what_is_computed_from_them() -> None:
    shapes = (("volume", 0.0),)
    shared = Together(1.0, (Scaled(1.0, WendlandC2(1.5)), Scaled(2.0, WendlandC2(1.5))))
    apart = Together(1.0, (Scaled(1.0, WendlandC2(1.5)), Scaled(2.0, WendlandC2(1.6))))
    assert kind(shared) != kind(apart)
    assert (parameters(shared), parameters(apart)) == ([1.0, 1.0, 1.5, 2.0, 7.0], [1.0, 1.0, 1.5, 2.0, 1.6, 7.0])
    copy = with_symbols(shared, count().__next__)
    assert copy.parts[0].kernel is copy.parts[1].kernel
    one, other = traced(shared, 2, shapes), traced(apart, 2, shapes)
    assert (one.parameter_count, other.parameter_count) == (5, 6)
    assert len(one.pair_lines) < len(other.pair_lines) - 5  # the kernel's


def test_equal_and_opposite_numbers_are_summed_up_once() -> None:
    """And come out as if each had been."""
    places = jittered((6, 6), 0.3, seed=0)
    neighbours = Particles.read(places, kernel=CubicSpline(1.6), volumes=1.0).neighbours
    known = {"volume": np.full(len(places), 1.0)}
    once, signs = Signs(KERNEL, (1,)), Signs(KERNEL, (1, -1, 0, 1))
    assert len(traced(signs, 2, (("volume", 0.0),)).pair_outputs) == 1
    total = run(Operation((once,)), neighbours, known).values
    assert (total > 0.0).any()
    np.testing.assert_array_equal(
        run(Operation((signs,)), neighbours, known).values, total * np.array([1.0, -1.0, 0.0, 1.0])
    )
