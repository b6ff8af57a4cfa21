"""Rows of weights over the fluid, around points at walls."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from sphear.interactions.point_fit import PointFit, PointWeights
from sphear.kernels import WendlandC2
from sphear.neighbours.points import sorted_particles
from sphear.schemes.incompressible import wall_rows
from sphear.schemes.incompressible.wall_rows import FittedRows
from tests.particles import jittered

DX = 0.05
KERNEL = WendlandC2(1.5 * DX)


def rows_around(points: np.ndarray[Any, Any]) -> FittedRows:
    return FittedRows(points, KERNEL.radius, PointFit(KERNEL), PointWeights(KERNEL), {"volume": np.zeros(len(points))})


def test_planes_are_exact_in_the_points_own_order() -> None:
    particles = jittered((20, 20), 0.2, seed=1, dx=DX)
    points = 0.2 + 0.6 * np.random.default_rng(2).random((40, 2))
    fields = {"volume": np.full(len(particles), DX**2)}
    around = sorted_particles(particles, KERNEL.radius, None)
    column = np.arange(len(particles), dtype=np.int32)[::-1].copy()
    rows = rows_around(points).matrix(around, fields, column, len(particles), 1)
    plane = 1.0 + particles @ (2.0, -3.0)
    np.testing.assert_allclose(rows @ plane[::-1], 1.0 + points @ (2.0, -3.0), rtol=0, atol=1e-12)


def test_a_point_without_fluid_has_no_row() -> None:
    particles = jittered((20, 20), 0.2, seed=1, dx=DX)
    around = sorted_particles(particles, KERNEL.radius, None)
    fields, column = {"volume": np.zeros(400)}, np.arange(400, dtype=np.int32)  # none of them counts
    assert rows_around(np.full((1, 2), 0.5)).matrix(around, fields, column, 400, 1).nnz == 0
    fields = {"volume": np.full(400, DX**2)}
    rows = rows_around(np.array([(0.5, 0.5), (3.0, 3.0)])).matrix(around, fields, column, 400, 1)
    assert np.diff(rows.indptr)[0] > 0
    assert np.diff(rows.indptr)[1] == 0


def test_threads_change_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(wall_rows, "WORTH_A_CHUNK", 10)
    particles = jittered((20, 20), 0.2, seed=1, dx=DX)
    around = sorted_particles(particles, KERNEL.radius, None)
    fields, column = {"volume": np.full(400, DX**2)}, np.arange(400, dtype=np.int32)
    points = np.random.default_rng(2).random((50, 2))
    one, three = (rows_around(points).matrix(around, fields, column, 400, threads) for threads in (1, 3))
    for part in ("indptr", "indices", "data"):
        np.testing.assert_array_equal(getattr(one, part), getattr(three, part))
