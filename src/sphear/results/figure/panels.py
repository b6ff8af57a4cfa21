"""Panels of profiles, particles and surfaces."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import AutoLocator
from numpy.typing import ArrayLike

from sphear.results.figure.style import FAINT, INK, Curve, grid, key, look, styled


@dataclass(frozen=True)
class Profile:
    """An exact line and the points computed for it."""

    exact: Curve
    computed: Curve


@styled
def profiles(panels: Mapping[str, Profile], xlabel: str, ylabel: str, title: str) -> Figure:
    """Draw a panel a name, two a row, all with the same axes."""
    figure, axes = grid(len(panels), 2, (3.9, 2.7), title)
    for ax, (name, profile) in zip(axes, panels.items(), strict=True):
        colour, marker = look(name)
        ax.plot(*profile.exact, color=FAINT)
        ax.plot(*profile.computed, marker, color=colour, markersize=6, markeredgecolor="white", markeredgewidth=0.6)
        ax.set(title=name, xlabel=xlabel, ylabel=ylabel)
        ax.sharex(axes[0])
        ax.sharey(axes[0])
    key(
        figure,
        {"exact": Line2D([], [], color=FAINT), "computed": Line2D([], [], color=INK, marker="o", linestyle="none")},
    )
    return figure


@styled
def scatter_panels(panels: Mapping[str, ArrayLike], title: str) -> Figure:
    """Draw where particles are, a panel for each array of positions of shape (N, 2)."""
    figure, axes = grid(len(panels), len(panels), (3.7, 3.7), title)
    for ax, (name, positions) in zip(axes, panels.items(), strict=True):
        x, y = np.asarray(positions, float).T
        spacing = 72 * 3.0 / math.sqrt(x.size)
        ax.plot(x, y, "o", color=look("morris").colour, markersize=0.5 * spacing, markeredgewidth=0)
        ax.set(title=name, xlabel="x", ylabel="y", aspect="equal")
        ax.sharex(axes[0])
        ax.sharey(axes[0])
    return figure


@styled
def surface_panels(
    panels: Mapping[str, tuple[ArrayLike, ArrayLike, ArrayLike]], xlabel: str, ylabel: str, title: str
) -> Figure:
    """Draw functions of two coordinates as filled contours, white at zero; a panel is x, y and z on a grid."""
    figure, axes = grid(len(panels), len(panels), (4.4, 3.7), title)
    for ax, (name, (x, y, z)) in zip(axes, panels.items(), strict=True):
        largest = float(np.abs(np.asarray(z)).max()) or 1.0
        levels = np.linspace(-largest, largest, 22)
        filled = ax.contourf(x, y, z, levels, cmap="RdBu_r")
        filled.set_edgecolor("face")  # no seams between the bands in a vector file
        ax.contour(x, y, z, levels, colors=INK, linewidths=0.3, alpha=0.4, linestyles="solid")
        ax.set(title=name, xlabel=xlabel, ylabel=ylabel, aspect="equal")
        ax.grid(visible=False)
        figure.colorbar(filled, ax=ax, ticks=AutoLocator())
    return figure
