"""Operators where input is unusual: masked, turned, scaled, far, forked, sparse or far too dense."""

from __future__ import annotations

import os
import signal
from decimal import Decimal
from itertools import product
from typing import Any

import numpy as np
import pytest
from scipy.sparse import csr_array

from sphear import CubicSpline, Domain, Neighbours, Particles, SphearError, gradient, interpolate, laplacian
from sphear.engine.threads import thread_count
from sphear.errors import SphearWarning, TooFewNeighboursError
from sphear.operators.spacing import spacing_of
from tests.particles import Array, jittered, lattice

DX = 0.05
X = lattice((12, 12), DX)
F = (X**2).sum(axis=1)
MASKED = np.ma.MaskedArray(F, np.arange(len(F)) == 7)


class Quantity(np.ndarray[Any, Any]):
    """An array with a unit, as of unyt or astropy."""

    unit = "mm"


class Series:
    """A column with an index, as of pandas."""

    def __init__(self, values: Array, index: Array) -> None:
        self.values, self.index, self.iloc = values, index, None

    def __array__(self, dtype: Any = None, copy: Any = None) -> Array:
        return self.values

    def __len__(self) -> int:
        return len(self.values)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        (MASKED, "1 of its 144 values are masked"),
        ([MASKED], "values are masked"),
        (F.view(Quantity), "it has the unit 'mm'"),
        (Series(F, np.arange(144)[::-1]), "it has an index"),
        (F + 0j, "an array of real numbers"),
        (np.full(144, np.datetime64("2020-01-01")), "an array of real numbers"),
        (csr_array(F[None]), "an array of real numbers"),
        (np.full(144, "1", object), "an array of real numbers"),
        ([10**400] * 144, "too large for floating point"),
    ],
)
def test_values_whose_meaning_would_be_lost_are_refused(values: Any, message: str) -> None:
    with pytest.raises(SphearError, match=message):
        laplacian(X, values, spacing=DX)


def test_masks_are_refused_wherever_arrays_come_in() -> None:
    masked = np.ma.MaskedArray(X, X > 0.55)
    calls = [
        lambda: laplacian(masked, F, spacing=DX),
        lambda: laplacian(X, F, spacing=DX, volumes=MASKED),
        lambda: interpolate(X, F, at=masked, spacing=DX),
        lambda: Neighbours(masked, 0.1),
    ]
    for call in calls:
        with pytest.raises(SphearError, match="are masked"):
            call()


def test_what_loses_nothing_is_taken() -> None:
    expected = laplacian(X, F, spacing=DX)
    given: list[Any] = [np.ma.MaskedArray(F), Series(F, np.arange(144)), [Decimal(float(x)) for x in F]]
    for values in given:
        np.testing.assert_array_equal(laplacian(X, values, spacing=DX), expected)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="forks are of POSIX")
def test_a_forked_child_has_threads_of_its_own() -> None:
    expected = laplacian(X, F, spacing=DX, threads=2)
    child = os.fork()
    if child == 0:
        signal.alarm(60)
        os._exit(0 if (laplacian(X, F, spacing=DX, threads=2) == expected).all() else 1)
    assert os.waitpid(child, 0)[1] == 0


@pytest.mark.parametrize("far", [(1e4, 1e4), (-1e4, 0.3), (1e9, -1e9)])
def test_one_stray_particle_costs_nothing_and_changes_nothing(far: tuple[float, float]) -> None:
    expected = laplacian(X, F, spacing=DX, volumes=DX**2)
    with pytest.warns(SphearWarning, match="1 of 145 particles have no neighbour .* particle 144 at"):
        found = laplacian(np.concatenate((X, [far])), np.append(F, 0.0), spacing=DX, volumes=DX**2)
    np.testing.assert_allclose(found[:-1], expected, rtol=1e-12, atol=1e-10)


def test_particles_along_a_diagonal_are_folded_apart() -> None:
    k = np.arange(3000.0)
    line = np.stack((k, k), axis=1)
    assert Neighbours(line, 3.0).pairs == 2 * (2 * 3000 - 3)
    assert len(Neighbours(line, 3.0)._cells.start) < 9 * 3000 + 1000


