"""Velocity fields of a plane flow: arrows over particles, and magnitudes beside profiles."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.lines import Line2D
from matplotlib.patches import Circle
from numpy.typing import ArrayLike, NDArray

from sphear.results.figure.history import REFERENCES
from sphear.results.figure.style import FAINT, INK, SOLID, Curve, grid, key, look, styled

NOT_COMPUTED = "not computed"
PARTICLE = "#d55e00"
ROOM = 0.03  # around the unit square


@dataclass(frozen=True)
class Field:
    """A velocity field in the unit square.

    Attributes:
        u, v: velocities at the centres of M x M equal squares, row by row from below; not finite where there is no
            fluid.
        particles: places (N, 2); None where they are not known.
        cylinder: its centre and its radius; None where there is none.
    """

    u: NDArray[np.float64]
    v: NDArray[np.float64]
    particles: NDArray[np.float64] | None = None
    cylinder: tuple[float, float, float] | None = None

    @property
    def ticks(self) -> NDArray[np.float64]:
        """The coordinates of the centres."""
        return (np.arange(len(self.u)) + 0.5) / len(self.u)

    @property
    def speed(self) -> NDArray[np.float64]:
        """|u|."""
        return np.hypot(self.u, self.v)


@dataclass(frozen=True)
class ProfilePanel:
    """A plot of one profile.

    Attributes:
        title: of the plot.
        labels: of its axes.
        curves: by series.
        references: lines by name, drawn in grey.
        tables: published points by name.
        insets: each a window of the horizontal axis and where the enlarged part is drawn: left, bottom, width and
            height in parts of the plot.
    """

    title: str
    labels: tuple[str, str]
    curves: Mapping[str, Curve]
    references: Mapping[str, Curve] = field(default_factory=dict)
    tables: Mapping[str, Curve] = field(default_factory=dict)
    insets: Sequence[tuple[tuple[float, float], tuple[float, float, float, float]]] = ()


@styled
def field_vectors(
    panels: Mapping[str, Field | None], title: str, cylinder: tuple[float, float, float] | None = None
) -> Figure:
    """Draw an arrow for each velocity, over the particles; with a cylinder, the set-up before.

    Args:
        panels: fields by title; None where nothing was computed.
        title: of the figure.
        cylinder: its centre and its radius, to draw what is set up.
    """
    count = len(panels) + (cylinder is not None)
    figure, axes = _apart(*grid(count, count, (5.4, 4.9), title))
    if cylinder is not None:
        _setup(axes[0], cylinder)
    for ax, (name, shown) in zip(axes[count - len(panels) :], panels.items(), strict=True):
        _square(ax, name)
        if shown is None:
            _nothing(ax)
            continue
        _solid(ax, shown.cylinder)
        if shown.particles is not None:
            size = 72 * 1.3 / np.sqrt(max(len(shown.particles), 1))
            ax.plot(*shown.particles.T, "o", color=PARTICLE, markersize=size, markeredgewidth=0, alpha=0.55)
        x, y = np.meshgrid(shown.ticks, shown.ticks)
        inside = np.isfinite(shown.speed)
        arrows = ax.quiver(
            x[inside], y[inside], shown.u[inside], shown.v[inside], shown.speed[inside],
            cmap="viridis", scale=12, width=0.0026, clim=(0.0, 1.0), zorder=2.5,
        )  # fmt: skip
        figure.colorbar(arrows, ax=ax, label="speed", shrink=0.8)
    if any(shown is not None and shown.particles is not None for shown in panels.values()):
        dot = Line2D([], [], color=PARTICLE, marker="o", linestyle="none", markersize=3, alpha=0.7)
        key(figure, {"particles": dot})
    return figure


@styled
def field_and_profiles(shown: Field | None, name: str, profiles: Sequence[ProfilePanel], title: str) -> Figure:
    """Draw the magnitude of a field, and profiles beside references."""
    figure, axes = _apart(*grid(1 + len(profiles), 1 + len(profiles), (4.8, 4.2), title))
    _square(axes[0], name)
    if shown is None:
        _nothing(axes[0])
    else:
        levels = np.linspace(0.0, 1.0, 21)
        filled = axes[0].contourf(*_with_walls(shown), levels, cmap="viridis", extend="max")
        filled.set_edgecolor("face")
        _solid(axes[0], shown.cylinder)
        figure.colorbar(filled, ax=axes[0], label="speed", shrink=0.8, ticks=np.linspace(0, 1, 6))
    _draw_profiles(figure, axes[1:], profiles)
    return figure


@styled
def inset_profiles(panels: Sequence[ProfilePanel], title: str) -> Figure:
    """Draw profiles side by side, parts of them enlarged."""
    figure, axes = grid(len(panels), len(panels), (6.6, 5.0), title)
    _draw_profiles(figure, axes, panels)
    return figure


def _apart(figure: Figure, axes: list[Axes]) -> tuple[Figure, list[Axes]]:
    """Room between a bar of colours and the next plot."""
    engine = figure.get_layout_engine()
    if isinstance(engine, ConstrainedLayoutEngine):
        engine.set(wspace=0.06)
    return figure, axes


def _draw_profiles(figure: Figure, axes: Sequence[Axes], panels: Sequence[ProfilePanel]) -> None:
    handles: dict[str, Line2D] = {}
    for ax, panel in zip(axes, panels, strict=True):
        ax.set(xlabel=panel.labels[0], ylabel=panel.labels[1], title=panel.title)
        handles |= _profile(ax, panel, 1.0)
        if not panel.curves:
            _nothing(ax)
        for window, place in panel.insets:
            _inset(ax, panel, window, place)
    if handles:
        key(figure, handles)


def _profile(ax: Axes, panel: ProfilePanel, scale: float) -> dict[str, Line2D]:
    """Draw all curves of a plot; what to explain of them."""
    handles: dict[str, Line2D] = {}
    for (name, curve), (dashes, colour) in zip(panel.references.items(), REFERENCES, strict=False):
        ax.plot(*curve, dashes, color=colour, linewidth=1.3 * scale)
        handles[name] = Line2D([], [], color=colour, linestyle=dashes)
    for k, (name, curve) in enumerate(panel.tables.items()):
        style: dict[str, Any] = {"color": INK, "marker": "s^"[k % 2], "fillstyle": "none", "linestyle": "none"}
        ax.plot(*curve, markersize=4.5 * scale, zorder=3, **style)
        handles[name] = Line2D([], [], **style)
    for name, curve in panel.curves.items():
        ax.plot(*curve, color=look(name).colour, linewidth=1.2 * scale)
        handles[name] = Line2D([], [], color=look(name).colour)
    return handles


def _inset(
    ax: Axes, panel: ProfilePanel, window: tuple[float, float], place: tuple[float, float, float, float]
) -> None:
    """Draw the part of a plot within a window once more, enlarged."""
    low, high = np.inf, -np.inf
    for x, y in (*panel.references.values(), *panel.tables.values(), *panel.curves.values()):
        values = _within(x, y, window)
        if values.size:
            low, high = min(low, values.min()), max(high, values.max())
    if low > high:
        return
    room = 0.08 * (high - low) or 0.01
    inner = ax.inset_axes(place, xlim=window, ylim=(low - room, high + room))
    _profile(inner, panel, 1.1)
    inner.tick_params(labelsize="x-small", length=2, pad=1.5)
    inner.patch.set_alpha(0.95)
    for spine in inner.spines.values():
        spine.set_visible(True)
    ax.indicate_inset_zoom(inner, edgecolor=FAINT, linewidth=0.7)


def _within(x: ArrayLike, y: ArrayLike, window: tuple[float, float]) -> NDArray[np.float64]:
    at, values = np.asarray(x, float), np.asarray(y, float)
    found: NDArray[np.float64] = values[(at >= window[0]) & (at <= window[1]) & np.isfinite(values)]
    return found


def _square(ax: Axes, name: str) -> None:
    ax.set(title=name, xlabel="x", ylabel="y", aspect="equal", xlim=(-ROOM, 1 + ROOM), ylim=(-ROOM, 1 + ROOM))
    ax.grid(visible=False)


def _nothing(ax: Axes) -> None:
    ax.text(0.5, 0.5, NOT_COMPUTED, transform=ax.transAxes, color=FAINT, ha="center", va="center")


def _with_walls(shown: Field) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """The speed up to the walls, where it is that of the lid or 0, as in a cylinder."""
    ticks = np.concatenate(([0.0], shown.ticks, [1.0]))
    speed = np.pad(np.nan_to_num(shown.speed), 1)
    speed[-1] = 1.0
    return ticks, ticks, speed


def _solid(ax: Axes, cylinder: tuple[float, float, float] | None) -> None:
    ax.plot([0, 0, 1, 1, 0], [1, 0, 0, 1, 1], color=INK, linewidth=0.9)
    if cylinder is not None:
        ax.add_patch(Circle(cylinder[:2], cylinder[2], facecolor=SOLID, edgecolor=INK, linewidth=0.9))


def _setup(ax: Axes, cylinder: tuple[float, float, float]) -> None:
    """A sketch of the set-up: walls, the lid and its speed, the cylinder and its diameter."""
    x, y, radius = cylinder
    ax.set(title="set-up", aspect="equal", xlim=(-0.13, 1.13), ylim=(-0.13, 1.2))
    ax.set_axis_off()
    _solid(ax, cylinder)
    arrow: dict[str, Any] = {"arrowstyle": "->", "color": INK, "shrinkA": 0, "shrinkB": 0}
    both = {**arrow, "arrowstyle": "<->"}
    ax.annotate("", (0.75, 1.06), (0.25, 1.06), arrowprops=arrow)
    ax.text(0.5, 1.09, "lid: u = 1, v = 0", ha="center", va="bottom")
    ax.annotate("", (x + radius, y), (x - radius, y), arrowprops=both)
    ax.text(x, y + 0.02, f"d = {2 * radius:g}", ha="center", va="bottom")
    ax.text(x, y - 0.03, "fixed,\nno slip", ha="center", va="top", color=FAINT)
    ax.annotate("", (1, -0.05), (0, -0.05), arrowprops=both)
    ax.text(0.5, -0.07, "L = 1", ha="center", va="top")
    ax.annotate("", (-0.05, 1), (-0.05, 0), arrowprops=both)
    ax.text(-0.07, 0.5, "H = 1", ha="right", va="center", rotation=90)
    for place, how in (((0.03, 0.12), "left"), ((0.97, 0.12), "right")):
        ax.text(*place, "u = 0", ha=how, va="center", color=FAINT)
    ax.text(0.5, 0.04, "u = 0", ha="center", va="bottom", color=FAINT)
