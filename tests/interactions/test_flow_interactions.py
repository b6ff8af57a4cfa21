"""Density by summation, and the momentum equation with its pressure reduced, against sums over all pairs."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from sphear import CORRECTIONS, VISCOSITY, CubicSpline, Particles
from sphear.interactions import Momentum, ReducedMomentum, SummationDensity
from sphear.operators.pipeline import Operation, run
from tests.particles import Array, all_pairs, jittered, summed

KERNEL = CubicSpline(1.5)
POSITIONS = jittered((8, 8), 0.4, seed=0)
COUNT = len(POSITIONS)


def fields() -> dict[str, Any]:
    generator = np.random.default_rng(1)
    volumes, density = generator.uniform(0.8, 1.2, COUNT), generator.uniform(0.5, 2.0, COUNT)
    pressure = generator.uniform(-1.0, 3.0, COUNT)
    return {
        "volume": volumes, "density": density, "mass": volumes * density, "velocity": generator.random((COUNT, 2)),
        "dynamic_viscosity": generator.uniform(0.5, 2.0, COUNT), "pressure": pressure,
        "pressure_over_density2": pressure / density**2, "inverse_density2": density**-2.0,
    }  # fmt: skip


def computed(interaction: Any, known: dict[str, Any], correction: str = "none") -> Array:
    preparation = CORRECTIONS[correction].preparation(KERNEL)
    cloud = Particles.read(POSITIONS, kernel=KERNEL, volumes=known["volume"])
    return run(Operation((interaction,), preparation), cloud.neighbours, known).values


def gradients(known: dict[str, Any], correction: str) -> tuple[Array, Array, Array]:
    """(i, j, grad W~_ij) of all pairs, each particle with itself included."""
    i, j, d = all_pairs(POSITIONS, KERNEL.radius)
    itself = np.arange(COUNT)
    i, j, d = np.r_[i, itself], np.r_[j, itself], np.r_[d, np.zeros((COUNT, 2))]
    r2 = (d**2).sum(axis=1)
    apart = r2 > 0
    w = np.where(apart, KERNEL.value(np.where(apart, r2, 1.0), 2), KERNEL.value_at_zero(2))
    grad_w = np.where(apart, KERNEL.gradient_factor(np.where(apart, r2, 1.0), 2), 0.0)[:, None] * d
    if correction == "shepard":
        one = summed(i, known["volume"][j] * w, COUNT)
        grad_one = summed(i, known["volume"][j, None] * grad_w, COUNT)
        grad_w = grad_w / one[i, None] - w[:, None] * grad_one[i] / one[i, None] ** 2
    return i, j, grad_w


def test_density_is_the_sum_of_masses_with_the_particle_itself() -> None:
    known = fields()
    i, j, d = all_pairs(POSITIONS, KERNEL.radius)
    pairs = summed(i, known["mass"][j] * KERNEL.value((d**2).sum(axis=1), 2), COUNT)
    expected = pairs + known["mass"] * 10 / (7 * np.pi * 1.5**2)
    np.testing.assert_allclose(computed(SummationDensity(KERNEL), known)[:, 0], expected, rtol=1e-12)


@pytest.mark.parametrize("correction", ["none", "shepard"])
@pytest.mark.parametrize("reduced", [True, False])
def test_pressure_force(reduced: bool, correction: str) -> None:
    known = fields()
    i, j, grad_w = gradients(known, correction)
    p, rho = known["pressure"], known["density"]
    others = i != j
    mean = summed(i[others], p[j[others]], COUNT) / np.bincount(i[others])
    if not reduced:
        mean[:] = 0.0
    stress = (p[i] - mean[i]) / rho[i] ** 2 + (p[j] - mean[i]) / rho[j] ** 2
    expected = summed(i, -(known["mass"][j] * stress)[:, None] * grad_w, COUNT)
    found = computed(ReducedMomentum(None, KERNEL, CORRECTIONS[correction], reduced), known, correction)
    np.testing.assert_allclose(found, expected, rtol=1e-10, atol=1e-12)


@pytest.mark.parametrize("viscosity", ["morris", "violeau"])
def test_the_viscous_term_is_added_to_it(viscosity: str) -> None:
    known, term, none = fields(), VISCOSITY[viscosity], CORRECTIONS["none"]
    with_it = computed(ReducedMomentum(term, KERNEL, none), known)
    without = computed(ReducedMomentum(None, KERNEL, none), known)
    known["pressure_over_density2"] = np.zeros(COUNT)
    viscous = computed(Momentum(term, KERNEL, none), known)
    np.testing.assert_allclose(with_it - without, viscous, rtol=1e-10, atol=1e-10)


@pytest.mark.parametrize("correction", ["none", "shepard"])
def test_not_reduced_it_is_the_momentum_equation(correction: str) -> None:
    known, term, chosen = fields(), VISCOSITY["morris"], CORRECTIONS[correction]
    found = computed(ReducedMomentum(term, KERNEL, chosen, reduced=False), known, correction)
    expected = computed(Momentum(term, KERNEL, chosen), known, correction)
    np.testing.assert_allclose(found, expected, rtol=1e-10, atol=1e-12)


def test_a_uniform_pressure_exerts_no_force_once_reduced() -> None:
    known = fields()
    known["pressure"] = np.full(COUNT, 1e6)
    known["pressure_over_density2"] = 1e6 / known["density"] ** 2
    found = computed(ReducedMomentum(None, KERNEL, CORRECTIONS["none"]), known)
    np.testing.assert_allclose(found, 0.0, atol=1e-7)
