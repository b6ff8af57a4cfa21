"""Figures 1, 2, 4 and 7 of Basa, Quinlan & Lastiwka 2009: the cubic spline's second derivatives, and channels."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from sphear.cases.flow.poiseuille import POISEUILLE
from sphear.results import OutputFolder
from sphear.studies import reproduce
from sphear.studies.basa2009.drift import drifts, growth
from sphear.studies.basa2009.figure_1 import POINTS, lattice_sums, second_derivatives
from sphear.studies.basa2009.figure_7 import widths
from sphear.studies.basa2009.lattice import sliding_growth
from sphear.studies.kept import as_text, kept
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


QUICK = {"figure-2": (2, "yes"), "figure-4": (2, "partly"), "figure-7": (1, "yes")}  # runs, and what they show


@cache
def channel_study(item: str, quick: bool = False) -> StudyResult:
    return reproduce("basa2009", item, quick=quick)


@pytest.mark.parametrize("item", QUICK)
def test_a_quick_channel_shows_less_of_the_same(item: str) -> None:
    quick = channel_study(item, quick=True)
    assert (len(quick.rows), quick.agrees) == QUICK[item]
    assert len(quick.rows) < len(channel_study(item).rows)
    assert quick.tables[0].rows == quick.rows


@pytest.mark.parametrize("item", QUICK)
@pytest.mark.parametrize("quick", [False, True])
def test_figures_of_channels_are_drawn(item: str, quick: bool, tmp_path: Path) -> None:
    folder = OutputFolder(tmp_path)
    for name, draw in channel_study(item, quick).figures.items():
        folder.write_figure(name, draw())
    assert [path.name for path in folder.files] == [f"{item}.png", f"{item}.svg"]
    assert min(path.stat().st_size for path in folder.files) > 10_000


@pytest.mark.parametrize("item", QUICK)
def test_kept_channels_are_small_and_whole(item: str) -> None:
    data = kept("basa2009", item)
    text = as_text(data)
    assert json.loads(text) == data
    assert len(text) < 100_000


def test_without_pressure_reduction_the_lattice_itself_is_unstable() -> None:
    """The failure is the same where the flow is too slow to disturb the particles, and grows as linear theory says."""
    none, mean, _, at_rest = channel_study("figure-2").rows
    assert none["failure_time"] == pytest.approx(at_rest["failure_time"], rel=0.05)
    assert mean["failure_time"] is None
    assert mean["largest"] < 0.12
    settings = POISEUILLE.settings()
    rate, k = sliding_growth(125e3, 0.05, 3.14 / 2 * 0.05)
    assert k == pytest.approx(np.pi)  # rows alternate
    assert 0.5 < at_rest["growth"] / (rate * POISEUILLE.time_unit(settings)) < 1
    assert channel_study("figure-2").agrees == "partly"


def test_no_pressure_no_growth() -> None:
    assert sliding_growth(0.0, 0.05, 0.0785) == (0.0, 0.0)


def test_sliding_rows_feel_the_drag_of_the_laplacian() -> None:
    """Where alternate rows feel much drag and little pressure, the rate is their ratio."""
    slow, fast = sliding_growth(1.0, 0.05, 0.0785)[0], sliding_growth(2.0, 0.05, 0.0785)[0]
    assert fast == pytest.approx(2 * slow, rel=1e-3)


def test_mirroring_is_worse_than_local_extrapolation_and_never_recovers() -> None:
    rows = {
        (row["viscosity"], row["continuation"]): row
        for row in channel_study("figure-4").rows
        if not row["wall_particles"]
    }
    mirror, line, parabola = (rows["two_pass", name] for name in ("mirror", "linear", "quadratic"))
    assert mirror["near_0.1"] > 3 * line["near_0.1"] > 3 * parabola["near_0.1"]
    assert mirror["near_1"] > mirror["near_0.1"]
    assert line["near_1"] < line["near_0.1"]


def test_the_drift_grows_exponentially_and_as_fast_in_crossings_at_any_reynolds_number() -> None:
    rows = channel_study("figure-7").rows
    assert [row["reynolds"] for row in rows] == [0.5, 1.0, 5.0, 0.5]
    assert all(row["failed"] and row["explained"] > 0.99 for row in rows)
    rates = [row["growth_in_widths"] for row in rows]
    assert max(rates) < 1.2 * min(rates)
    assert rows[0]["time"] > 27.7  # beyond the steady state


def test_disorder_at_the_start_brings_the_failure_forward() -> None:
    first, *_, disordered = channel_study("figure-7").rows
    gained = (first["time"] - disordered["time"]) * first["growth"]
    assert gained == pytest.approx(np.log(1e-6 / 1e-15), rel=0.4)


def test_a_growth_rate_is_found() -> None:
    times = np.linspace(0, 100, 201)
    found = growth(times, 1e-15 * np.exp(0.3 * times))
    assert found["growth"] == pytest.approx(0.3)
    assert found["explained"] == pytest.approx(1)
    assert growth(times, np.full(201, 1e-15)) == {"growth": None, "explained": None}


def test_crossings_are_widths_over_the_centreline_velocity() -> None:
    """t* = pi^2 nu t / (4 d^2), and U0 = Re nu / d."""
    assert widths(0.5) == pytest.approx(4 * 0.5 / (2 * np.pi**2))


def test_drifts_are_of_neighbours_and_rows_move_together() -> None:
    start = np.tile([0.0, 1.0, 2.0], (3, 1))
    later = start + np.array([0.0, 0.5, 0.0])  # one row as a whole
    later[1, 2] += 0.25  # one particle out of its row
    found = drifts(np.array([later]), start, 0.5)
    assert (found["row"], found["largest"], found["median"]) == (0, [0.5], [0.0])
    assert found["together"] == [1.0]
