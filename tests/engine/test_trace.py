"""Traced code: the same numbers as the formula, nothing more than it needs, and no branches on values."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from sphear import CORRECTIONS, KERNELS, VISCOSITY, Cleary, CubicSpline, Kernel, WendlandC2, algebra
from sphear.corrections.renormalised import safe_inverse
from sphear.engine.formula import Sum, Weights, traced
from sphear.engine.preparation import form_of
from sphear.engine.structure import fill, kind, leaves, parameters, with_symbols
from sphear.engine.trace import Symbol, Trace
from sphear.interactions import ViscousAcceleration

FUNCTIONS = {name: getattr(algebra, name) for name in ("sqrt", "exp", "positive_part", "where_less")}

FORMULAS: dict[str, Callable[..., Any]] = {
    "arithmetic": lambda a, b, c: (a + b - c, 2.0 * a - b / c, (a - 1.0) / 3.0, 1.0 / b - c, -a, 0.0 - b),
    "powers": lambda a, b, c: tuple(x**n for x in (a, b, c) for n in range(-3, 9)),
    "neutral elements": lambda a, b, c: (a + 0.0, 0 + a, a - 0.0, b * 1.0, 1 * b, c * 0.0, 0 / c, b**0, b**1, b / 1.0),
    "functions": lambda a, b, c: (
        algebra.sqrt(a * a + 1.0), algebra.exp(-b * b), algebra.positive_part(a - c), algebra.positive_part(c - a),
        algebra.where_less(a, b, c, 1.0), algebra.where_less(0.5, b, 2.0, a), algebra.where_less(1.0, 2.0, a, b),
    ),
    "constants": lambda a, b, c: (1.0, 2, a, 0.0),
    "determinant": lambda a, b, c: (algebra.determinant(((a, b, c), (b, 2.0, a), (1.0, c, b))),),
    "solution": lambda a, b, c: algebra.solve(((9.0 + a, b, c), (b, 8.0, a), (c, a, 7.0 - b)), (a, b, c)),
    "safe inverse": lambda a, b, c: safe_inverse(((5.0 + a, b), (c, 4.0))),
    "safe inverse of a singular matrix": lambda a, b, c: safe_inverse(((a, b), (a, b))),
}  # fmt: skip


def compute(lines: Iterable[str], outputs: Iterable[Any], inputs: dict[str, float]) -> list[float]:
    """Run straight-line code and read its outputs, which are symbols, names or numbers."""
    known: dict[str, Any] = {**FUNCTIONS, **inputs}
    exec("\n".join(lines), known)
    return [eval(str(x), known) for x in outputs]


@pytest.fixture
def trace() -> Trace:
    return Trace()


@pytest.mark.parametrize("name", FORMULAS)
@pytest.mark.parametrize("values", [(0.7, -1.1, 0.4), (-0.2, 0.5, 1.3), (1.5, 1.4, -0.6)])
def test_traced_code_gives_what_the_formula_gives(trace: Trace, name: str, values: tuple[float, ...]) -> None:
    outputs = list(leaves(FORMULAS[name](*map(trace.input, "abc"))))
    lines, used = trace.code(outputs)
    assert used <= set("abc")
    expected = list(leaves(FORMULAS[name](*values)))
    assert compute(lines, outputs, dict(zip("abc", values, strict=True))) == pytest.approx(
        expected, rel=1e-12, abs=1e-14
    )


@dataclass(frozen=True)
class AllOfAKernel(Weights):
    kernel: Kernel

    def pair(self, own: Any, other: Any, d: Any, r2: Any) -> Any:
        dimension = len(d)
        return (
            self.kernel.value(r2, dimension), self.kernel.gradient(d, r2), self.kernel.hessian(d, r2),
            self.kernel.value_at_zero(dimension), self.kernel.hessian_at_zero(dimension),
        )  # fmt: skip


@pytest.mark.parametrize("dimension", [1, 2, 3])
@pytest.mark.parametrize("name", list(KERNELS))
def test_a_traced_kernel_takes_its_smoothing_length_at_run_time(name: str, dimension: int) -> None:
    code = traced(AllOfAKernel(KERNELS[name](1.0)), dimension, ())
    for h, q in ((0.8, 0.3), (1.7, 1.1), (0.2, 1.9), (1.0, 3.5)):
        d = tuple(h * q * x for x in (0.6, 0.64, 0.48)[:dimension])
        r2 = algebra.dot(d, d)
        inputs = {"p0": h, "r2": r2} | {f"d{axis}": x for axis, x in enumerate(d)}
        expected = list(leaves(AllOfAKernel(KERNELS[name](h)).pair(None, None, d, r2)))
        assert compute(code.pair_lines, code.pair_outputs, inputs) == pytest.approx(expected, rel=1e-11)


def random_like(shapes: tuple[Any, ...], generator: np.random.Generator) -> dict[str, Any]:
    """Positive numbers in the form of each of the named structures."""
    return {name: fill(template, iter(generator.random(1000).tolist())) for name, template in shapes}


def named(prefix: str, values: dict[str, Any]) -> dict[str, float]:
    return {f"{prefix}_{name}_{k}": x for name, value in values.items() for k, x in enumerate(leaves(value))}


@pytest.mark.parametrize("correction", list(CORRECTIONS))
@pytest.mark.parametrize("viscosity", [name for name in VISCOSITY if name != "two_pass"])
def test_a_traced_viscous_term_is_the_term(viscosity: str, correction: str) -> None:
    """The pair formula on floats, in 3-D, against its straight-line code."""
    term, kernel = VISCOSITY[viscosity], WendlandC2(1.3)
    interaction = ViscousAcceleration(term, kernel, CORRECTIONS[correction])
    preparation = term.preparation(kernel, CORRECTIONS[correction])
    shapes = (("volume", 0.0), ("velocity", (0.0,) * 3), ("dynamic_viscosity", 0.0), ("density", 0.0))
    own_only: tuple[Any, ...] = ()
    if preparation is not None:
        own_only = (("prepared", form_of(preparation, 3, traced(preparation, 3, shapes[:1]).result)),)
    code = traced(interaction, 3, shapes, own_only)

    generator = np.random.default_rng(1)
    own, other, coefficients = (random_like(s, generator) for s in (shapes, shapes, own_only))
    d = (0.5, -0.4, 0.7)
    r2 = algebra.dot(d, d)
    inputs = named("own", own) | named("other", other) | named("coefficient", coefficients)
    inputs |= {f"p{k}": x for k, x in enumerate(parameters(interaction))} | {
        "r2": r2,
        "d0": d[0],
        "d1": d[1],
        "d2": d[2],
    }
    particle = SimpleNamespace(**({"prepared": None, "dimension": 3} | own | coefficients))
    total = interaction.pair(particle, SimpleNamespace(**other), d, r2)
    found = compute(code.pair_lines, code.pair_outputs, inputs)
    assert found == pytest.approx(list(leaves(total)), rel=1e-12)
    inputs |= {f"total{k}": x for k, x in enumerate(found)}
    finished = compute(code.finish_lines, code.finish_outputs, inputs)
    assert finished == pytest.approx(list(leaves(interaction.finish(particle, total))), rel=1e-12)


def test_what_no_output_needs_is_left_out(trace: Trace) -> None:
    a, b = trace.input("a"), trace.input("b")
    algebra.sqrt(b) * b
    lines, used = trace.code([a * a])
    assert len(lines) == 1
    assert used == {"a"}


def test_equal_operations_are_recorded_once(trace: Trace) -> None:
    a, b = trace.input("a"), trace.input("b")
    assert a * b is b * a
    assert a + b is b + a
    assert a - b is not b - a
    assert a / b is not b / a
    assert algebra.sqrt(a + b) is algebra.sqrt(b + a)
    lines, _ = trace.code([algebra.sqrt(a * b) + a * b, algebra.sqrt(b * a)])
    assert len(lines) == 3


def test_numbers_are_computed_while_tracing(trace: Trace) -> None:
    a = trace.input("a")
    assert a * 1.0 is a
    assert a + 0 is a
    assert a * 0.0 == 0.0
    lines, _ = trace.code([algebra.identity(2)[0][1] * a + 2.0 * 3.0 * a])
    assert lines == ["t0 = 6.0 * a"]


def test_whole_powers_are_products(trace: Trace) -> None:
    lines, _ = trace.code([trace.input("a") ** 8])
    assert len(lines) == 3


def test_outputs_may_be_inputs_or_numbers(trace: Trace) -> None:
    a = trace.input("a")
    assert trace.code([a, 1.0]) == ([], {"a"})


@pytest.mark.parametrize(
    "branch",
    [bool, lambda a: 1.0 if a < 0.0 else 2.0, lambda a: a >= 1.0, lambda a: max(a, 0.0), lambda a: 0.0 < a < 1.0,
     lambda a: a == 0.0, lambda a: a != 0.0, lambda a: a == "x", abs, lambda a: a in (1.0, 2.0)],
)  # fmt: skip
def test_a_branch_on_a_value_is_refused(trace: Trace, branch: Callable[[Symbol], Any]) -> None:
    with pytest.raises(TypeError):
        branch(trace.input("a"))


@pytest.mark.parametrize("power", [0.5, 2.0, "2"])
def test_powers_that_are_not_whole_are_refused(trace: Trace, power: Any) -> None:
    with pytest.raises(TypeError, match="whole powers only"):
        trace.input("a") ** power


@dataclass(frozen=True)
class Weighted(Sum):
    factor: float
    kernel: Kernel
    power: int
    name: str = "some"

    def pair(self, own: Any, other: Any, d: Any, r2: Any) -> Any:
        return (self.factor * other.mass**self.power * self.kernel.value(r2, len(d)) * own.charge[1],)


def test_floats_are_parameters_and_all_else_is_code() -> None:
    a, b = Weighted(2.0, CubicSpline(0.5), 2), Weighted(3.0, CubicSpline(0.7), 2)
    assert kind(a) == kind(b)
    assert parameters(a) == [2.0, 0.5]
    assert parameters(b) == [3.0, 0.7]
    for different in (Weighted(2.0, WendlandC2(0.5), 2), Weighted(2.0, CubicSpline(0.5), 3)):
        assert kind(different) != kind(a)
    shapes = (("mass", 0.0), ("charge", (0.0, 0.0)))
    assert traced(a, 2, shapes) is traced(b, 2, shapes)
    assert traced(a, 2, shapes) is not traced(a, 3, shapes)


def test_an_optional_float_is_a_parameter_where_it_is_given() -> None:
    assert kind(Cleary(xi=4.24)) == kind(Cleary(xi=5.0))
    assert kind(Cleary(xi=4.24)) != kind(Cleary())
    assert parameters(Cleary(xi=4.24, eta=None)) == [4.24]


def test_symbols_stand_in_for_floats_in_the_order_of_the_parameters() -> None:
    counted = iter(("first", "second"))
    copy = with_symbols(Weighted(2.0, CubicSpline(0.5), 2), lambda: next(counted))
    assert (copy.factor, copy.kernel.h, copy.power, copy.name) == ("first", "second", 2, "some")
    assert isinstance(copy.kernel, CubicSpline)


def test_only_the_fields_a_formula_uses_are_packed() -> None:
    code = traced(Weighted(1.0, CubicSpline(1.0), 1), 2, (("unused", 0.0), ("mass", 0.0), ("charge", (0.0, 0.0))))
    assert code.columns == (("mass", 0),)
    assert code.private == (("charge", 1),)
