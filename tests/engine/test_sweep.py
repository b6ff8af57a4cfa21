"""A sweep against sums over all pairs by brute force, in every dimension, precision and domain."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
import pytest

from sphear import Domain, Kernel, Neighbours, WendlandC2
from sphear.algebra import dot, scale, subtract
from sphear.engine.flags import lane_count
from sphear.engine.formula import Sum
from sphear.engine.sweep import sweep
from tests.particles import Array, all_pairs, box, jittered, lattice, summed

H = 0.9
SUPPORT = 2 * H
COUNTS = {1: (60,), 2: (13, 12), 3: (7, 6, 6)}
DOMAINS: dict[str, Any] = {
    "open": lambda n: None,
    "periodic": box,
    "mixed": lambda n: Domain((0.0,) * len(n), tuple(map(float, n)), tuple(axis % 2 == 0 for axis in range(len(n)))),
    # narrower than the support, so that a particle is its own neighbour many times
    "short": lambda n: Domain((0.0,) * len(n), (1.1, *map(float, n[1:]))),
}
TOLERANCE = {"float64": 1e-12, "float32": 2e-5}


@dataclass(frozen=True)
class Probe(Sum):
    """Something of everything: parameters, numbers and vectors of both particles, nested results, a use of `own`."""

    kernel: Kernel
    factor: float

    def pair(self, own: Any, other: Any, d: Any, r2: Any) -> Any:
        w = self.factor * other.mass * self.kernel.value(r2, len(d))
        return w, scale(w * own.charge, subtract(other.velocity, own.velocity)), (w * dot(other.velocity, d),)

    def finish(self, own: Any, total: Any) -> Any:
        w, difference, (flux,) = total
        return difference, w + own.mass * self.factor, flux / (1.0 + own.charge)


def fields_of(count: int, dimension: int) -> dict[str, Any]:
    generator = np.random.default_rng(7)
    fields = {"mass": generator.random(count) + 0.5, "charge": generator.random(count)}
    return fields | {"unused": generator.random((count, 2)), "velocity": generator.random((count, dimension)) - 0.5}


def wendland_c2(r: Array, dimension: int) -> Array:
    q = r / (2 * H)
    if dimension == 1:
        return 5 / (8 * H) * (1 - q) ** 3 * (1 + 3 * q)
    return {2: 7 / (4 * np.pi * H**2), 3: 21 / (16 * np.pi * H**3)}[dimension] * (1 - q) ** 4 * (1 + 4 * q)


def expected(positions: Array, domain: Domain | None, fields: dict[str, Any], factor: float) -> Array:
    count, dimension = positions.shape
    i, j, d = all_pairs(positions, SUPPORT, domain)
    mass, charge, velocity = fields["mass"], fields["charge"], fields["velocity"]
    w = factor * mass[j] * wendland_c2(np.linalg.norm(d, axis=1), dimension)
    difference = (w * charge[i])[:, None] * (velocity[j] - velocity[i])
    flux = w * (velocity[j] * d).sum(axis=1)
    columns = (summed(i, difference, count), summed(i, w, count) + factor * mass, summed(i, flux, count) / (1 + charge))
    return np.column_stack(columns)


def places(dimension: int, domain: str) -> tuple[Array, Domain | None]:
    positions = jittered(COUNTS[dimension], 0.6, seed=dimension)
    if domain == "short":
        positions = positions[positions[:, 0] < 1.0]
    return positions, DOMAINS[domain](COUNTS[dimension])


@cache
def neighbours(dimension: int, domain: str, threads: int) -> Neighbours:
    return Neighbours(*places(dimension, domain)[:1], SUPPORT, places(dimension, domain)[1], threads=threads)


@pytest.mark.parametrize(("dtype", "once"), [("float64", False), ("float32", False), ("float64", True)])
@pytest.mark.parametrize("domain", DOMAINS)
@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_a_sweep_is_the_sum_over_all_pairs(dimension: int, domain: str, dtype: str, once: bool) -> None:
    positions, limits = places(dimension, domain)
    fields = fields_of(len(positions), dimension)
    pairs = neighbours(dimension, domain, 1)
    found = sweep(Probe(WendlandC2(H), 1.7), pairs, dtype=dtype, each_pair_once=once, **fields)
    assert found.dtype == dtype
    theirs = expected(positions, limits, fields, 1.7)
    np.testing.assert_allclose(found, theirs, rtol=0, atol=TOLERANCE[dtype] * np.abs(theirs).max())


@pytest.mark.parametrize("dtype", ["float64", "float32"])
@pytest.mark.parametrize("domain", DOMAINS)
@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_the_number_of_threads_does_not_change_a_bit(dimension: int, domain: str, dtype: str) -> None:
    fields = fields_of(len(places(dimension, domain)[0]), dimension)
    one, two, five = (
        sweep(Probe(WendlandC2(H), 1.7), neighbours(dimension, domain, threads), dtype=dtype, **fields)
        for threads in (1, 2, 5)
    )
    np.testing.assert_array_equal(one, two)
    np.testing.assert_array_equal(one, five)


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_the_order_of_the_particles_matters_to_rounding_only(dimension: int) -> None:
    positions, domain = places(dimension, "mixed")
    fields = fields_of(len(positions), dimension)
    order = np.random.default_rng(3).permutation(len(positions))
    found = sweep(Probe(WendlandC2(H), 1.7), neighbours(dimension, "mixed", 1), **fields)
    shuffled = Neighbours(positions[order], SUPPORT, domain, threads=1)
    again = sweep(Probe(WendlandC2(H), 1.7), shuffled, **{name: values[order] for name, values in fields.items()})
    np.testing.assert_allclose(again, found[order], rtol=0, atol=1e-13 * np.abs(found).max())


@pytest.mark.parametrize("dtype", ["float64", "float32"])
def test_every_number_of_neighbours(dtype: str) -> None:
    """Lanes without a neighbour must add nothing: clusters of 1, 2, ... particles, all of each near each other."""
    sizes = range(1, 2 * lane_count("float32") + 2)
    positions = np.concatenate([3.0 * size + np.linspace(0.0, H, size)[:, None] for size in sizes])
    fields = fields_of(len(positions), 1)
    theirs = expected(positions, None, fields, 1.0)
    found = sweep(Probe(WendlandC2(H), 1.0), Neighbours(positions, SUPPORT), dtype=dtype, **fields)
    # the coordinates grow to a hundred, of which single precision has five digits behind the point
    np.testing.assert_allclose(
        found, theirs, rtol=0, atol=(1e-12 if dtype == "float64" else 2e-4) * np.abs(theirs).max()
    )


def test_a_lone_particle_has_the_result_of_an_empty_sum() -> None:
    fields = fields_of(1, 2)
    found = sweep(Probe(WendlandC2(H), 2.0), Neighbours(np.zeros((1, 2)), SUPPORT), **fields)
    np.testing.assert_allclose(found, [[0.0, 0.0, 2.0 * fields["mass"][0], 0.0]])


def test_parameters_are_taken_at_run_time() -> None:
    positions, _ = places(2, "open")
    fields = fields_of(len(positions), 2)
    for factor in (0.0, -3.0):
        found = sweep(Probe(WendlandC2(H), factor), neighbours(2, "open", 1), **fields)
        np.testing.assert_allclose(found, expected(positions, None, fields, factor), atol=1e-12)


@dataclass(frozen=True)
class DifferentComponents(Sum):
    """Uses components of a field of `own` that it does not use of `other`."""

    kernel: Kernel
    own_first: int
    own_second: int
    of_other: int

    def pair(self, own: Any, other: Any, d: Any, r2: Any) -> Any:
        w = self.kernel.value(r2, len(d))
        return (w * own.field[self.own_first] * own.field[self.own_second] * other.field[self.of_other] * own.mass,)


@pytest.mark.parametrize("once", [False, True])
@pytest.mark.parametrize("components", [(0, 0, 1), (0, 2, 1), (0, 3, 2), (2, 3, 0)])
def test_own_and_other_may_use_different_components_of_a_field(components: tuple[int, int, int], once: bool) -> None:
    positions = lattice((3, 4))
    generator = np.random.default_rng(5)
    field, mass = generator.random((12, 4)), generator.random(12)
    first, second, of_other = components
    i, j, d = all_pairs(positions, SUPPORT)
    total = summed(i, wendland_c2(np.linalg.norm(d, axis=1), 2) * field[j, of_other], 12)
    interaction = DifferentComponents(WendlandC2(H), first, second, of_other)
    found = sweep(interaction, Neighbours(positions, SUPPORT), each_pair_once=once, field=field, mass=mass)[:, 0]
    assert found == pytest.approx(field[:, first] * field[:, second] * total * mass)
