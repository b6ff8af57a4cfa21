"""The viscous acceleration where the viscosity varies in space, against what it is exactly."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from sphear import VISCOSITY, SphearError, viscous_acceleration
from sphear.viscosity import FatehiManzari, LeastSquares, Monaghan, Oger, Schwaiger, Takeda, with_varying_viscosity
from sphear.viscosity.varying import MeanViscosity

Array = np.ndarray[Any, Any]

COMPONENTWISE = ("gotoh", "morris", "oger", "schwaiger", "fatehi_manzari", "least_squares", "least_squares_3")
IN_FULL = ("violeau", "cleary", "two_pass")
EXACT = ("fatehi_manzari", "least_squares", "least_squares_3", "least_squares_4")


def square(count: int, jitter: float = 0.0) -> Array:
    ticks = (np.arange(count) + 0.5) / count
    places = np.stack(np.meshgrid(ticks, ticks, indexing="ij"), -1).reshape(-1, 2)
    moved: Array = places + jitter / count * (np.random.default_rng(1).random(places.shape) - 0.5)
    return moved


def acceleration(term: Any, x: Array, velocities: Array, mu: Array, **more: Any) -> Array:
    dx = 1 / np.sqrt(len(x))
    return viscous_acceleration(
        x, velocities, viscosity=term, dynamic_viscosity=mu, spacing=dx, volumes=dx * dx, threads=1, fallback="nan",
        **more,
    )  # fmt: skip


def interior(x: Array) -> Any:
    return (np.abs(x - 0.5) < 0.25).all(axis=1)


@pytest.mark.parametrize("term", [*COMPONENTWISE, *IN_FULL, "espanol_revenga", "least_squares_4"])
def test_shear_where_the_viscosity_varies_across_it(term: str) -> None:
    x = square(32)
    u = np.stack((x[:, 1], 0 * x[:, 0]), axis=1)
    found = acceleration(term, x, u, 1 + x[:, 1])[interior(x)]
    assert found[:, 0] == pytest.approx(1.0, abs=0.1)  # d/dy (mu du/dy)
    assert found[:, 1] == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize(
    ("terms", "share"), [(COMPONENTWISE, 0.0), (IN_FULL, 1.0), (("espanol_revenga",), 1 / 6)], ids=str
)
def test_how_much_of_the_transposed_gradient_a_term_has(terms: tuple[str, ...], share: float) -> None:
    x = square(32)
    u = np.stack((x[:, 1], 0 * x[:, 0]), axis=1)
    for term in terms:  # d/dx (mu (du/dy + dv/dx)) is the whole of it
        assert acceleration(term, x, u, 1 + x[:, 0])[interior(x), 1] == pytest.approx(share, abs=0.1), term


@pytest.mark.parametrize("term", EXACT)
def test_consistent_terms_are_exact_for_products_that_are_quadratic_on_any_particles(term: str) -> None:
    x = square(20, jitter=0.5)
    mu, u = 1 + 0.3 * x[:, 0] + x[:, 1], 2 * x[:, 0] - x[:, 1]
    found = acceleration(term, x, np.stack((u, -u), axis=1), mu)[interior(x)]
    assert found == pytest.approx(np.full(found.shape, (-0.4, 0.4)), abs=1e-9)  # grad mu . grad u


@pytest.mark.parametrize(("term", "least", "most"), [("fatehi_manzari", 0.9, 1.6), ("least_squares_3", 1.8, 2.2)])
def test_the_order_of_consistent_terms_where_the_viscosity_varies(term: str, least: float, most: float) -> None:
    errors = []
    for count in (24, 48):
        x = square(count, jitter=0.3)
        mu, (a, b) = np.exp(x.sum(axis=1)), x.T
        u = np.sin(2 * a) * np.cos(b)
        exact = mu * (2 * np.cos(2 * a) * np.cos(b) - np.sin(2 * a) * np.sin(b) - 5 * u)
        found = acceleration(term, x, np.stack((u, u), axis=1), mu)[:, 0]
        errors.append(np.abs(found - exact)[interior(x)].mean())
    assert least < np.log2(errors[0] / errors[1]) < most


def test_a_correction_of_the_kernel_and_the_mean_viscosity_go_together() -> None:
    x = square(32)
    u = np.stack((x[:, 1], 0 * x[:, 0]), axis=1)
    found = acceleration("gotoh", x, u, 1 + x[:, 1], correction="bonet_lok")[interior(x)]
    assert found[:, 0] == pytest.approx(1.0, abs=0.1)


def test_a_viscosity_that_is_constant_but_for_rounding_changes_nothing() -> None:
    x = square(16, jitter=0.3)
    u, mu = np.sin(3 * x), np.full(len(x), 2.0)
    almost = mu.copy()
    almost[::2] *= 1 + 1e-15
    for term in ("fatehi_manzari", "gotoh", "oger"):
        constant, varying = acceleration(term, x, u, mu)[interior(x)], acceleration(term, x, u, almost)[interior(x)]
        assert varying == pytest.approx(constant, rel=1e-10, abs=1e-10)


def test_where_a_fit_is_not_possible_the_term_that_stands_in_knows_of_the_viscosity_too() -> None:
    x = square(24)
    u = np.stack((x[:, 1], 0 * x[:, 0]), axis=1)
    sparse: Any = {"viscosity": "least_squares_4", "dynamic_viscosity": 1 + x[:, 1], "spacing": 1 / 24}
    found = viscous_acceleration(x, u, volumes=1 / 576, h_over_dx=1.05, threads=1, fallback="uncorrected", **sparse)
    assert found[interior(x), 0] == pytest.approx(1.0, abs=0.2)


def test_a_term_of_a_constant_viscosity_is_refused_by_name() -> None:
    x = square(12)
    with pytest.raises(SphearError, match="viscosity 'takeda' is made for a viscosity that is constant"):
        acceleration("takeda", x, 0 * x, 1 + x[:, 1])
    acceleration("takeda", x, 0 * x, np.full(len(x), 2.0))


def test_every_term_that_knows_of_a_viscosity_that_varies_says_what_it_makes_of_it() -> None:
    for name in VISCOSITY:
        term = VISCOSITY[name]
        assert bool(term.where_it_varies) == term.varies_viscosity, name
    assert with_varying_viscosity(Monaghan()) == Monaghan()
    for weights in (FatehiManzari(), LeastSquares(), Oger(), Schwaiger()):
        assert with_varying_viscosity(weights) == MeanViscosity(weights)
    assert "refused" in repr(Takeda())
