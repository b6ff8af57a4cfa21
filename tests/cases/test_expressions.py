"""The language of scalar fields: its derivatives against SymPy and finite differences, and what it refuses."""

from __future__ import annotations

import math

import mpmath  # type: ignore[import-untyped]
import numpy as np
import pytest
import sympy
from hypothesis import HealthCheck, given, reject, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from sphear.cases.expressions import BLOCK, COORDINATES, FUNCTIONS, MAX_DEPTH, MAX_LENGTH, Expression
from sphear.cases.nodes import Node
from sphear.errors import SphearError

pytestmark = pytest.mark.filterwarnings("error")
deterministic = settings(
    derandomize=True, deadline=None, database=None, suppress_health_check=[HealthCheck.filter_too_much]
)

LEAVES = st.sampled_from(["x", "y", "z", "1", "2", "3", "0.5", "1.25", "pi", "e"])
TEXTS = st.recursive(
    LEAVES,
    lambda inner: st.one_of(
        st.tuples(inner, st.sampled_from("+-*/"), inner).map(lambda t: f"({t[0]}){t[1]}({t[2]})"),
        st.tuples(inner, st.sampled_from(["2", "3", "-1", "0.5", "y", "x*z"])).map(lambda t: f"({t[0]})**({t[1]})"),
        st.tuples(st.sampled_from(sorted(FUNCTIONS)), inner).map(lambda t: f"{t[0]}({t[1]})"),
        inner.map(lambda t: f"-({t})"),
    ),
    max_leaves=8,
)
POINTS = st.tuples(*[st.integers(-96, 96).map(lambda n: n / 64.0)] * 3)


def exact(text: str) -> sympy.Expr:
    """What SymPy makes of a text."""
    return sympy.sympify(text.replace("arctan", "atan"), locals={"e": sympy.E})


def exact_value(expression: sympy.Expr, point: tuple[float, ...]) -> complex:
    """A SymPy expression at a point, computed with 40 digits."""
    symbols = [sympy.Symbol(name) for name in COORDINATES]
    with mpmath.workdps(40):
        return complex(sympy.lambdify(symbols, expression, modules="mpmath")(*map(mpmath.mpf, point)))


def magnitude(root: Node, point: tuple[float, ...]) -> float:
    """The largest number met while a node is evaluated, to which its rounding errors are in proportion."""
    coordinates = {name: np.array([value]) for name, value in zip(COORDINATES, point, strict=False)}

    def visit(node: Node, inner: list[float]) -> float:
        return max(abs(float(node.evaluate(coordinates)[0])), *inner, 0.0)

    return root.fold(visit)


@given(TEXTS, POINTS)
@settings(deterministic, max_examples=600)
def test_derivatives_are_those_of_sympy(text: str, point: tuple[float, float, float]) -> None:
    try:
        expression = Expression.parse(text, 3)
        ours = [expression, *expression.gradient(), expression.laplacian()]
        values = [derivative([point])[0] for derivative in ours]
        sizes = [magnitude(derivative.root, point) for derivative in ours]
    except SphearError:
        reject()  # undefined at this point
    if max(sizes) > 1e5:
        reject()  # too badly conditioned for a comparison in double precision
    f, symbols = exact(text), sympy.symbols("x y z")
    theirs = [f, *(f.diff(s) for s in symbols), sum(f.diff(s, 2) for s in symbols)]
    for value, size, derivative in zip(values, sizes, theirs, strict=True):
        assert abs(value - exact_value(derivative, point)) <= 1e-9 * max(size, 1.0)


