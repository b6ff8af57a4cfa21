"""Figures of flows: histories, robustness and arrows are drawn, and show what they are given."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from matplotlib.colors import to_hex
from matplotlib.figure import Figure

from sphear.cases.flow.base import Comparison
from sphear.results.figure import flow_panels, look, save
from sphear.results.figure.history import HistoryPanel, history_panels
from sphear.results.figure.robustness import Panel, robustness_panels
from sphear.results.figure.vectors import vector_panels

T = np.linspace(0, 1, 11)
NOTHING = np.empty(0)


def flow(values: np.ndarray[tuple[int], np.dtype[np.float64]], name: str = "rms error") -> Figure:
    compared = {"u": Comparison("y", T, T**2, T[::-1], T), "v": Comparison("x", T, T, NOTHING, NOTHING)}
    return flow_panels(compared, (T, values), ("t", name), "flow")


def histories() -> Figure:
    panels = [
        HistoryPanel("both", {"morris": (T, 100 * T)}, {"exact": (T, T), "table": (T, T)}),
        HistoryPanel("alone", {"cleary_4.24": (T, T), "takeda": ([], [])}, {}),
    ]
    return history_panels(panels, "t", "energy", "histories", columns=2, points=("table",))


def robustness() -> Figure:
    ends = {"morris": [(10.0, 3.0, "failed"), (0.5, 28.0, "steady"), (3.0, 9.0, "steps")], "cleary_4.24": []}
    return robustness_panels([Panel("none", ends, {"morris": [(0.1, 0.02), (1.0, 0.01)], "cleary_4.24": []})], "title")


def arrows() -> Figure:
    x = np.stack([T, T**2], axis=1)
    return vector_panels({"one": (x, x), "as lists": (x.tolist(), (-x).tolist())}, "arrows")


FIGURES: dict[str, Callable[[], Figure]] = {
    "flow": lambda: flow(0.1 + T), "histories": histories, "robustness": robustness, "arrows": arrows
}  # fmt: skip


@pytest.mark.parametrize("kind", FIGURES)
@pytest.mark.parametrize("ending", ["png", "svg"])
def test_a_figure_is_written(kind: str, ending: str, tmp_path: Path) -> None:
    """Warnings are errors in all tests."""
    file = tmp_path / f"figure.{ending}"
    save(FIGURES[kind](), file, "png" if ending == "png" else "svg")
    assert file.stat().st_size > 3000


def test_an_error_is_drawn_on_a_logarithmic_axis_where_it_can_be() -> None:
    scales = [flow(values, name).axes[2].get_yscale() for values, name in
              ((T + 1, "rms error"), (T, "rms error"), (T + 1, "kinetic energy"))]  # fmt: skip
    assert scales == ["log", "linear", "linear"]


def test_a_reference_is_a_line_by_increasing_place() -> None:
    with_it, without = flow(T + 1).axes[:2]
    np.testing.assert_array_equal(with_it.lines[0].get_xdata(), T)
    assert len(without.lines) == 1


@pytest.mark.parametrize(
    ("time", "table", "named", "marker"),
    [
        (None, False, "reference", "None"),
        (40.0, False, "reference, t = 40", "None"),
        (np.inf, True, "reference, steady", "s"),
    ],
)
def test_a_reference_says_of_when_it_is_and_a_table_is_points(
    time: float | None, table: bool, named: str, marker: str
) -> None:
    compared = {"u": Comparison("y", T, T, T, T, time, table)}
    figure = flow_panels(compared, (T, T), ("t", "error"), "flow")
    assert [text.get_text() for text in figure.legends[0].get_texts()] == [named, "computed"]
    assert figure.axes[0].lines[0].get_marker() == marker


def test_a_curve_that_runs_away_leaves_the_references_in_sight() -> None:
    low, high = histories().axes[0].get_ylim()
    assert (low, high) == pytest.approx((-0.3, 1.3))


def test_named_points_are_not_joined() -> None:
    exact, table = histories().axes[0].lines[:2]
    assert (exact.get_linestyle(), table.get_linestyle()) == ("-", "None")


def test_failures_are_filled_and_other_ends_open_by_increasing_reynolds_number() -> None:
    line, *marks = robustness().axes[0].lines
    assert list(np.asarray(line.get_xdata())) == [0.5, 3.0, 10.0]
    assert [mark.get_fillstyle() for mark in marks[:3]] == ["none", "none", "full"]
    assert to_hex(line.get_color()) == look("morris").colour


def test_an_arrow_a_particle() -> None:
    quivers = [ax.collections[0] for ax in arrows().axes[:2]]
    assert [len(np.asarray(quiver.get_offsets())) for quiver in quivers] == [11, 11]
