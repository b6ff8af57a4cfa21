"""Both sides of each pair in one go give the sums of the full pair list."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import sphear.neighbours.neighbours as neighbours_module
from sphear import CubicSpline, Domain, Monaghan, Morris, Neighbours, NoCorrection, Particles, Violeau, WendlandC2
from sphear.engine.formula import traced
from sphear.engine.sweep import sweep
from sphear.interactions import Gradient, NumberDensity, PressureForce, Rates, ViscousAcceleration, ViscousForce

KERNEL, NONE = CubicSpline(0.12), NoCorrection()


def fields(count: int, dimension: int) -> dict[str, Any]:
    random = np.random.default_rng(3)
    scalars = ("volume", "density", "dynamic_viscosity", "mass", "pressure_over_density2")
    vectors = {name: random.standard_normal((count, dimension)) for name in ("velocity", "values")}
    return {name: random.random(count) + 0.5 for name in scalars} | vectors


@pytest.mark.parametrize("threads", [1, 2])
@pytest.mark.parametrize(
    "domain", [None, Domain((0, 0), (1, 1)), Domain((0, 0), (1, 1), (True, False)), Domain((0, 0), (0.2, 1))],
    ids=["open", "periodic", "mixed", "shorter than the support"],
)  # fmt: skip
@pytest.mark.parametrize(
    "interaction",
    [
        Rates((ViscousForce(Morris(eta=0.1), KERNEL, NONE), PressureForce(KERNEL, NONE, "squares", reduced=False))),
        ViscousAcceleration(Monaghan(beta=2.0), KERNEL, NONE),
        Gradient(KERNEL, NONE, True),
        NumberDensity(KERNEL),
    ],
    ids=lambda interaction: type(interaction).__name__,
)
def test_sums_of_two_dimensions(interaction, domain, threads, monkeypatch):
    monkeypatch.setattr(neighbours_module, "CHUNK_ROWS", 60)  # several chunks, so that they reach into each other
    positions = np.random.default_rng(0).random((700, 2))
    pairs = Neighbours(positions, KERNEL.radius, domain, threads=threads)
    values = fields(700, 2)
    full = sweep(interaction, pairs, **values)
    once = sweep(interaction, pairs, each_pair_once=True, **values)
    assert np.abs(once - full).max() < 1e-12 * np.abs(full).max()


def test_sums_of_three_dimensions_in_single_precision():
    positions = np.random.default_rng(0).random((500, 3))
    kernel = WendlandC2(0.15)
    pairs = Neighbours(positions, kernel.radius, Domain((0, 0, 0), (1, 1, 1)))
    interaction, values = ViscousAcceleration(Violeau(), kernel, NONE), fields(500, 3)
    full = sweep(interaction, pairs, **values)
    once = sweep(interaction, pairs, each_pair_once=True, dtype="float32", **values)
    assert np.abs(once - full).max() < 1e-5 * np.abs(full).max()


def test_every_pair_is_listed_once():
    pairs = Neighbours(np.random.default_rng(0).random((300, 2)), 0.2)
    assert 2 * sum(chunk.pairs for chunk in pairs.chunks_once) == pairs.pairs


def test_chunks_that_reach_beyond_the_next_one_are_not_summed_at_the_same_time(monkeypatch):
    monkeypatch.setattr(neighbours_module, "CHUNK_ROWS", 2)
    assert not Neighbours(np.random.default_rng(0).random((300, 2)), 0.2, threads=2).alternating


def test_opposite_contributions_are_computed_once():
    shared = (("volume", 0.0), ("values", (0.0, 0.0)))
    formula = traced(Gradient(KERNEL, NONE, True), 2, shared, both_sides=True)
    one_side = traced(Gradient(KERNEL, NONE, True), 2, shared)
    # the kernel and the differences of the values serve both sides: only products with the other volume are added
    assert len(formula.pair_lines) < len(one_side.pair_lines) + 8


def test_particles_offer_it():
    positions = np.random.default_rng(0).random((400, 2))
    values = np.sin(5 * positions)
    full, once = (
        Particles.read(positions, kernel=KERNEL, each_pair_once=each_pair_once).laplacian(values, Morris(), NONE)
        for each_pair_once in (False, True)
    )
    assert np.abs(once - full).max() < 1e-12 * np.abs(full).max()
