"""Corrections: what each reproduces exactly, the printed equations, and particles that have too few neighbours."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sphear import (
    CORRECTIONS,
    Morris,
    TooFewNeighboursError,
    WendlandC4,
    gradient,
    interpolate,
    laplacian,
    viscous_acceleration,
)
from sphear.corrections.renormalised import safe_inverse
from sphear.errors import SphearWarning
from tests.particles import Array, all_pairs, jittered, lattice, summed

KERNEL = WendlandC4(1.7)
COUNTS = {2: (9, 8), 3: (6, 5, 5)}

seeds = st.integers(0, 1_000)
dimensions = st.sampled_from([2, 3])
jitters = st.floats(0.0, 0.6)
coefficients = st.tuples(*[st.floats(-10.0, 10.0)] * 4)


def cloud(dimension: int, jitter: float, seed: int) -> tuple[Array, Array]:
    """Particles with edges and holes, and volumes that differ."""
    positions = jittered(COUNTS[dimension], jitter, seed)
    generator = np.random.default_rng(seed)
    kept = positions[generator.random(len(positions)) > 0.1]
    return kept, generator.uniform(0.7, 1.3, len(kept))


def wendland_c4(d: Array) -> tuple[Array, Array, Array]:
    """W, grad W and the second derivatives, by calculus of sigma (1 - s)^6 (35 s^2 + 18 s + 3) with s = r / 2h."""
    r, size = np.linalg.norm(d, axis=1), d.shape[1]
    s = r / (2 * KERNEL.h)
    factor = {2: 9 / (4 * np.pi * KERNEL.h**2), 3: 495 / (256 * np.pi * KERNEL.h**3)}[size] / 3
    w = factor * (1 - s) ** 6 * (35 * s**2 + 18 * s + 3)
    dw = factor * -56 * s * (1 + 5 * s) * (1 - s) ** 5 / (2 * KERNEL.h)
    d2w = factor * 56 * (1 - s) ** 4 * (35 * s**2 - 4 * s - 1) / (2 * KERNEL.h) ** 2
    e = d / r[:, None]
    ee = e[:, :, None] * e[:, None, :]
    return w, dw[:, None] * e, d2w[:, None, None] * ee + (dw / r)[:, None, None] * (np.eye(size) - ee)


def sums(positions: Array, volumes: Array, f: Array) -> dict[str, Array]:
    """<F>, <dF> and <ddF> (Basa's eqs. 1, 2 and 27), the particle itself included."""
    i, j, d = all_pairs(positions, KERNEL.radius)
    n, size = positions.shape
    w, grad, hessian = wendland_c4(d)
    w0 = {2: 9 / (4 * np.pi), 3: 495 / (256 * np.pi)}[size] / KERNEL.h**size
    curvature0 = w0 / 3 * -56 / (2 * KERNEL.h) ** 2
    vf = volumes[j] * f[j]
    return {
        "value": summed(i, vf * w, n) + volumes * f * w0,
        "gradient": summed(i, vf[:, None] * grad, n),
        "hessian": summed(i, vf[:, None, None] * hessian, n) + (volumes * f)[:, None, None] * curvature0 * np.eye(size),
    }


def equation_22(positions: Array, volumes: Array, f: Array) -> Array:
    of_f, of_1 = sums(positions, volumes, f), sums(positions, volumes, np.ones_like(f))
    one, value = of_1["value"][:, None], of_f["value"][:, None]
    return np.asarray((of_f["gradient"] * one - value * of_1["gradient"]) / one**2)


def equation_23(positions: Array, volumes: Array, f: Array) -> Array:
    of_f, of_1 = sums(positions, volumes, f), sums(positions, volumes, np.ones_like(f))
    one, value = of_1["value"][:, None, None], of_f["value"][:, None, None]
    df, d1 = of_f["gradient"], of_1["gradient"]
    mixed = df[:, None, :] * d1[:, :, None] + df[:, :, None] * d1[:, None, :]
    squares = d1[:, :, None] * d1[:, None, :]
    bracket = of_f["hessian"] * one - mixed - value * of_1["hessian"]
    return np.asarray(bracket / one**2 + 2 * value * squares / one**3)


def equations_24_to_26(positions: Array, volumes: Array, f: Array) -> Array:
    i, j, d = all_pairs(positions, KERNEL.radius)
    n, size = positions.shape
    w, grad, _ = wendland_c4(d)
    of_1 = sums(positions, volumes, np.ones(n))
    one, d1 = of_1["value"], of_1["gradient"]
    corrected = grad / one[i, None] - w[:, None] * d1[i] / one[i, None] ** 2
    w0 = {2: 9 / (4 * np.pi), 3: 495 / (256 * np.pi)}[size] / KERNEL.h**size
    itself = -w0 * d1 / one[:, None] ** 2
    moment = summed(i, volumes[j, None, None] * corrected[:, :, None] * positions[j][:, None, :], n)
    moment += volumes[:, None, None] * itself[:, :, None] * positions[:, None, :]
    total = summed(i, (volumes * f)[j, None] * corrected, n) + (volumes * f)[:, None] * itself
    return np.asarray(np.einsum("nab,nb->na", np.linalg.inv(moment), total))


def linear(positions: Array, c: Any) -> Array:
    return np.asarray(c[0] + positions @ np.array(c[1 : 1 + positions.shape[1]]))


@given(dimensions, jitters, seeds, st.floats(0.01, 100.0))
def test_level_0_reproduces_constants(dimension: int, jitter: float, seed: int, constant: float) -> None:
    positions, volumes = cloud(dimension, jitter, seed)
    f = np.full(len(positions), constant)
    points = np.random.default_rng(seed).uniform(1.0, 4.0, (20, dimension))
    for at in (None, points):
        found = interpolate(positions, f, at=at, kernel=KERNEL, volumes=volumes, correction="shepard")
        np.testing.assert_allclose(found, constant, rtol=1e-13)


@pytest.mark.parametrize("correction", ["shepard", "bonet_lok"])
@given(dimensions, jitters, seeds)
def test_derivatives_of_constants_are_zero(correction: str, dimension: int, jitter: float, seed: int) -> None:
    positions, volumes = cloud(dimension, jitter, seed)
    arguments: Any = {"kernel": KERNEL, "volumes": volumes, "correction": correction}
    constant = np.full(len(positions), 3.0)
    assert not gradient(positions, constant, of_differences=False, **arguments).any()
    if correction == "shepard":  # whose second derivatives level 1 takes
        assert not laplacian(positions, constant, viscosity="takeda", **arguments).any()


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("of_differences", [True, False])
def test_the_gradient_of_level_0_is_equation_22(dimension: int, of_differences: bool) -> None:
    positions, volumes = cloud(dimension, 0.5, 1)
    f = np.random.default_rng(2).random(len(positions))
    found = gradient(positions, f, kernel=KERNEL, volumes=volumes, correction="shepard", of_differences=of_differences)
    np.testing.assert_allclose(found, equation_22(positions, volumes, f), atol=1e-12)


@pytest.mark.parametrize(("dimension", "correction"), [(2, "shepard"), (2, "bonet_lok"), (3, "shepard")])
def test_second_derivatives_are_equation_23(dimension: int, correction: str) -> None:
    positions, volumes = cloud(dimension, 0.5, 1)
    arguments: Any = {"kernel": KERNEL, "volumes": volumes, "correction": correction, "viscosity": "takeda"}
    velocity: Any = np.random.default_rng(2).random(positions.shape)
    second = [equation_23(positions, volumes, velocity[:, k]) for k in range(dimension)]
    laplacians = np.stack([np.trace(tensor, axis1=1, axis2=2) for tensor in second], axis=1)
    np.testing.assert_allclose(laplacian(positions, velocity, **arguments), laplacians, atol=1e-12)
    of_divergence: Any = sum(tensor[:, :, k] for k, tensor in enumerate(second))
    found = viscous_acceleration(positions, velocity, **arguments)
    np.testing.assert_allclose(found, laplacians + of_divergence / 3, atol=1e-12)


@pytest.mark.parametrize("dimension", [2, 3])
def test_level_0_differentiates_the_shepard_interpolant(dimension: int) -> None:
    positions, volumes = cloud(dimension, 0.5, 3)
    f = np.random.default_rng(4).random(len(positions))
    arguments: Any = {"kernel": KERNEL, "volumes": volumes, "correction": "shepard"}
    step = 1e-3

    def moved(axis: int, steps: int) -> Any:
        shift = steps * step * np.eye(dimension)[axis]
        return interpolate(positions, f, at=positions + shift, **arguments)

    first = np.stack([(moved(axis, 1) - moved(axis, -1)) / (2 * step) for axis in range(dimension)], axis=1)
    second: Any = sum((moved(axis, 1) - 2 * moved(axis, 0) + moved(axis, -1)) / step**2 for axis in range(dimension))
    np.testing.assert_allclose(gradient(positions, f, **arguments), first, atol=1e-6)
    np.testing.assert_allclose(laplacian(positions, f, viscosity="takeda", **arguments), second, atol=2e-6)


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("of_differences", [True, False])
def test_the_gradient_of_level_1_is_equations_24_to_26(dimension: int, of_differences: bool) -> None:
    positions, volumes = cloud(dimension, 0.5, 1)
    f = np.random.default_rng(2).random(len(positions))
    found = gradient(
        positions, f, kernel=KERNEL, volumes=volumes, correction="bonet_lok", of_differences=of_differences
    )
    np.testing.assert_allclose(found, equations_24_to_26(positions, volumes, f), atol=1e-11)


@pytest.mark.parametrize("correction", ["bonet_lok", "renormalised"])
@given(dimensions, jitters, seeds, coefficients)
def test_gradients_of_linear_fields_are_exact(
    correction: str, dimension: int, jitter: float, seed: int, c: tuple[float, ...]
) -> None:
    positions, volumes = cloud(dimension, jitter, seed)
    found = gradient(positions, linear(positions, c), kernel=KERNEL, volumes=volumes, correction=correction)
    np.testing.assert_allclose(found, np.broadcast_to(c[1 : 1 + dimension], found.shape), atol=1e-10)


def test_level_0_and_no_correction_are_not_exact_for_linear_fields() -> None:
    positions, volumes = cloud(2, 0.5, 0)
    for correction in ("none", "shepard"):
        found = gradient(positions, positions[:, 0], kernel=KERNEL, volumes=volumes, correction=correction)
        assert abs(found[:, 0] - 1.0).max() > 0.1


def test_the_renormalised_gradient_of_values_is_the_matrix_times_the_plain_one() -> None:
    positions, volumes = cloud(2, 0.5, 0)
    f = np.random.default_rng(1).random(len(positions))
    i, j, d = all_pairs(positions, KERNEL.radius)
    grad = volumes[j, None] * wendland_c4(d)[1]
    moment = summed(i, grad[:, :, None] * -d[:, None, :], len(f))
    plain = summed(i, f[j, None] * grad, len(f))
    found = gradient(positions, f, kernel=KERNEL, volumes=volumes, correction="renormalised", of_differences=False)
    np.testing.assert_allclose(found, np.einsum("nab,nb->na", np.linalg.inv(moment), plain), atol=1e-11)


@pytest.mark.parametrize("correction", list(CORRECTIONS))
def test_on_a_lattice_every_correction_tends_to_none(correction: str) -> None:
    positions = lattice((12, 12))
    f = np.sin(0.3 * positions).sum(axis=1)
    inside = (abs(positions - 6.0) < 1.0).all(axis=1)
    plain, found = (gradient(positions, f, kernel=KERNEL, volumes=1.0, correction=c) for c in ("none", correction))
    np.testing.assert_allclose(found[inside], plain[inside], rtol=3e-3)


@pytest.mark.parametrize("correction", list(CORRECTIONS))
def test_the_formulas_work_on_plain_floats(correction: str) -> None:
    """Preparation and corrected kernel of one particle, summed in Python, against the compiled sweep."""
    chosen = CORRECTIONS[correction]
    positions, volumes = cloud(2, 0.5, 5)
    f = np.random.default_rng(1).random(len(positions))
    particle = int(np.argmin(abs(positions - 4.0).sum(axis=1)))
    own = SimpleNamespace(volume=float(volumes[particle]), dimension=2, prepared=None)
    pairs = [
        (SimpleNamespace(volume=float(volumes[j])), tuple(d.tolist()), float(d @ d), float(f[j] - f[particle]))
        for i, j, d in zip(*all_pairs(positions, KERNEL.radius), strict=True)
        if i == particle
    ]
    preparation = chosen.preparation(KERNEL)
    if preparation is not None:
        total: Any = None
        for other, d, r2, _ in pairs:
            total = _plus(total, preparation.pair(own, other, d, r2))
        own.prepared = preparation.finish(own, total)
    by_hand = np.zeros(2)
    for other, d, r2, difference in pairs:
        by_hand += other.volume * difference * np.array(chosen.gradient(KERNEL, own.prepared, d, r2))
        radial = np.dot(d, chosen.gradient(KERNEL, own.prepared, d, r2))
        assert chosen.radial(KERNEL, own.prepared, d, r2) == pytest.approx(radial, abs=1e-14)
    found = gradient(positions, f, kernel=KERNEL, volumes=volumes, correction=correction)
    np.testing.assert_allclose(found[particle], by_hand, atol=1e-13)


def _plus(a: Any, b: Any) -> Any:
    if a is None:
        return b
    return tuple(_plus(x, y) for x, y in zip(a, b, strict=True)) if isinstance(b, tuple) else a + b


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
def test_quality_says_how_unevenly_a_moment_treats_directions_not_how_large_it_is(scale: float) -> None:
    for diagonal, expected in (((1.0, 1.0), 1.0), ((1.0, 3.0), 0.75), ((1.0, 1.0, 4.0), 0.5), ((1.0, 0.0), 0.0)):
        moment = tuple(tuple(scale * x for x in row) for row in np.diag(diagonal).tolist())
        quality, inverse = safe_inverse(moment)
        assert quality == pytest.approx(expected)
        if expected:
            np.testing.assert_allclose(np.array(inverse) @ moment, np.eye(len(diagonal)), atol=1e-12)
        else:
            assert not np.any(inverse)


# six particles in a row have no gradient across it, and the last one has no neighbour at all
ROW = np.column_stack((np.arange(6.0), np.full(6, 20.0)))
LONELY = np.array([[30.0, 30.0]])
TOLD = r"^1 of 56 particles have no neighbour within the support of 3.4, the first is particle 55 at \(30, 30\)$"


def with_deficient() -> tuple[Array, Array]:
    """A good block of particles and the deficient ones, and which these are."""
    positions = np.concatenate((jittered((7, 7), 0.3, seed=3), ROW, LONELY))
    return positions, np.arange(49, 56)


@pytest.mark.parametrize("correction", ["bonet_lok", "renormalised"])
def test_particles_without_enough_neighbours_are_refused_by_name(correction: str) -> None:
    positions, _ = with_deficient()
    with pytest.raises(
        TooFewNeighboursError,
        match=rf"^7 of 56 particles have too few neighbours for correction '{correction}', the first is particle 49 at"
        r" \(0, 20\): take a larger h, or ask for fallback 'uncorrected' or 'nan'$",
    ):
        gradient(positions, positions[:, 0], kernel=KERNEL, volumes=1.0, correction=correction)


@pytest.mark.parametrize("viscosity", ["schwaiger", "oger", "fatehi_manzari", "least_squares"])
def test_terms_with_their_own_correction_refuse_by_their_own_name(viscosity: str) -> None:
    positions, _ = with_deficient()
    with pytest.raises(
        TooFewNeighboursError, match=f"^7 of 56 .* for viscosity '{viscosity}', the first is particle 49"
    ):
        laplacian(positions, positions[:, 0], kernel=KERNEL, volumes=1.0, viscosity=viscosity)


@pytest.mark.parametrize("correction", ["none", "shepard"])
def test_what_needs_no_neighbours_is_computed_without(correction: str) -> None:
    positions, deficient = with_deficient()
    with pytest.warns(SphearWarning, match=TOLD):
        found = gradient(positions, positions, kernel=KERNEL, volumes=1.0, correction=correction)
    assert np.isfinite(found).all()
    assert not found[deficient[-1]].any()


@pytest.mark.parametrize("correction", ["bonet_lok", "renormalised"])
def test_fallbacks_of_a_corrected_gradient(correction: str) -> None:
    positions, deficient = with_deficient()
    f = np.sin(positions)
    arguments: Any = {"kernel": KERNEL, "volumes": 1.0}
    good = np.setdiff1d(np.arange(56), deficient)
    expected = gradient(positions[good], f[good], correction=correction, **arguments)
    with pytest.warns(SphearWarning, match=TOLD):
        uncorrected = gradient(positions, f, **arguments)
    for fallback, substitute in (("nan", np.full((7, 2, 2), np.nan)), ("uncorrected", uncorrected[deficient])):
        found = gradient(positions, f, correction=correction, fallback=fallback, **arguments)  # type: ignore[arg-type]
        np.testing.assert_array_equal(found[deficient], substitute)
        np.testing.assert_allclose(found[good], expected, rtol=1e-12)


@pytest.mark.parametrize("viscosity", ["schwaiger", "oger", "fatehi_manzari", "least_squares"])
def test_fallbacks_of_a_term_with_its_own_correction(viscosity: str) -> None:
    positions, deficient = with_deficient()
    f = np.sin(positions[:, 0])
    arguments: Any = {"kernel": KERNEL, "volumes": 1.0}
    good = np.setdiff1d(np.arange(56), deficient)
    expected = laplacian(positions[good], f[good], viscosity=viscosity, **arguments)
    with pytest.warns(SphearWarning, match=TOLD):
        morris = laplacian(positions, f, viscosity=Morris(), **arguments)
    for fallback, substitute in (("nan", np.full(7, np.nan)), ("uncorrected", morris[deficient])):
        found = laplacian(positions, f, viscosity=viscosity, fallback=fallback, **arguments)  # type: ignore[arg-type]
        np.testing.assert_array_equal(found[deficient], substitute)
        np.testing.assert_allclose(found[good], expected, rtol=1e-9, atol=1e-12)


def test_a_row_of_particles_in_one_dimension_is_not_deficient() -> None:
    positions = np.linspace(0.0, 5.0, 9)[:, None]
    for correction in CORRECTIONS:
        found = gradient(positions, 2.0 * positions, kernel=KERNEL, correction=correction)
        assert np.isfinite(found).all()
        if correction in ("bonet_lok", "renormalised"):
            np.testing.assert_allclose(found, 2.0)
