from itertools import pairwise
from pathlib import Path

import matplotlib
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.text import Annotation, Text

from sphear.results.figure import (
    LOOKS,
    Convergence,
    Profile,
    convergence_panels,
    loglog_convergence,
    look,
    profiles,
    save,
    scatter_panels,
    surface_panels,
)
from sphear.results.figure.spread import spread

SIZES = np.array([400, 1600, 3600, 6400, 10000])
GRID = np.linspace(-1, 1, 21)
X, Y = np.meshgrid(GRID, GRID)
FIGURES = {
    "convergence": lambda: convergence_panels(
        [
            Convergence(
                {"morris": (SIZES, 1 / SIZES), "oger": (SIZES, SIZES**-2.0)},
                "error",
                [-1, -2],
                {"morris": (SIZES, 1 / SIZES)},
            ),
            Convergence({"morris": (SIZES, SIZES**0.5)}, "error", [0.5]),
        ],
        "N",
        "convergence",
    ),
    "profiles": lambda: profiles(
        {name: Profile((GRID, GRID**2), (GRID, GRID**2)) for name in list(LOOKS)[:3]}, "x", "f", "profiles"
    ),
    "scatter": lambda: scatter_panels({"lattice": np.stack([X.ravel(), Y.ravel()], -1)}, "scatter"),
    "surface": lambda: surface_panels({"xy": (GRID, GRID, X * Y), "zero": (GRID, GRID, 0 * X)}, "x", "y", "surface"),
}


def luminance(colour: str) -> float:
    red, green, blue = ((c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4) for c in to_rgb(colour))
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def names(figure: Figure) -> list[Annotation]:
    """The names at the ends of the curves of a figure with one panel."""
    return [child for child in figure.axes[0].texts if isinstance(child, Annotation) and child.arrow_patch]


def test_every_viscous_term_looks_different_and_is_seen_on_white() -> None:
    assert len({each.colour for each in LOOKS.values()}) == len({each.marker for each in LOOKS.values()}) == len(LOOKS)
    assert max(luminance(each.colour) for each in LOOKS.values()) < 0.5


def test_a_variant_has_the_look_of_its_term_and_a_stranger_that_of_none() -> None:
    assert look("gotoh as printed") == LOOKS["gotoh"]
    assert look("published") == look("") not in LOOKS.values()


@pytest.mark.parametrize("kind", FIGURES)
def test_a_figure_is_the_same_file_each_time(kind: str, tmp_path: Path) -> None:
    files = [tmp_path / "first.svg", tmp_path / "second.svg"]
    for file in files:
        save(FIGURES[kind](), file, "svg")
    assert files[0].read_bytes() == files[1].read_bytes()


@pytest.mark.parametrize("kind", FIGURES)
def test_everything_drawn_lies_inside_the_picture(kind: str) -> None:
    figure = FIGURES[kind]()
    figure.draw_without_rendering()
    drawn, page = figure.get_tightbbox(), figure.bbox_inches
    assert page.x0 <= drawn.x0 < drawn.x1 <= page.x1
    assert page.y0 <= drawn.y0 < drawn.y1 <= page.y1


def test_a_figure_leaves_matplotlib_as_it_was(tmp_path: Path) -> None:
    before = dict(matplotlib.rcParams)
    save(FIGURES["convergence"](), tmp_path / "figure.png", "png")
    assert dict(matplotlib.rcParams) == before


def test_a_curve_is_drawn_where_its_points_are() -> None:
    (axes,) = loglog_convergence({"morris": (SIZES, 1 / SIZES)}, "N", "error", "title").axes
    np.testing.assert_array_equal(axes.lines[0].get_xydata(), np.stack([SIZES, 1 / SIZES], -1))
    assert (axes.get_xscale(), axes.get_yscale()) == ("log", "log")
    assert [label.get_text() for label in axes.get_xticklabels()] == ["400", "1600", "3600", "6400", "10000"]


def test_of_two_curves_at_one_place_both_are_seen() -> None:
    (axes,) = loglog_convergence({"schwaiger": (SIZES, 1 / SIZES), "oger": (SIZES, 1.01 / SIZES)}, "", "", "").axes
    below, _, above, _ = axes.lines
    assert (below.get_linestyle(), above.get_linestyle()) == ("-", "--")
    assert below.zorder < above.zorder


@pytest.mark.parametrize("slope", [-2.0, -0.5, 0.0, 1.0])
def test_a_reference_line_has_its_slope_and_lies_under_the_nearest_curve(slope: float) -> None:
    near, far = SIZES ** (slope + 0.1), SIZES ** (slope - 2.0)
    (axes,) = loglog_convergence({"morris": (SIZES, near), "gotoh": (SIZES, far)}, "", "", "", [slope]).axes
    x, y = np.transpose(axes.lines[-1].get_xydata())
    assert np.diff(np.log(y)) / np.diff(np.log(x)) == pytest.approx(slope)
    assert (y < near[[0, -1]]).all()
    assert (y > 0.1 * near[0] * (x / x[0]) ** slope).all()


def test_names_stand_apart_in_the_order_of_the_curves() -> None:
    curves = {name: (SIZES, np.full(5, 1 + 0.01 * k)) for k, name in enumerate(LOOKS)}
    figure = loglog_convergence(curves | {"morris as printed": (SIZES, np.full(5, 1e-9))}, "", "", "")
    figure.draw_without_rendering()
    labels = names(figure)
    assert [label.get_text() for label in labels] == ["morris as printed", *LOOKS]
    boxes = [Text.get_window_extent(label) for label in labels]
    assert all(below.y1 < above.y0 for below, above in pairwise(boxes))
    assert boxes[-1].y0 < figure.axes[0].bbox.y1


@given(st.lists(st.floats(0, 1), min_size=1, max_size=12).map(sorted))
def test_spread_levels_are_apart_inside_and_only_moved_for_a_reason(levels: list[float]) -> None:
    distance = 1 / 12
    spaced = spread(levels, distance)
    assert (np.diff(spaced) >= distance - 1e-12).all()
    assert spaced[0] >= 0
    assert spaced[-1] <= 1 + 1e-12
    np.testing.assert_allclose(spread(spaced, distance), spaced, atol=1e-12)


@pytest.mark.parametrize("y", [[0, 0], [np.nan, np.inf], []])
def test_what_logarithmic_axes_cannot_show_is_left_out(y: list[float]) -> None:
    x = [1.0, 2.0][: len(y)]
    figure = loglog_convergence({"morris": (x, y), "gotoh": ([1, 2], [3, 0])}, "", "", "", [1])
    assert [name.get_text() for name in names(figure)] == ["gotoh"]
    figure.draw_without_rendering()


def test_zero_is_white_in_a_surface() -> None:
    figure = surface_panels({"xy": (GRID, GRID, X * Y)}, "x", "y", "")
    filled = figure.axes[0].collections[0]
    assert filled.norm(np.zeros(1)) == pytest.approx(0.5)
