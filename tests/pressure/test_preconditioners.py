from __future__ import annotations

from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.sparse import csr_matrix

from sphear.pressure import PRECONDITIONERS, Grid
from sphear.pressure.preconditioners import transfer
from sphear.pressure.preconditioners.multigrid import MultigridPoisson
from sphear.pressure.preconditioners.poisson import BoxPoisson
from sphear.pressure.preconditioners.transfer import Transfer
from tests.pressure.problems import box, fixed, random_right


@given(
    name=st.sampled_from(["grid", "jacobi", "amg"]),
    sides=st.lists(st.integers(5, 12), min_size=1, max_size=3),
    flags=st.tuples(*[st.booleans()] * 3),
    surface=st.booleans(),
    hole=st.booleans(),
    seed=st.integers(0, 1000),
)
def test_symmetric_and_negative_definite(
    name: str, sides: list[int], flags: tuple[bool, bool, bool], surface: bool, hole: bool, seed: int
) -> None:
    """<x, M y> = <M x, y> and <x, M x> < 0: what conjugate gradients rest on."""
    system = box(tuple(sides), periodic=flags[: len(sides)], hole=0.2 if hole and len(sides) > 1 else 0.0)
    if surface:
        system = fixed(system, system.positions[:, -1] > system.upper[-1] - system.spacing)
    inverse = PRECONDITIONERS[name].build(system)
    x, y = (random_right(system, s) for s in (seed, seed + 1))
    if system.singular:
        x, y = x - x.mean(), y - y.mean()
    mx, my = inverse(x), inverse(y)
    assert x @ my == pytest.approx(mx @ y, rel=1e-6, abs=1e-8 * float(np.linalg.norm(x) * np.linalg.norm(my)))
    assert x @ mx < 0
    assert np.array_equal(inverse(x), mx)  # and it keeps nothing from call to call


@pytest.mark.parametrize("counts", [(5,), (4, 6), (3, 4, 5)])
def test_the_transforms_solve_poissons_equation(counts: tuple[int, ...]) -> None:
    for flags in product([False, True], repeat=len(counts)):
        size = tuple(0.1 * (k + 1) for k in range(len(counts)))
        source = np.random.default_rng(0).standard_normal(counts)
        source -= source.mean()
        found = BoxPoisson(counts, size, flags, 2.0)(source.ravel().copy()).reshape(counts)
        applied = np.zeros(counts)
        for axis, (step, flag) in enumerate(zip(size, flags, strict=True)):
            wide = np.pad(
                found, [(1, 1) if a == axis else (0, 0) for a in range(len(counts))], "wrap" if flag else "edge"
            )
            applied -= np.diff(wide, 2, axis=axis) / step**2
        assert np.allclose(applied, 2.0 * source)


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("block", [5000, 20])
def test_transfer(periodic: bool, block: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Constants are interpolated exactly, everything between the nodes is linear, and depositing is the transpose."""
    rng = np.random.default_rng(0)
    monkeypatch.setattr(transfer, "BLOCK", block)
    positions, size = 1.4 * rng.random((50, 2)) - 0.2, (0.25, 0.2)
    between = Transfer(positions, (0, 0), size, (4, 5), (periodic, periodic), 2)
    zero, vector, grid = np.zeros(50), rng.random(50), rng.random(20)
    assert np.allclose(between.interpolate_and_add(np.ones(20), zero, zero), 1.0)
    room = between.deposit(vector)
    assert room @ grid == pytest.approx(vector @ between.interpolate_and_add(grid, zero, zero))
    x = ((np.arange(20) // 5) + 0.5) * size[0]
    inside = (np.abs(positions - 0.5) < np.array([0.375, 0.4])).all(axis=1)
    assert np.allclose(between.interpolate_and_add(x, zero, zero)[inside], positions[inside, 0])


def test_the_coefficient_of_the_laplacian_is_measured() -> None:
    """A matrix divided by a density of 1000 has an inverse 1000 times as large."""
    system = box((20, 20), periodic=True)
    right = random_right(system)
    light, heavy = Grid().build(system), Grid().build(replace(system, matrix=csr_matrix(system.matrix / 1000.0)))
    assert np.allclose(heavy(right), 1000.0 * light(right))


def test_a_v_cycle_is_nearly_the_transform_where_both_apply() -> None:
    counts, size, flags = (24, 20), (0.1, 0.1), (False, True)
    source = np.random.default_rng(0).standard_normal(480)
    source -= source.mean()
    exact = BoxPoisson(counts, size, flags, 1 / 3.0)(source.copy())
    cycle = MultigridPoisson(counts, size, flags, 3.0, np.ones(480), np.zeros(480))
    found = cycle(source)
    found -= found.mean()
    assert np.linalg.norm(found - exact) < 0.2 * np.linalg.norm(exact)


def test_nodes_without_fluid_take_no_part() -> None:
    share = np.ones((16, 16))
    share[4:12, 4:12] = 0.0
    source = np.where(share.ravel() > 0, 1.0, 0.0)
    found = MultigridPoisson((16, 16), (1.0, 1.0), (False, False), 1.0, share.ravel(), 0.1 * source)(source)
    assert np.isfinite(found).all()
    assert (found[source > 0] > 0).all()


def test_names() -> None:
    assert list(PRECONDITIONERS) == ["jacobi", "grid", "amg"]
    assert PRECONDITIONERS["multigrid"].name == "amg"
