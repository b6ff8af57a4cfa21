"""The named fields: their derivatives against SymPy, the form of the polynomials, and names that do not exist."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest
import sympy

from sphear.cases.expressions import COORDINATES
from sphear.cases.fields import FIELDS, field
from sphear.errors import SphearError

EXPRESSIONS = ("sin(2*pi*x)*exp(-x**2)", "x/(2 + cos(x))", "sqrt(1 + x**2)*tanh(x)", "(1 + x)**x")


@pytest.mark.parametrize("dimension", [1, 2, 3])
@pytest.mark.parametrize("name", [*FIELDS, *EXPRESSIONS])
def test_value_and_derivatives_are_those_of_sympy(name: str, dimension: int) -> None:
    found = field(name, dimension)
    assert found.name == name
    assert found.dimension == dimension == len(found.gradient)
    symbols = [sympy.Symbol(name) for name in COORDINATES[:dimension]]
    f = sympy.sympify(found.text)
    laplacian = sum((f.diff(s, 2) for s in symbols), sympy.Integer(0))
    points = np.random.default_rng(dimension).uniform(0.0, 1.0, (200, dimension))
    pairs = [(found.value, f), (found.laplacian, laplacian)]
    pairs += [(ours, f.diff(s)) for ours, s in zip(found.gradient, symbols, strict=True)]
    for ours, theirs in pairs:
        expected = np.broadcast_to(sympy.lambdify(symbols, theirs, modules="numpy")(*points.T), len(points))
        np.testing.assert_allclose(ours(points), expected, rtol=1e-10, atol=1e-10 * max(1.0, np.abs(expected).max()))


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_closed_forms(dimension: int) -> None:
    points = np.random.default_rng(4).uniform(0.0, 1.0, (100, dimension))
    sines = np.prod(np.sin(2.0 * np.pi * points), axis=1)
    square = np.sum((points - 0.5) ** 2, axis=1)
    bell = np.exp(-square / (2.0 * 0.15**2))
    expected = {
        "quartic": (np.sum(points**4, axis=1), 12.0 * np.sum(points**2, axis=1)),
        "sine": (sines, -dimension * 4.0 * np.pi**2 * sines),
        "gaussian": (bell, (square / 0.15**4 - dimension / 0.15**2) * bell),
    }
    for name, (value, laplacian) in expected.items():
        found = field(name, dimension)
        np.testing.assert_allclose(found.value(points), value, rtol=1e-12, atol=1e-14)
        np.testing.assert_allclose(found.laplacian(points), laplacian, rtol=1e-11, atol=1e-11)


@pytest.mark.parametrize("dimension", [1, 2, 3])
@pytest.mark.parametrize("degree", range(1, 7))
def test_polynomials_have_every_monomial_with_the_documented_coefficient(degree: int, dimension: int) -> None:
    symbols = [sympy.Symbol(name) for name in COORDINATES[:dimension]]
    terms = sympy.Poly(sympy.sympify(field(f"polynomial-{degree}", dimension).text), *symbols).terms()
    assert len(terms) == math.comb(degree + dimension, dimension)
    assert max(sum(powers) for powers, _ in terms) == degree
    # by degree, and within it x before y before z
    ordered = sorted(terms, key=lambda term: (sum(term[0]), [-power for power in term[0]]))
    golden_ratio = (1.0 + math.sqrt(5.0)) / 2.0
    for k, (_, coefficient) in enumerate(ordered):
        assert float(coefficient) == pytest.approx((-1) ** k * (0.5 + math.modf(k * golden_ratio)[0]), abs=5.1e-4)


def test_a_polynomial_is_the_beginning_of_the_next() -> None:
    for degree in range(1, 6):
        assert field(f"polynomial-{degree + 1}", 3).text.startswith(field(f"polynomial-{degree}", 3).text)


def test_names_and_expressions() -> None:
    assert FIELDS[:3] == ("quartic", "sine", "gaussian")
    assert FIELDS[3:] == tuple(f"polynomial-{n}" for n in range(1, 7))
    assert field("quartic", 2).text == "x**4 + y**4"
    assert field(" Polynomial_2 ", 2).name == "polynomial-2"
    own = field(" x*y ", 2)
    assert (own.name, own.text) == ("x*y", "x*y")
    with pytest.raises(dataclasses.FrozenInstanceError):
        own.name = "other"  # type: ignore[misc]


@pytest.mark.parametrize(
    ("name", "hint"),
    [
        ("quartik", "did you mean quartic?"),
        ("polynomial-7", "did you mean polynomial-6?"),
        ("sine(x)", "did you mean sin?"),
        ("sine + 1", "'sine' is not understood"),
        ("1/0", "1/0 is not a finite real number"),
        ("", "nothing to read"),
    ],
)
def test_what_is_neither_is_refused_with_the_known_fields(name: str, hint: str) -> None:
    with pytest.raises(SphearError) as refusal:
        field(name, 2)
    message = str(refusal.value)
    assert hint in message
    assert f"known fields are {', '.join(FIELDS)}" in message
    assert message.count("did you mean") <= 1
    assert message.isprintable()


@pytest.mark.parametrize("dimension", [-1, 0, 4])
def test_other_dimensions_are_refused(dimension: int) -> None:
    with pytest.raises(SphearError, match="dimension 1, 2 or 3"):
        field("quartic", dimension)