@pytest.mark.parametrize("name", sorted(FUNCTIONS))
@pytest.mark.parametrize("argument", ["x", "x*y + 0.5", "x/(1 + y**2)", "x**y"])
def test_each_function_against_finite_differences(name: str, argument: str) -> None:
    expression = Expression.parse(f"{name}({argument})", 2)
    points = np.random.default_rng(1).uniform(0.3, 1.1, (50, 2))
    h = 1e-4
    steps = h * np.eye(2)
    ahead = np.array([expression(points + step) for step in steps])
    behind = np.array([expression(points - step) for step in steps])
    for derivative, difference in zip(expression.gradient(), (ahead - behind) / (2.0 * h), strict=True):
        np.testing.assert_allclose(derivative(points), difference, rtol=1e-4, atol=1e-5)
    second = (ahead + behind - 2.0 * expression(points)).sum(axis=0) / h**2
    np.testing.assert_allclose(expression.laplacian()(points), second, rtol=1e-4, atol=1e-5)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("sin(2*pi*x)*exp(-y**2)", lambda x, y: np.sin(2.0 * np.pi * x) * np.exp(-(y**2))),
        ("-x**2", lambda x, y: -(x**2)),
        ("2**-x", lambda x, y: 2.0**-x),
        ("x**2**3", lambda x, y: x**8),
        ("x - y - 1", lambda x, y: x - y - 1.0),
        ("x/y/2", lambda x, y: x / y / 2.0),
        ("x/(y/2)", lambda x, y: x / (y / 2.0)),
        (" +x ", lambda x, y: x),
        ("arctan(x) - atan(y)", lambda x, y: np.arctan(x) - np.arctan(y)),
        ("1.5e-1*x + .5 + 1.", lambda x, y: 0.15 * x + 1.5),
        ("e**x", lambda x, y: np.exp(x)),
        ("7", lambda x, y: 7.0 + 0.0 * x),
    ],
)
def test_values(text: str, expected: object) -> None:
    points = np.random.default_rng(2).uniform(0.1, 2.0, (20, 2))
    assert callable(expected)
    np.testing.assert_allclose(Expression.parse(text, 2)(points), expected(*points.T), rtol=1e-14)


@pytest.mark.parametrize(
    ("text", "derivative"),
    [
        ("x**4", "4*x**3"),
        ("3 + y", "0"),
        ("x", "1"),
        ("2*(3*x)", "6"),
        ("x/y", "1/y"),
        ("cos(2*x)", "-2*sin(2*x)"),
        ("y - (x - 1)**2", "-2*(x - 1)"),
        ("1 - y**x", "-(y**x*log(y))"),
        ("x**2 - x**3", "2*x - 3*x**2"),
    ],
)
def test_derivatives_are_simplified(text: str, derivative: str) -> None:
    assert str(Expression.parse(text, 2).derivative("x")) == derivative


@given(TEXTS, POINTS)
@settings(deterministic, max_examples=600)
def test_what_is_written_is_read_back_the_same(text: str, point: tuple[float, float, float]) -> None:
    try:
        parsed = Expression.parse(text, 3)
    except SphearError:
        reject()
    for expression in (parsed, parsed.derivative("x")):
        try:
            value = expression([point])
        except SphearError:
            continue
        written = str(expression)
        if len(written) <= MAX_LENGTH:
            again = Expression.parse(written, 3)
            assert str(again) == written
            np.testing.assert_array_equal(again([point]), value)


@pytest.mark.parametrize(
    "text",
    [
        "x - y - 1",
        "x - (y - 1)",
        "x/(y/2)*3",
        "x**y**2",
        "(x**y)**2",
        "(-x)**2",
        "-x**2",
        "2**(-x)",
        "(x + y)*(x - y)",
        "atan(-x)",
    ],
)
def test_parentheses_are_written_where_they_are_needed(text: str) -> None:
    assert str(Expression.parse(text, 2)) == text


def test_many_positions_are_evaluated_as_few() -> None:
    expression = Expression.parse("x**3*y + 2", 2)
    points = np.random.default_rng(3).uniform(-1.0, 1.0, (2 * BLOCK + 7, 2))
    np.testing.assert_allclose(expression(points), points[:, 0] ** 3 * points[:, 1] + 2.0, rtol=1e-14)
    assert expression(np.empty((0, 2))).shape == (0,)
    assert expression(points[::-1]).flags.owndata


