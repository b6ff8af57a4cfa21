"""Curves of several series, such as energies over time or profiles, beside references."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from sphear.results.figure.style import FAINT, INK, Curve, grid, key, look, styled

REFERENCES: tuple[tuple[Any, str], ...] = (("-", INK), ("--", FAINT), (":", INK))


class HistoryPanel(NamedTuple):
    """One plot.

    title: of the plot.
    curves: by series.
    references: drawn in grey, by name.
    """

    title: str
    curves: Mapping[str, Curve]
    references: Mapping[str, Curve]


@styled
def history_panels(
    panels: Sequence[HistoryPanel], xlabel: str, ylabel: str, title: str, columns: int, points: Sequence[str] = ()
) -> Figure:
    """Draw plots in rows of `columns`; a curve that leaves the references' range far behind is cut off.

    Args:
        panels: the plots.
        xlabel: of all.
        ylabel: of all.
        title: of the figure.
        columns: plots in a row.
        points: names of references that are drawn as points, such as published tables.
    """
    figure, axes = grid(len(panels), columns, (5.0, 3.1), title)
    handles: dict[str, Line2D] = {}
    for ax, panel in zip(axes, panels, strict=True):
        for (name, curve), (dashes, colour) in zip(panel.references.items(), REFERENCES, strict=False):
            if name in points:
                ax.plot(*curve, "s", color=INK, fillstyle="none", markersize=4, zorder=3)
                handles[name] = Line2D([], [], color=INK, marker="s", fillstyle="none", linestyle="none")
            else:
                ax.plot(*curve, dashes, color=colour, linewidth=1.1)
                handles[name] = Line2D([], [], color=colour, linestyle=dashes)
        for name, curve in panel.curves.items():
            ax.plot(*curve, color=look(name).colour, linewidth=1.2)
            handles[name] = Line2D([], [], color=look(name).colour)
        known = [np.asarray(curve[1], float) for curve in panel.references.values()]
        if known:
            low, high = min(y.min() for y in known), max(y.max() for y in known)
            room = 0.3 * (high - low)
            ax.set_ylim(low - room, high + room)
        ax.set(xlabel=xlabel, ylabel=ylabel, title=panel.title)
    key(figure, handles)
    return figure