def test_points_of_evaluation_are_not_listed_as_each_others_neighbours() -> None:
    at = np.repeat(X, 50, axis=0)
    neighbours = Neighbours(X, 0.1, at=at)
    assert neighbours.pairs == 50 * (Neighbours(X, 0.1).pairs + len(X))


@pytest.mark.parametrize("arguments", [{"h_over_dx": 1e9}, {"spacing": 1e3}, {"spacing": 1e9}])
def test_images_and_pairs_beyond_memory_are_refused_with_numbers(arguments: Any) -> None:
    with pytest.raises(SphearError, match=r"\d.* take a smaller h, spacing or volumes$"):
        laplacian(X, F, domain=Domain((0, 0), (0.6, 0.6)), **arguments)


def test_a_thousand_million_threads_are_refused() -> None:
    with pytest.raises(SphearError, match="threads must be at most 1024, not 1000000000"):
        thread_count(10**9, 100)


@pytest.mark.parametrize("arguments", [{"spacing": DX / 100}, {"h_over_dx": 1e-9}])
def test_particles_without_any_neighbours_are_refused(arguments: Any) -> None:
    with pytest.raises(SphearError, match="144 of 144 particles have no neighbour within the support"):
        laplacian(X, F, **arguments)


def test_volumes_that_are_not_those_of_the_particles_are_told_of() -> None:
    with pytest.warns(SphearWarning, match="the kernel sums to about .* hardly those of these particles"):
        laplacian(X, F, spacing=DX, volumes=1.0)


def turned(x: Array, degrees: float) -> Array:
    a = np.radians(degrees)
    return np.asarray(x @ np.array(((np.cos(a), np.sin(a)), (-np.sin(a), np.cos(a)))))


BIG = lattice((40, 40), DX)
RADII = np.hypot(*(BIG - 1.0).T)


@pytest.mark.parametrize("degrees", [0.0, 15.0, 45.0])
@pytest.mark.parametrize(
    "positions",
    [BIG, lattice((100, 8), DX), BIG[(RADII < 0.95) & (RADII > 0.5)], BIG[(BIG < 0.4).any(axis=1)],
     np.concatenate((BIG, [[1e4, -1e3]])), lattice((9, 1), DX)],
    ids=["square", "strip", "ring", "angle", "stray", "row"],
)  # fmt: skip
def test_the_spacing_of_a_lattice_is_told_however_it_is_turned(positions: Array, degrees: float) -> None:
    assert spacing_of(turned(positions, degrees)) == pytest.approx(DX, rel=1e-6)


@pytest.mark.parametrize("counts", [(200,), (30, 30), (11, 11, 11)])
def test_the_spacing_of_disordered_particles_is_nearly_right(counts: tuple[int, ...]) -> None:
    assert spacing_of(jittered(counts, 0.5, seed=3, dx=DX)) == pytest.approx(DX, rel=0.03)


# any unit, any precision, against plain sums over images


def by_images(x: Array, f: Array, h: float, volume: float, periods: Array) -> tuple[Array, Array, Array]:
    """Morris's Laplacian, the gradient and the interpolated field, by sums over all images."""
    d, kernel = x.shape[1], CubicSpline(h)
    steps = [range(-1, 2) if np.isfinite(period) else range(1) for period in periods]
    total = np.zeros(len(x)), np.zeros_like(x), np.zeros(len(x))
    for shift in product(*steps):
        r = x[:, None] - x[None] - np.where(np.isfinite(periods), periods, 0.0) * np.array(shift)
        r2 = (r**2).sum(axis=-1)
        factor = np.where(r2 > 0, kernel.gradient_factor(np.where(r2 > 0, r2, h * h), d), 0.0)
        difference = f[None] - f[:, None]
        total[0][:] += (-2.0 * volume * factor * difference).sum(axis=1)
        total[1][:] += (volume * (factor * difference)[..., None] * r).sum(axis=1)
        weight = np.where(r2 > 0, kernel.value(np.where(r2 > 0, r2, h * h), d), kernel.value_at_zero(d))
        total[2][:] += (volume * f[None] * weight).sum(axis=1)
    return total


