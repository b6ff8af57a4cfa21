"""Velocities of particles as arrows."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from sphear.results.figure.style import grid, styled


@styled
def vector_panels(panels: Mapping[str, tuple[ArrayLike, ArrayLike]], title: str) -> Figure:
    """Draw an arrow a particle, coloured by its speed; a panel is positions (N, 2) and velocities (N, 2)."""
    figure, axes = grid(len(panels), len(panels), (5.4, 4.9), title)
    for ax, (name, (positions, velocities)) in zip(axes, panels.items(), strict=True):
        x, v = np.asarray(positions, float), np.asarray(velocities, float)
        speed = np.hypot(v[:, 0], v[:, 1])
        arrows = ax.quiver(x[:, 0], x[:, 1], v[:, 0], v[:, 1], speed, cmap="viridis", scale=12, width=0.0022)
        ax.set(title=name, xlabel="x", ylabel="y", aspect="equal")
        ax.grid(visible=False)
        figure.colorbar(arrows, ax=ax, label="speed", shrink=0.85)
    return figure
