"""A flow beside its reference: profiles at the end, a metric over time, and the particles."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import ArrayLike, NDArray

from sphear.results.figure.style import FAINT, INK, SOLID, Curve, grid, key, look, styled

if TYPE_CHECKING:
    from sphear.cases.flow import Comparison


RASTERED = 2000  # particles, from which on they are a picture in a vector file too
PANEL = (2.7, 2.5)  # inches, about, that particles are drawn in
_CURVE: dict[str, Any] = {"color": FAINT}
_TABLE: dict[str, Any] = {"color": FAINT, "linestyle": "none", "marker": "s", "fillstyle": "none"}
FINE = 400  # points a side, at which what is solid is looked at
GAP = 1.15  # spacings, as which a particle is drawn wide, so that fluid has no holes


@styled
def flow_panels(
    comparisons: Mapping[str, Comparison],
    history: Curve,
    labels: tuple[str, str],
    title: str,
    particles: tuple[ArrayLike, ArrayLike, float] | None = None,
    reference: tuple[ArrayLike, ArrayLike] | None = None,
    distance: Callable[[NDArray[np.float64]], NDArray[np.float64]] | None = None,
) -> Figure:
    """Draw each profile of a flow with its reference, a metric against time, and the particles by their speed.

    Args:
        comparisons: the profiles, by name.
        history: times, and the metric at each.
        labels: what the times and the metric are called.
        title: of the figure.
        particles: places (N, 2), velocities (N, 2) and their spacing; None draws none.
        reference: times, and the metric that others have at each; None draws none.
        distance: (M,) of places (M, 2) from walls, negative in what is solid; None draws no walls.
    """
    panels = len(comparisons) + 1 + (particles is not None)
    figure, axes = grid(panels, 4 if panels == 4 else 3, (4.0, 3.4), title)
    colour = look("morris").colour
    referred: dict[str, Line2D] = {}
    for ax, (name, profile) in zip(axes, comparisons.items(), strict=False):
        if len(profile.reference_at):
            order = np.argsort(profile.reference_at)
            style = _TABLE if profile.table else _CURVE
            ax.plot(profile.reference_at[order], profile.reference[order], **style)
            referred[_reference(profile.reference_time, labels[0])] = Line2D([], [], **style)
        ax.plot(profile.at, profile.values, "o", color=colour, markersize=3.5, markeredgewidth=0)
        ax.set(xlabel=profile.along, ylabel=name)
    times, values = (np.asarray(x, float) for x in history)
    last = axes[len(comparisons)]
    last.plot(times, values, color=colour)
    last.set(xlabel=labels[0], ylabel=labels[1])
    if reference is not None:
        last.plot(*reference, **_TABLE)
        referred["measured"] = Line2D([], [], **_TABLE)
    if labels[1].endswith("error") and (values[np.isfinite(values)] > 0).all():
        last.set_yscale("log")
    if particles is not None:
        places, velocities, spacing = particles
        draw_particles(axes[-1], np.asarray(places, float), np.asarray(velocities, float), spacing)
        if distance is not None:
            draw_solid(axes[-1], distance)
    if not referred and not comparisons:
        return figure
    drawn: dict[str, Any] = {"color": INK, "marker": "o", "linestyle": "none"} if comparisons else {"color": colour}
    key(figure, referred | {"computed": Line2D([], [], **drawn)})
    return figure


def _reference(time: float | None, named: str) -> str:
    """The label of a reference, whose time may be another than that of the flow."""
    if time is None:
        return "reference"
    return "reference, steady" if math.isinf(time) else f"reference, {named} = {time:g}"


def draw_particles(ax: Axes, places: NDArray[np.float64], velocities: NDArray[np.float64], spacing: float) -> None:
    """The particles by their speed, as wide as they are apart."""
    ax.set(xlabel="x", ylabel="y", aspect="equal", title="speed")
    ax.grid(visible=False)
    width, height = places.max(axis=0) - places.min(axis=0) + spacing
    inches = min(PANEL[0] / width, PANEL[1] / height)
    drawn = ax.scatter(
        places[:, 0],
        places[:, 1],
        c=np.hypot(*velocities.T),
        s=(GAP * 72 * inches * spacing) ** 2,
        cmap="viridis",
        linewidths=0,
        rasterized=len(places) > RASTERED,
    )
    ax.figure.colorbar(drawn, ax=ax)


def draw_solid(ax: Axes, distance: Callable[[NDArray[np.float64]], NDArray[np.float64]]) -> None:
    """Draw the solid within the axes, and a little around."""
    ax.margins(0.02)
    (left, right), (lower, upper) = ax.get_xlim(), ax.get_ylim()
    x, y = np.meshgrid(np.linspace(left, right, FINE), np.linspace(lower, upper, FINE))
    depth = -distance(np.column_stack((x.ravel(), y.ravel()))).reshape(x.shape)
    if (depth > 0).any():
        ax.contourf(x, y, depth, levels=[0.0, np.inf], colors=[SOLID], zorder=0)
