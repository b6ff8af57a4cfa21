"""Velocities from a stream function or vector potential: free of divergence, and their exact Laplacian."""

from __future__ import annotations

import numpy as np
import pytest
import sympy

from sphear.cases.fields import field
from sphear.cases.stream import stream_velocity

NAMES = ("quartic", "sine", "gaussian", "polynomial-5", "sin(3*x)*exp(y) + x*y**3")
SYMBOLS = sympy.symbols("x y z")


def points(dimension: int) -> np.ndarray:
    return np.random.default_rng(dimension).uniform(0.05, 0.95, (40, dimension))


def curl(potential: sympy.Expr, dimension: int) -> list[sympy.Expr]:
    """By the Levi-Civita symbol, of (0, 0, f) in the plane and of (f, f, f) in space."""
    f = [0, 0, potential] if dimension == 2 else [potential] * 3
    return [
        sum(sympy.LeviCivita(a, b, c) * sympy.diff(f[c], SYMBOLS[b]) for b in range(3) for c in range(3))
        for a in range(dimension)
    ]


def values(expressions: list[sympy.Expr], at: np.ndarray) -> np.ndarray:
    symbols = SYMBOLS[: at.shape[1]]
    columns = [sympy.lambdify(symbols, e, modules="numpy")(*at.T) for e in expressions]
    return np.stack([np.broadcast_to(column, len(at)) for column in columns], axis=1)


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("name", NAMES)
def test_the_velocity_is_the_curl(name: str, dimension: int) -> None:
    known, at = field(name, dimension), points(dimension)
    expected = values(curl(sympy.sympify(known.text), dimension), at)
    np.testing.assert_allclose(stream_velocity(known, at, at)[0], expected, rtol=1e-10, atol=1e-9)


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("name", NAMES)
def test_the_laplacian_is_that_of_each_component(name: str, dimension: int) -> None:
    known, at = field(name, dimension), points(dimension)
    velocity = curl(sympy.sympify(known.text), dimension)
    expected = values([sum(u.diff(s, 2) for s in SYMBOLS[:dimension]) for u in velocity], at)
    np.testing.assert_allclose(stream_velocity(known, at, at)[1], expected, rtol=1e-9, atol=1e-7)


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("name", NAMES[1:])  # in the first each velocity depends on the other coordinates only
def test_the_velocity_has_no_divergence(name: str, dimension: int) -> None:
    known, at, step = field(name, dimension), points(dimension), 1e-4

    def derivative(axis: int) -> np.ndarray:
        shift = step * np.eye(dimension)[axis]
        ahead, behind = (stream_velocity(known, at + sign * shift, at)[0] for sign in (1, -1))
        return np.asarray((ahead - behind)[:, axis] / (2 * step))

    parts = np.stack([derivative(axis) for axis in range(dimension)])
    assert np.abs(parts).max() > 0.1  # there is something to cancel
    assert np.abs(parts.sum(axis=0)).max() < 1e-5 * np.abs(parts).max()


def test_velocity_and_laplacian_are_given_where_they_are_asked_for() -> None:
    known, at = field("sine", 2), points(2)
    velocity, laplacian = stream_velocity(known, at, at[3:8])
    assert velocity.shape == (40, 2)
    np.testing.assert_array_equal(laplacian, stream_velocity(known, at, at)[1][3:8])
