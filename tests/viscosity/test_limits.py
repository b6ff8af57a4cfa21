"""The continuum limit of every viscous term: lap u, with or without a multiple of grad div u.

On a lattice with many neighbours the sum over particles is the integral, and for a quadratic velocity there is nothing
of higher order that a larger h would bring in.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from sphear import (
    VISCOSITY,
    Cleary,
    EspanolRevenga,
    Gotoh,
    LeastSquares,
    Monaghan,
    Morris,
    Violeau,
    ViscousTerm,
    WendlandC4,
    laplacian,
    viscous_acceleration,
)
from tests.particles import Array, lattice

MU, RHO = 0.7, 1.9

# the multiples of lap u and of grad div u, in d dimensions
LIMITS: dict[str, tuple[ViscousTerm, Any, Any]] = {
    "takeda": (VISCOSITY["takeda"], 1.0, 1 / 3),
    "two_pass": (VISCOSITY["two_pass"], 1.0, 1 / 3),
    "violeau": (Violeau(eta=None), 1.0, 2.0),
    "cleary": (Cleary(eta=None), 1.0, 2.0),
    "cleary, xi = 6": (Cleary(xi=6.0, eta=None), lambda d: 6 / (d + 2), lambda d: 12 / (d + 2)),
    "morris": (Morris(), 1.0, 0.0),
    # all pairs of a lattice come in twos, of which one approaches and one recedes
    "monaghan": (Monaghan(eta=None), 0.5, 1.0),
    "monaghan, receding": (Monaghan(eta=None, receding=True), 1.0, 2.0),
    "gotoh": (Gotoh(), 1.0, 0.0),
    "gotoh, printed": (Gotoh(printed=True), lambda d: -(d + 2) / 2, 0.0),
    "schwaiger": (VISCOSITY["schwaiger"], 1.0, 0.0),
    "oger": (VISCOSITY["oger"], 1.0, 0.0),
    "espanol_revenga": (EspanolRevenga(), 1.0, 1 / 3),
    "espanol_revenga, bulk": (EspanolRevenga(bulk=0.9), 1.0, 0.9 + 1 / 3),
    "fatehi_manzari": (VISCOSITY["fatehi_manzari"], 1.0, 0.0),
    "least_squares": (LeastSquares(), 1.0, 0.0),
    "least_squares_4": (LeastSquares(degree=4), 1.0, 0.0),
}
CASES = [(name, dimension) for name in LIMITS for dimension in (2, 3) if (name, dimension) != ("least_squares_4", 3)]


def around_the_origin(name: str, dimension: int) -> tuple[Array, int, Any]:
    """A lattice that reaches as far as the support of the particle at the origin, or twice as far for two passes.

    More neighbours for terms with (u . r) r: x_a x_b x_c x_d / r^2 is not smooth at r = 0, so that the sum over the
    lattice is off its integral by some (dx/h)^4.
    """
    ratio = {2: 6, 3: 4}[dimension] // (1 if LIMITS[name][0].radial else 2)
    layers = 2 * ratio * (2 if name == "two_pass" else 1)
    positions = lattice((2 * layers + 1,) * dimension, dx=0.1, origin=-layers)
    return positions, len(positions) // 2, {"kernel": WendlandC4(0.1 * ratio), "volumes": 0.1**dimension}


def quadratic(positions: Array) -> tuple[Array, Array, Array]:
    """u_k = x . Q_k x / 2 + linear terms, lap u and grad div u."""
    dimension = positions.shape[1]
    generator = np.random.default_rng(dimension)
    q = generator.uniform(-1.0, 1.0, (dimension,) * 3)
    q += q.transpose(0, 2, 1)
    linear = generator.uniform(-0.1, 0.1, (dimension, dimension))
    u = 0.5 * np.einsum("na,kab,nb->nk", positions, q, positions) + positions @ linear.T
    return np.asarray(u), np.einsum("kaa->k", q), np.einsum("kak->a", q)


def of_dimension(factor: Any, dimension: int) -> Any:
    return factor(dimension) if callable(factor) else factor


@pytest.mark.parametrize(("name", "dimension"), CASES)
def test_the_limit_of_the_acceleration(name: str, dimension: int) -> None:
    term, of_laplacian, of_divergence = LIMITS[name]
    positions, origin, arguments = around_the_origin(name, dimension)
    u, lap_u, grad_div_u = quadratic(positions)
    if name == "monaghan":
        u = 0.5 * (u + u[::-1])  # without its linear part, which would make more than half of the pairs approach
    found = viscous_acceleration(
        positions, u, viscosity=term, dynamic_viscosity=MU, density=RHO, fallback="nan", **arguments
    )
    expected = of_dimension(of_laplacian, dimension) * lap_u + of_dimension(of_divergence, dimension) * grad_div_u
    np.testing.assert_allclose(found[origin] * RHO / MU, expected, atol=1.5e-3 * np.abs(expected).max())


@pytest.mark.parametrize("name", ["takeda", "two_pass", "morris", "gotoh", "schwaiger", "oger", "fatehi_manzari"])
def test_the_limit_of_the_laplacian(name: str) -> None:
    """Of a scalar field every term is lap f, Takeda's and two passes too, which give velocities grad div u as well."""
    positions, origin, arguments = around_the_origin(name, 2)
    u, lap_u, _ = quadratic(positions)
    found = laplacian(positions, u, viscosity=name, fallback="nan", **arguments)[origin]
    np.testing.assert_allclose(found, lap_u, atol=1.5e-3 * np.abs(lap_u).max())
