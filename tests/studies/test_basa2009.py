"""Figure 1 of Basa, Quinlan & Lastiwka 2009: the second derivatives of the cubic spline."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from sphear.results import OutputFolder
from sphear.studies import reproduce
from sphear.studies.basa2009.figure_1 import POINTS, lattice_sums, second_derivatives
from sphear.studies.result import StudyResult

Array = np.ndarray[Any, Any]


@cache
def study() -> StudyResult:
    return reproduce("basa2009", "figure-1")


def cubic_spline(x: Array, y: Array) -> Array:
    """W with h = 1 in 2-D, from Monaghan's two branches."""
    q = np.hypot(x, y)
    return 10 / (7 * np.pi) * np.select([q < 1, q < 2], [1 - 1.5 * q**2 + 0.75 * q**3, 0.25 * (2 - q) ** 3])


def test_they_are_the_derivatives_of_the_kernel() -> None:
    """Central differences, whose error is of the order of the step where the third derivative jumps."""
    axis, xx, xy = second_derivatives()
    x, y = np.meshgrid(axis, axis)
    s = 1e-4
    along = (cubic_spline(x + s, y) - 2 * cubic_spline(x, y) + cubic_spline(x - s, y)) / s**2
    across = sum(a * b * cubic_spline(x + a * s, y + b * s) for a in (1, -1) for b in (1, -1)) / (4 * s**2)
    assert max(abs(xx - along).max(), abs(xy - across).max()) < 5e-4


def test_the_grid_is_the_support_with_the_centre() -> None:
    axis, xx, xy = second_derivatives()
    assert (axis[0], axis[POINTS // 2], axis[-1]) == pytest.approx((-2, 0, 2))
    assert xx.shape == xy.shape == (POINTS, POINTS)


@pytest.mark.parametrize("flipped", [0, 1])
def test_the_mixed_derivative_is_antisymmetric_across_both_axes(flipped: int) -> None:
    _, _, xy = second_derivatives()
    np.testing.assert_allclose(np.flip(xy, flipped), -xy, rtol=0, atol=1e-12)


@pytest.mark.parametrize("flipped", [0, 1])
def test_the_unmixed_derivative_is_symmetric_across_both_axes(flipped: int) -> None:
    _, xx, _ = second_derivatives()
    np.testing.assert_allclose(np.flip(xx, flipped), xx, rtol=0, atol=1e-12)


def test_beyond_the_support_they_vanish() -> None:
    axis, xx, xy = second_derivatives()
    outside = np.hypot(*np.meshgrid(axis, axis)) >= 2
    assert not xx[outside].any()
    assert not xy[outside].any()


@pytest.mark.parametrize("dx_over_h", [0.3, 0.637, 1.0])
def test_the_sums_on_a_lattice(dx_over_h: float) -> None:
    """Against differences of sum_j V_j W_ij while the lattice is moved: what a constant field becomes."""

    def one(x: float, y: float) -> float:
        ticks = dx_over_h * np.arange(-9, 10)
        return float(dx_over_h**2 * cubic_spline(*np.meshgrid(x + ticks, y + ticks)).sum())

    s = 1e-3
    along = (one(s, 0) - 2 * one(0, 0) + one(-s, 0)) / s**2
    across = (one(s, s) - one(s, -s) - one(-s, s) + one(-s, -s)) / (4 * s**2)
    assert lattice_sums(dx_over_h) == pytest.approx((along, across), abs=5e-3)


def test_a_fine_lattice_sums_to_zero() -> None:
    coarse, fine, finest = (abs(lattice_sums(dx_over_h)[0]) for dx_over_h in (0.637, 0.4, 0.1))
    assert coarse > 2 * fine > 20 * finest


def test_the_rows_give_extremes_and_sums() -> None:
    _, xx, xy = second_derivatives()
    sums = lattice_sums()
    assert study().rows == [
        {"derivative": "d2W/dx2", "maximum": xx.max(), "minimum": xx.min(), "lattice_sum": sums[0]},
        {"derivative": "d2W/dxdy", "maximum": xy.max(), "minimum": xy.min(), "lattice_sum": sums[1]},
    ]


def test_the_extremes_are_those_of_the_formula() -> None:
    """d2W/dx2 is -3 sigma at the centre and 3/2 sigma at x = h."""
    sigma = 10 / (7 * np.pi)
    first = study().rows[0]
    assert (first["minimum"], first["maximum"]) == pytest.approx((-3 * sigma, 1.5 * sigma))


def test_the_paper_is_confirmed_with_its_number() -> None:
    assert study().agrees == "yes"
    assert f"{study().rows[0]['lattice_sum']:.3f} / h^2" in study().finding


def test_the_figure_is_written(tmp_path: Path) -> None:
    folder = OutputFolder(tmp_path)
    for name, draw in study().figures.items():
        folder.write_figure(name, draw())
    assert [path.name for path in folder.files] == ["figure-1.png", "figure-1.svg"]
    assert min(path.stat().st_size for path in folder.files) > 10_000
