"""Monomials of a vector's components, by their exponents: what moments and polynomial fits are made of."""

from __future__ import annotations

from functools import lru_cache
from itertools import combinations_with_replacement

from sphear.algebra import Scalar, Vector

Exponents = tuple[int, ...]


@lru_cache
def exponents(dimension: int, lowest: int, highest: int | None = None) -> tuple[Exponents, ...]:
    """The exponents of all monomials of degree lowest ... highest (default: lowest), by degree."""
    return tuple(
        tuple(chosen.count(axis) for axis in range(dimension))
        for degree in range(lowest, (highest or lowest) + 1)
        for chosen in combinations_with_replacement(range(dimension), degree)
    )


def monomial(d: Vector, powers: Exponents) -> Scalar:
    """The product of d_a^powers_a."""
    result: Scalar = 1.0
    for x, power in zip(d, powers, strict=True):
        if power:
            result = result * x**power
    return result


@lru_cache
def index_pairs(dimension: int) -> tuple[tuple[int, int], ...]:
    """The pairs a <= b of axes: the components of a symmetric tensor of rank two."""
    return tuple(combinations_with_replacement(range(dimension), 2))
