"""Channels that start: profiles at several times, beside a wall, and the drift of particles out of their rows."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from matplotlib import colormaps
from matplotlib.figure import Figure

from sphear.results.figure.style import FAINT, INK, Curve, grid, styled

COLOURS = ("#d55e00", "#0072b2", "#009e73", "#aa4499", "#e69f00", "#332288")
MARKERS = "vos^DP"


@dataclass(frozen=True)
class Snapshot:
    """A profile at one time: its name, the exact line and the points computed for it."""

    name: str
    exact: Curve
    computed: Curve


@dataclass(frozen=True)
class Lines:
    """A panel of named curves.

    Attributes:
        curves: by name.
        labels: of the axes.
        exact: a faint line behind them.
        points: markers and no lines.
        logarithmic: the axes that are, such as "y" or "xy".
        second: label of a second horizontal axis, and how many of its units one of the first is.
    """

    curves: Mapping[str, Curve]
    labels: tuple[str, str]
    exact: Curve | None = None
    points: bool = False
    logarithmic: str = ""
    second: tuple[str, float] | None = None


@styled
def snapshots(panels: Mapping[str, Sequence[Snapshot]], xlabel: str, ylabel: str, title: str) -> Figure:
    """Draw a panel a name, with profiles from early ones, dark, to late ones."""
    figure, axes = grid(len(panels), len(panels), (4.6, 3.6), title)
    for ax, (name, profiles) in zip(axes, panels.items(), strict=True):
        shades = colormaps["viridis"](np.linspace(0, 0.9, max(1, len(profiles))))
        for profile, shade in zip(profiles, shades, strict=True):
            ax.plot(*profile.exact, color=FAINT, linewidth=1.0)
            ax.plot(*profile.computed, "o", color=shade, markersize=3.2, markeredgewidth=0, label=profile.name)
        ax.plot([], [], color=FAINT, linewidth=1.0, label="exact")
        ax.set(title=name, xlabel=xlabel, ylabel=ylabel)
        handles, labels = ax.get_legend_handles_labels()
        ax.legend(handles[::-1], labels[::-1], loc="upper left", bbox_to_anchor=(1.0, 1.0), fontsize="small")
    return figure


@styled
def line_panels(panels: Mapping[str, Lines], columns: int, title: str) -> Figure:
    """Draw a panel a name, each with its own key on its right."""
    figure, axes = grid(len(panels), columns, (5.6, 3.4), title)
    for ax, (name, panel) in zip(axes, panels.items(), strict=True):
        if panel.exact is not None:
            ax.plot(*panel.exact, color=FAINT, label="exact")
        for k, (label, curve) in enumerate(panel.curves.items()):
            colour = COLOURS[k % len(COLOURS)] if len(panel.curves) > 1 else INK
            if panel.points:
                ax.plot(*curve, MARKERS[k % len(MARKERS)], color=colour, markersize=5, markeredgewidth=0, label=label)
            else:
                ax.plot(*curve, color=colour, linewidth=1.3, label=label)
        ax.set(xlabel=panel.labels[0], ylabel=panel.labels[1])
        ax.set(xscale="log" if "x" in panel.logarithmic else "linear")
        ax.set(yscale="log" if "y" in panel.logarithmic else "linear")
        ax.set_title(name)
        if panel.second is not None:
            label, scale = panel.second
            other = ax.secondary_xaxis(-0.24, functions=(partial(np.multiply, scale), partial(np.multiply, 1 / scale)))
            other.set_xlabel(label)
        if len(panel.curves) > 1:
            ax.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), fontsize="small")
    return figure
