"""Entries of Tables 1 and 2 against the paper's operators written down a second time, in plain NumPy.

Written from the equations as arrays of the lattice's own shape, whose neighbours are found by shifting them.
"""

from __future__ import annotations

from itertools import product
from typing import Any

import numpy as np
import pytest

from sphear.cases.lattice import lattice
from sphear.references.zheng2018 import SIZES, TABLE_1, TABLE_2
from sphear.studies.zheng2018.patch import settings

Array = np.ndarray[Any, Any]

REACH = 3  # nodes: a support is 2 dx, and each particle of a pair is moved by 0.15 dx at most
LAYERS = 5  # beyond the edges, as many as the patch test has: so the same random numbers move the same particles


def slope_and_curvature(q: Array) -> tuple[Array, Array]:
    """h^3 dW/dr and h^4 d2W/dr2 of the 2-D cubic spline 15 / (7 pi h^2) (2/3 - q^2 + q^3/2 or (2 - q)^3/6)."""
    norm = 15 / (7 * np.pi)
    regions = [q < 1, q < 2]
    slope = np.select(regions, [-2 * q + 1.5 * q**2, -0.5 * (2 - q) ** 2])
    curvature = np.select(regions, [-2 + 3 * q, 2 - q])
    return norm * slope, norm * curvature


def operators(r: Array, dx: float) -> dict[str, Array]:
    """The four Laplacians of x^4 + y^4 at all particles r (n, n, 2) but those REACH nodes along the array's edges."""
    f, h, volume = (r**4).sum(-1), dx, dx**2
    inner = slice(REACH, -REACH)
    total: dict[str, Any] = dict.fromkeys(("15", "16", "18", "19", "20", "H", "W"), 0.0)
    for shift in product(range(-REACH, REACH + 1), repeat=2):
        if shift == (0, 0):
            continue
        d = (r - np.roll(r, shift, (0, 1)))[inner, inner]
        f_ij = volume * (f - np.roll(f, shift, (0, 1)))[inner, inner]
        distance = np.hypot(d[..., 0], d[..., 1])
        slope, curvature = slope_and_curvature(distance / h)
        slope, curvature = slope / h**3, curvature / h**4
        grad = (slope / distance)[..., None] * d
        tensor = d[..., :, None] * grad[..., None, :]
        total["15"] += 2 * f_ij * np.trace(tensor, axis1=-2, axis2=-1) / distance**2
        total["16"] += -f_ij / 2 * (curvature - slope / distance)  # with its sign and factor corrected
        total["18"] += -f_ij[..., None] * grad
        total["19"] += -volume * np.swapaxes(tensor, -1, -2)
        total["20"] += (2 * f_ij / distance**2)[..., None, None] * tensor
        total["H"] += (volume * slope / distance)[..., None, None] * d[..., :, None] * d[..., None, :]
        total["W"] += volume * grad
    gamma = np.linalg.inv(total["19"])
    gradient = np.einsum("...ab,...b->...a", gamma, total["18"])
    bracket = total["15"] - 2 * (gradient * total["W"]).sum(-1)
    factor = -np.trace(np.linalg.inv(total["H"]), axis1=-2, axis2=-1) / 2  # of eq. 17, where H tends to -1
    renormalised = np.einsum("...ab,...ab->...", gamma, total["20"])
    return {"morris": total["15"], "gotoh": total["16"], "schwaiger": factor * bracket, "oger": renormalised}


def errors(r: Array, size: int) -> dict[str, float]:
    """Err of the tables: L1-relative over the nodes 2 ... n - 2, divided by their number once more."""
    edge = LAYERS - REACH + 2
    sampled = slice(edge, -edge)
    exact = 12 * (r[REACH:-REACH, REACH:-REACH] ** 2).sum(-1)[sampled, sampled]
    found = {name: value[sampled, sampled] for name, value in operators(r, 1 / size).items()}
    assert exact.size == (size - 3) ** 2
    return {name: float(abs(f - exact).sum() / abs(exact).sum() / exact.size) for name, f in found.items()}


def nodes(size: int) -> Array:
    ticks = np.arange(-LAYERS, size + LAYERS + 1) / size
    return np.stack(np.meshgrid(ticks, ticks, indexing="ij"), axis=-1)


@pytest.mark.parametrize("size", [20, 60])
def test_table_1_is_reproduced_twice(size: int) -> None:
    found = errors(nodes(size), size)
    published = {name: values[SIZES.index(size)] for name, values in TABLE_1.items()}
    assert {name: f"{x:.2e}" for name, x in found.items()} == {name: f"{x:.2e}" for name, x in published.items()}


@pytest.mark.parametrize("name", TABLE_2)
def test_table_2_is_reproduced_twice(name: str) -> None:
    """With random numbers of its own, mean of eight sets."""
    random, size = np.random.default_rng(2018), 40
    runs = [errors(nodes(size) + 0.3 / size * (random.random(nodes(size).shape) - 0.5), size) for _ in range(8)]
    assert np.mean([run[name] for run in runs]) == pytest.approx(TABLE_2[name][SIZES.index(size)], rel=0.1)


@pytest.mark.parametrize("jitter", [0.0, 0.3])
def test_both_implementations_agree_on_the_same_particles(jitter: float) -> None:
    size = 20
    r = lattice(size, 2, layers=LAYERS, jitter=jitter, seed=5).positions.reshape(nodes(size).shape)
    theirs = {row["viscosity"]: row["paper"] for row in settings(sizes=(size,), jitter=jitter, seed=5).rows()}
    assert theirs == pytest.approx(errors(r, size), rel=1e-9)
