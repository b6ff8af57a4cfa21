"""A flow beside its reference: the profile at the end and the error over time."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import ArrayLike

from sphear.results.figure.style import FAINT, INK, grid, key, look, styled


@styled
def flow_panels(
    y: ArrayLike,
    computed: ArrayLike,
    exact: ArrayLike,
    times: Sequence[float],
    errors: Sequence[float],
    labels: tuple[str, str],
    title: str,
) -> Figure:
    """Draw the velocity u of particles against their y with the exact one, and the error against time."""
    figure, (profile, history) = grid(2, 2, (4.6, 3.6), title)
    y, computed, exact = (np.asarray(a, float) for a in (y, computed, exact))
    order = np.argsort(y)
    colour = look("morris").colour
    profile.plot(y[order], exact[order], color=FAINT)
    profile.plot(y, computed, "o", color=colour, markersize=4, markeredgewidth=0)
    profile.set(xlabel="y", ylabel="u")
    history.plot(times, errors, color=colour)
    history.set(xlabel=labels[0], ylabel=labels[1], yscale="log")
    key(
        figure,
        {"exact": Line2D([], [], color=FAINT), "computed": Line2D([], [], color=INK, marker="o", linestyle="none")},
    )
    return figure
