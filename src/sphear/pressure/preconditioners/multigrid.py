"""Poisson's equation on the nodes of a grid that fluid fills in part, by one symmetric V-cycle."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from sphear.engine.cache import compiled
from sphear.pressure.preconditioners.coarsest import pseudo_inverse
from sphear.pressure.preconditioners.transfer import deposit, interpolate_and_add, surrounding_nodes

Array = np.ndarray[Any, Any]

COARSEST = 32  # nodes or fewer are solved at once
NULL = 1e-10  # relative to the largest, a pivot that is zero: of the constant, where no pressure is fixed


@compiled
def stencil(beside, share, stiffness, penalty):  # type: ignore[no-untyped-def]
    """The couplings (nodes, 2 d) of nodes to those beside them and the inverse diagonal; zero where there is nothing.

    Nodes k and l are coupled by the stiffness of their axis times the mean of their shares of fluid.
    """
    nodes, sides = beside.shape
    coupling = np.zeros((nodes, sides))
    inverse = np.zeros(nodes)
    for k in range(nodes):
        diagonal = penalty[k]
        for side in range(sides):
            other = beside[k, side]
            if other != k:
                coupling[k, side] = 0.5 * (share[k] + share[other]) * stiffness[side // 2]
                diagonal += coupling[k, side]
        if diagonal > 0.0:
            inverse[k] = 1.0 / diagonal
    return coupling, inverse


@compiled
def relax(beside, coupling, inverse, source, values, backward):  # type: ignore[no-untyped-def]
    """One Gauss-Seidel sweep over the nodes, in place, forth or back."""
    nodes, sides = beside.shape
    for step in range(nodes):
        k = nodes - 1 - step if backward else step
        total = source[k]
        for side in range(sides):
            total += coupling[k, side] * values[beside[k, side]]
        values[k] = total * inverse[k]


@compiled
def residual(beside, coupling, inverse, source, values, result):  # type: ignore[no-untyped-def]
    """result = source - G values."""
    nodes, sides = beside.shape
    for k in range(nodes):
        total = source[k]
        for side in range(sides):
            total += coupling[k, side] * values[beside[k, side]]
        result[k] = total - values[k] / inverse[k] if inverse[k] > 0.0 else 0.0


@dataclass(frozen=True)
class Level:
    """The equation on one grid, and the way to the next coarser one.

    Attributes:
        beside, coupling, inverse: of `stencil`.
        nodes, weights: of `surrounding_nodes`, the nodes of the coarser grid around those of this one.
        values, source, ones: (nodes,), room to work in.
    """

    beside: Array
    coupling: Array
    inverse: Array
    nodes: Array
    weights: Array
    values: Array
    source: Array
    ones: Array


class MultigridPoisson:
    """The inverse of the Laplacian on nodes of which some hold no fluid and some are near a given pressure.

        (G v)_k = factor sum_l (share_k + share_l) / 2 (v_k - v_l) / size^2 + penalty_k v_k

    A transform cannot invert that, so multigrid does, roughly: a V-cycle with a Gauss-Seidel sweep forth on the way
    down and one back on the way up, which makes it symmetric. Each grid has half the nodes of the last along each axis;
    it is made of shares and penalties deposited on it, like a source.

    Args:
        counts: (d,), nodes along each axis.
        size: (d,), their distance along each axis, in units of length.
        periodic: (d,), whether an axis repeats.
        factor: particles a full node stands for, times the coefficient of the Laplacian.
        share: (nodes,), of each node, how full it is; about one inside the fluid.
        penalty: (nodes,), of each node, the sum over its particles of what is missing in their rows, in 1 / length^2.
    """

    def __init__(
        self,
        counts: tuple[int, ...],
        size: tuple[float, ...],
        periodic: tuple[bool, ...],
        factor: float,
        share: Array,
        penalty: Array,
    ) -> None:
        self.levels: list[Level] = []
        while True:
            stiffness = factor / np.array(size) ** 2
            beside = _beside(counts, periodic)
            coupling, inverse = stencil(beside, share, stiffness, penalty)
            if len(share) <= COARSEST:
                break
            coarser = tuple((count + 1) // 2 for count in counts)
            wider = tuple(s * count / half for s, count, half in zip(size, counts, coarser, strict=True))
            nodes, weights = _between(counts, coarser, periodic)
            total = len(share)
            room = (np.empty(total), np.empty(total), np.ones(total))
            self.levels.append(Level(beside, coupling, inverse, nodes, weights, *room))
            ratio = total / np.prod(coarser)
            share, penalty = (_deposited(nodes, weights, x, int(np.prod(coarser))) for x in (share / ratio, penalty))
            counts, size, factor = coarser, wider, factor * ratio
        matrix = np.zeros((len(share), len(share)))
        for side in range(beside.shape[1]):
            np.add.at(matrix, (np.arange(len(share)), beside[:, side]), -coupling[:, side])
        matrix[np.diag_indices(len(share))] += np.divide(1.0, inverse, out=np.zeros_like(inverse), where=inverse > 0)
        self.coarsest = pseudo_inverse(matrix, NULL)

    def __call__(self, source: Array) -> Array:
        """Nearly the solution (nodes,) for a source (nodes,)."""
        return self._cycle(0, source)

    def _cycle(self, number: int, source: Array) -> Array:
        if number == len(self.levels):
            solved: Array = self.coarsest @ source
            return solved
        level = self.levels[number]
        equation = (level.beside, level.coupling, level.inverse, source)
        level.values[:] = 0.0
        relax(*equation, level.values, False)
        residual(*equation, level.values, level.source)
        last = number + 1 == len(self.levels)
        below = len(self.coarsest) if last else len(self.levels[number + 1].source)
        coarse = self._cycle(number + 1, _deposited(level.nodes, level.weights, level.source, below))
        values = np.empty_like(level.values)
        interpolate_and_add(level.nodes, level.weights, coarse, level.ones, level.values, values)
        relax(*equation, values, True)
        return values


def _deposited(nodes: Array, weights: Array, values: Array, count: int) -> Array:
    grid = np.empty(count)
    deposit(nodes, weights, values, grid)
    return grid


@lru_cache(maxsize=64)  # grids of a run do not change from step to step
def _beside(counts: tuple[int, ...], periodic: tuple[bool, ...]) -> Array:
    """(nodes, 2 d): the nodes before and after each one along each axis; itself where there is none."""
    number = np.arange(int(np.prod(counts)), dtype=np.int32).reshape(counts)
    sides = []
    for axis, (count, flag) in enumerate(zip(counts, periodic, strict=True)):
        for step in (-1, 1):
            place = np.arange(count) + step
            sides.append(np.take(number, place % count if flag else np.clip(place, 0, count - 1), axis).ravel())
    return np.ascontiguousarray(np.stack(sides, axis=1))


@lru_cache(maxsize=64)
def _between(counts: tuple[int, ...], coarser: tuple[int, ...], periodic: tuple[bool, ...]) -> tuple[Array, Array]:
    """`surrounding_nodes` of the nodes of one grid in a coarser one, in units of the box."""
    axes = [(np.arange(count) + 0.5) / count for count in counts]
    places = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, len(counts))
    size = 1.0 / np.array(coarser)
    nodes, weights = surrounding_nodes(places, np.zeros(len(counts)), size, np.array(coarser), np.array(periodic))
    return nodes, weights
