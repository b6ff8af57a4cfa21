"""Errors, times and the like on logarithmic axes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import NullLocator
from numpy.typing import NDArray

from sphear.results.figure.spread import spread
from sphear.results.figure.style import FAINT, FONT_SIZE, INK, Curve, grid, key, look, styled

PANEL = (5.6, 4.0)
Points = tuple[NDArray[np.float64], NDArray[np.float64]]


@dataclass(frozen=True)
class Convergence:
    """One panel of curves on logarithmic axes.

    Attributes:
        series: The curves by name. A name of several words is a variant of the first and drawn dotted.
        ylabel: What they show.
        reference_slopes: Slopes to compare with, each drawn under the curve whose own slope is the nearest.
        published: Values of a paper, drawn as open markers in the colour of the series of that name.
        levels: Horizontal lines, by name.
    """

    series: Mapping[str, Curve]
    ylabel: str
    reference_slopes: Sequence[float] = ()
    published: Mapping[str, Curve] = field(default_factory=dict)
    levels: Mapping[str, float] = field(default_factory=dict)


def loglog_convergence(
    series: Mapping[str, Curve], xlabel: str, ylabel: str, title: str, reference_slopes: Sequence[float] = ()
) -> Figure:
    """Draw curves on logarithmic axes, each named at its right end."""
    return convergence_panels([Convergence(series, ylabel, reference_slopes)], xlabel, title)


@styled
def convergence_panels(panels: Sequence[Convergence], xlabel: str, title: str) -> Figure:
    """Draw panels of curves on logarithmic axes side by side, such as two readings of one error."""
    figure, axes = grid(len(panels), len(panels), PANEL, title)
    levels: dict[str, Line2D] = {}
    for ax, panel in zip(axes, panels, strict=True):
        ax.set(xscale="log", yscale="log", xlabel=xlabel, ylabel=panel.ylabel)
        curves = {name: _positive(curve) for name, curve in panel.series.items()}
        drawn: list[Points] = []
        for name, curve in curves.items():
            _draw(ax, name, curve, on_top=any(_coincide(curve, other) for other in drawn))
            drawn.append(curve)
        for name, values in panel.published.items():
            ax.plot(*_positive(values), look(name).marker, color=look(name).colour, fillstyle="none", markersize=11)
        for name, level in panel.levels.items():
            dashes: Any = ("--", ":", "-.")[len(levels) % 3]
            ax.axhline(level, color=INK, linestyle=dashes, linewidth=1.0, zorder=1.5)
            levels[name] = Line2D([], [], color=INK, linestyle=dashes, linewidth=1.0)
        for slope in panel.reference_slopes:
            _draw_slope(ax, slope, drawn)
        _tick_at_points(ax, drawn)
        _name_ends(ax, curves)
    if any(panel.published for panel in panels):
        levels |= {
            "computed": Line2D([], [], color=FAINT, marker="o"),
            "published": Line2D([], [], color=FAINT, marker="o", fillstyle="none", linestyle="none", markersize=9),
        }
    if levels:
        key(figure, levels)
    return figure


def _positive(curve: Curve) -> Points:
    """Return what logarithmic axes can show of a curve."""
    x, y = np.asarray(curve[0], float), np.asarray(curve[1], float)
    shown = np.isfinite(y) & (y > 0) & (x > 0)
    return x[shown], y[shown]


def _coincide(one: Points, other: Points) -> bool:
    """Return whether one curve would hide the other."""
    return all(a.shape == b.shape and np.allclose(a, b, rtol=0.1, atol=0) for a, b in zip(one, other, strict=True))


def _draw(ax: Axes, name: str, curve: Points, on_top: bool) -> None:
    """Draw a curve, dashed and with smaller markers where it lies on top of another one."""
    colour, marker = look(name)
    dashes = ":" if " " in name else "--" if on_top else "-"
    size = 4.0 if on_top else 8.0
    ax.plot(*curve, dashes, color=colour, zorder=2.2 if on_top else 2.1)
    ax.plot(*curve, marker, color=colour, markersize=size, markeredgecolor="white", markeredgewidth=0.8, zorder=3)


def _slope(curve: Points) -> float:
    """Return the slope of the straight line nearest to a curve on logarithmic axes."""
    x, y = curve
    return float(np.polyfit(np.log(x), np.log(y), 1)[0])


def _draw_slope(ax: Axes, slope: float, curves: Sequence[Points]) -> None:
    """Draw a line of the given slope under the lowest of the curves whose own slope is, to a quarter, the nearest."""
    curves = [(x, y) for x, y in curves if np.unique(x).size > 1]
    if not curves:
        return
    x, y = min(curves, key=lambda curve: (round(4 * abs(_slope(curve) - slope)), np.log(curve[1]).mean()))
    ends = np.array([x.min(), x.max()])
    factor = 0.6 * (y / x**slope).min()
    ax.plot(ends, factor * ends**slope, color=FAINT, linewidth=0.9, linestyle=(0, (6, 3)), zorder=1.5)
    middle = float(np.sqrt(ends.prod()))
    number = f"{slope:g}".replace("-", "−")
    # on the side of the line that falls away from the curve
    offset, side = (4, "left") if slope > 0 else (-4, "right")
    ax.annotate(
        f"slope {number}",
        (middle, factor * middle**slope),
        (offset, -3),
        textcoords="offset points",
        zorder=1.6,
        color=FAINT,
        horizontalalignment=side,
        verticalalignment="top",
        bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.5},
    )


def _tick_at_points(ax: Axes, curves: Sequence[Points]) -> None:
    """Put the ticks of the x axis where there are points, if it has room for them."""
    points = np.unique(np.concatenate([x for x, _ in curves] or [np.empty(0)]))
    gaps = np.diff(np.log(points))
    if points.size and (gaps >= 0.1 * gaps.sum()).all():
        ax.set_xticks(points, labels=[f"{x:.3g}" if x < 1000 else f"{x:.0f}" for x in points])
        ax.xaxis.set_minor_locator(NullLocator())


def _name_ends(ax: Axes, curves: Mapping[str, Points]) -> None:
    """Name each curve at the right, level with its end as far as the names leave room for each other."""
    ends = sorted((float(y[x.argmax()]), float(x.max()), name) for name, (x, y) in curves.items() if x.size)
    if not ends:
        return
    bottom, top = np.log(ax.get_ylim())
    levels = [(np.log(y) - bottom) / (top - bottom) for y, _, _ in ends]
    line = 1.35 * FONT_SIZE / (72 * 0.8 * PANEL[1])  # the height of a name as a fraction of the panel's
    for (y, x, name), height in zip(ends, spread(levels, line), strict=True):
        colour = look(name).colour
        ax.annotate(
            name,
            (x, y),
            (1.05, height),
            textcoords="axes fraction",
            color=colour,
            verticalalignment="center",
            annotation_clip=False,
            arrowprops={"arrowstyle": "-", "color": colour, "linewidth": 0.5, "relpos": (0, 0.5), "shrinkB": 5},
        )