@pytest.mark.parametrize("unit", [1e-9, 1.0, 1e9])
@pytest.mark.parametrize("precision", ["float64", "float32"])
@pytest.mark.parametrize("counts", [(30,), (9, 9), (5, 5, 5)])
def test_sums_are_those_over_images_in_any_unit(counts: tuple[int, ...], precision: str, unit: float) -> None:
    d = len(counts)
    offset = 1e7
    x = jittered(counts, 0.4, seed=d) * unit + 3.0 * unit
    f = offset + np.random.default_rng(d).random(len(x))
    lower, upper = np.full(d, 3.0 * unit), (np.array(counts) + 3.0) * unit
    periodic = (True, False, True)[:d]
    domain = Domain(tuple(lower), tuple(upper), periodic)
    h, volume = 1.1 * unit, unit**d
    exact = by_images(x, f, h, volume, np.where(periodic, upper - lower, np.inf))
    known: Any = {"kernel": CubicSpline(h), "volumes": volume, "domain": domain, "precision": precision}
    found = laplacian(x, f, viscosity="morris", **known), gradient(x, f, **known), interpolate(x, f, **known)
    for a, b in zip(found, exact, strict=True):
        assert a.dtype == precision
        scale = np.abs(b).max()
        np.testing.assert_allclose(a / scale, b / scale, rtol=0, atol=1e-8 if precision == "float64" else 1e-4)


@pytest.mark.parametrize("unit", [1e-98, 1e98])
def test_lengths_at_the_ends_of_floating_point(unit: float) -> None:
    expected = laplacian(X, F, spacing=DX)
    np.testing.assert_allclose(laplacian(X * unit, F, spacing=DX * unit) * unit**2, expected, rtol=1e-9, atol=1e-9)


def test_results_that_single_precision_cannot_hold_are_refused() -> None:
    with pytest.raises(SphearError, match="cannot be held in float32 numbers: take other units, or precision float64"):
        laplacian(X * 1e-25, F, spacing=DX * 1e-25, precision="float32")


def test_a_support_beyond_floating_point_is_refused() -> None:
    with pytest.raises(SphearError, match="the support must be between"):
        laplacian(X * 1e-150, F, spacing=DX * 1e-150)


# moving least squares


@pytest.mark.parametrize("counts", [(30,), (14, 14), (7, 7, 7)])
def test_planes_are_exact_for_linear_fields_up_to_the_edges(counts: tuple[int, ...]) -> None:
    x = jittered(counts, 0.5, seed=1, dx=DX)
    slope = np.arange(1.0, len(counts) + 1.0)
    at = np.array(counts) * DX * np.random.default_rng(2).random((300, len(counts)))
    found = interpolate(x, 3.0 + x @ slope, at=at, spacing=DX, correction="moving_least_squares")
    np.testing.assert_allclose(found, 3.0 + at @ slope, rtol=0, atol=1e-12)


def test_planes_are_of_second_order_for_smooth_fields() -> None:
    errors = []
    for n in (20, 40):
        x, at = jittered((n, n), 0.4, seed=5, dx=1 / n), np.random.default_rng(1).random((400, 2))
        found = interpolate(x, np.sin(3 * x[:, 0] + x[:, 1]), at=at, spacing=1 / n, correction="mls")
        errors.append(np.sqrt(np.mean((found - np.sin(3 * at[:, 0] + at[:, 1])) ** 2)))
    assert np.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.25)


def test_points_with_too_few_particles_for_a_plane() -> None:
    x = np.concatenate((X, [[3.0, 3.0], [3.05, 3.0]]))
    field, at = 1.0 + x @ np.array([1.0, 2.0]), np.array([[0.3, 0.3], [3.02, 3.0], [9.0, 9.0]])
    with pytest.raises(TooFewNeighboursError, match=r"1 of 3 points have too few .*the first is point 1 at"):
        interpolate(x, field, at=at, spacing=DX, correction="linear")
    found = interpolate(x, field, at=at, spacing=DX, correction="linear", fallback="nan")
    np.testing.assert_allclose(found, [1.9, np.nan, np.nan], atol=1e-12)


def test_planes_have_no_derivatives() -> None:
    with pytest.raises(SphearError, match="is of values only, for interpolate"):
        gradient(X, F, spacing=DX, correction="moving_least_squares")


def test_the_support_no_longer_depends_on_the_axes() -> None:
    strip = lattice((60, 6), DX)
    radii = [Particles.read(turned(strip, degrees)).kernel.radius for degrees in (0.0, 45.0)]
    assert radii[0] == pytest.approx(radii[1])