def test_the_deepest_expression_can_be_used() -> None:
    for text in ("*".join(["x"] * MAX_DEPTH), "sin(" * (MAX_DEPTH - 1) + "x" + ")" * (MAX_DEPTH - 1)):
        expression = Expression.parse(text, 1)
        assert np.isfinite(expression.laplacian()([[0.9]])).all()
        assert len(repr(expression)) > MAX_DEPTH
        with pytest.raises(SphearError, match="nested"):
            Expression.parse(f"1 + {text} + 1", 1)


HOSTILE = {
    "": "nothing",
    "   ": "nothing",
    "__import__('os')": "__import__",
    "__import__": "__import__",
    "x.__class__": "__class__",
    "x.real": "real",
    "().x": "x",
    "()": "()",
    "lambda x: x": ":",
    "lambda": "lambda",
    "[x]": "[",
    "{x}": "{",
    '"a"': '"',
    "'a'": "'",
    "f'{x}'": "'",
    "f(x)": "f(x)",
    "x[0]": "[",
    "x, y": ",",
    "(x := 1)": ":",
    "x = 1": "=",
    "x < y": "<",
    "x == y": "=",
    "x if y else z": "x if y else z",
    "x and y": "x and y",
    "not x": "not x",
    "x^2": "a power is written **",
    "x // 2": "x // 2",
    "x % 2": "%",
    "x @ y": "@",
    "~x": "~",
    "x | y": "|",
    "1j": "1j",
    "2x": "a product with *",
    "2(x)": "2(x)",
    "x(y)": "a product is written with *",
    "0x10": "0x10",
    "1_000": "1_000",
    "1if x else y": "1if",
    "nan": "nan",
    "inf": "inf",
    "1e999": "1e999",
    "None": "None",
    "True": "True",
    "...": "...",
    "await x": "await",
    "sin": "one argument",
    "sin()": "one argument",
    "sin(x, y)": ",",
    "sin(*x)": "*x",
    "sin(**x)": "sin(**x)",
    "sin(x)(y)": "sin(x)(y)",
    "abs(x)": "abs(x)",
    "sqr(x)": "did you mean sqrt?",
    "Sin(x)": "did you mean sin?",
    "(x": "something is wrong at character 1",
    "x)": "something is wrong at character 2",
    "x +": "something is wrong at character",
    "x y": "something is wrong",
    "x\n+ y": "\\n",
    "x # y": "#",
    "x; y": ";",
    "x\x00": "\\x00",
    "\u0445": "\\u0445",  # a Cyrillic x
    "\uff53in(x)": "\\uff53",  # a full-width s, which Python itself would read as an s
    "x\u00b2": "\\xb2",  # a superscript 2
    "x \u2212 y": "\\u2212",  # a typographic minus
    "x\u200b": "\\u200b",  # a space of no width
    "9**9**9": "not a finite real number",
    "-9**9**9**9": "not a finite real number",
    "1e308*10": "not a finite real number",
    "1/0": "not a finite real number",
    "x + log(-1)": "not a finite real number",
    "(-8)**(1/3)": "not a finite real number",
    "9" * 400: "too large",
    "x" * (MAX_LENGTH + 1): "more than",
    "+".join(["x"] * (MAX_DEPTH + 1)): "nested",
    "x**" * 1000 + "x": "nested",
    "-" * (MAX_LENGTH - 1) + "x": "",
    "(" * 1000 + "x" + ")" * 1000: "",
    "(" * 1900 + "x": "",
    "sin(" * 180 + "x" + ")" * 180: "nested",
}


