"""A flow beside its reference: profiles at the end, and a metric over time."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from sphear.results.figure.style import FAINT, INK, Curve, grid, key, look, styled

if TYPE_CHECKING:
    from sphear.cases.flow import Comparison


@styled
def flow_panels(comparisons: Mapping[str, Comparison], history: Curve, labels: tuple[str, str], title: str) -> Figure:
    """Draw each profile of a flow with its reference, and a metric against time.

    Args:
        comparisons: the profiles, by name.
        history: times, and the metric at each.
        labels: what the times and the metric are called.
        title: of the figure.
    """
    figure, axes = grid(len(comparisons) + 1, 3, (4.0, 3.4), title)
    colour = look("morris").colour
    referred = False
    for ax, (name, profile) in zip(axes, comparisons.items(), strict=False):
        if len(profile.reference_at):
            order = np.argsort(profile.reference_at)
            ax.plot(profile.reference_at[order], profile.reference[order], color=FAINT)
            referred = True
        ax.plot(profile.at, profile.values, "o", color=colour, markersize=3.5, markeredgewidth=0)
        ax.set(xlabel=profile.along, ylabel=name)
    times, values = (np.asarray(x, float) for x in history)
    last = axes[len(comparisons)]
    last.plot(times, values, color=colour)
    last.set(xlabel=labels[0], ylabel=labels[1])
    if labels[1].endswith("error") and (values[np.isfinite(values)] > 0).all():
        last.set_yscale("log")
    lines = {"computed": Line2D([], [], color=INK, marker="o", linestyle="none")}
    key(figure, ({"reference": Line2D([], [], color=FAINT)} if referred else {}) | lines)
    return figure