@pytest.mark.parametrize(("text", "named"), HOSTILE.items(), ids=[ascii(text[:20]) for text in HOSTILE])
def test_anything_else_is_refused_in_one_sentence(text: str, named: str) -> None:
    with pytest.raises(SphearError) as refusal:
        Expression.parse(text, 3)
    message = str(refusal.value)
    assert named in message
    assert message.isascii()
    assert message.isprintable()
    assert not message.endswith(".")
    assert ". " not in message
    assert len(message) < 500
    assert "not a finite real number" in message or "functions sin, cos, tan, exp, log, sqrt" in message


@given(st.one_of(st.text(), st.text("xyzpie0123456789.+-*/() sincolgqrt", max_size=30)))
@settings(deterministic, max_examples=500)
def test_any_text_is_an_expression_or_refused(text: str) -> None:
    try:
        values = Expression.parse(text, 3).laplacian()([[0.3, 0.5, 0.7]])
    except SphearError:
        return
    assert np.isfinite(values).all()


def test_coordinates_are_those_of_the_dimension() -> None:
    with pytest.raises(SphearError, match=r"'y' is not understood.*not so many dimensions.*names x, pi, e,"):
        Expression.parse("x*y", 1)
    with pytest.raises(SphearError, match="names x, y, pi, e,"):
        Expression.parse("x*z", 2)
    with pytest.raises(SphearError, match="dimension 1, 2 or 3, not 4"):
        Expression.parse("x", 4)
    with pytest.raises(SphearError, match="no derivative by 'z' in 2-D, only by x, y"):
        Expression.parse("x", 2).derivative("z")


@pytest.mark.parametrize(
    ("text", "point", "message"),
    [
        ("log(x - 1)", (0.5, 0.25), r"log\(x - 1\) has no finite real value at x = 0.5, y = 0.25"),
        ("y/x", (0.0, -2.0), "y/x has no finite real value at x = 0, y = -2"),
        ("sqrt(x) + y", (-1.0, 0.0), r"sqrt\(x\) has no .* x = -1"),
        ("x**0.5", (-1.0, 0.0), r"x\*\*0.5 has no .* x = -1"),
        ("x**-1", (0.0, 0.0), r"x\*\*\(-1\) has no .* x = 0"),
        ("exp(x)", (1e3, 0.0), r"exp\(x\) has no .* x = 1000"),
        ("1/(1/x)", (0.0, 0.0), "1/x has no .* x = 0"),
        ("atan(1/x)", (0.0, 0.0), "1/x has no .* x = 0"),
        ("0*log(x)", (-1.0, 0.0), r"log\(x\) has no .* x = -1"),
        ("x", (math.nan, 0.0), "x has no .* x = nan"),
        ("sin(" * 20 + "1/x" + ")" * 20 + "*log(x)", (-1.0, 0.0), r"log\(x\) has no .* x = -1"),
        ("log(" + "+".join(["x"] * 40) + ")", (-1.0, 0.0), r"log\(\.\.\.( \+ x)*\) has no .* x = -1"),
    ],
)
def test_an_undefined_value_is_an_error_with_its_position(text: str, point: NDArray[np.float64], message: str) -> None:
    points = np.full((BLOCK + 10, 2), 1.5)
    points[BLOCK + 5] = point
    with pytest.raises(SphearError, match=message):
        Expression.parse(text, 2)(points)


def test_a_derivative_can_be_undefined_where_the_value_is_not() -> None:
    expression = Expression.parse("sqrt(x)", 1)
    np.testing.assert_array_equal(expression([[0.0]]), [0.0])
    with pytest.raises(SphearError, match="at x = 0"):
        expression.derivative("x")([[0.0]])


@pytest.mark.parametrize("shape", [(2,), (3, 1), (3, 3), (1, 2, 2), ()])
def test_positions_of_another_shape_are_refused(shape: tuple[int, ...]) -> None:
    with pytest.raises(SphearError, match=r"shape \(N, 2\)"):
        Expression.parse("x*y", 2)(np.zeros(shape))
