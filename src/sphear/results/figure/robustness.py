"""When runs fail, against the Reynolds number, with the error over time beside it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from sphear.results.figure.style import FAINT, grid, key, look, styled

RANGES = ((0.07, 1.5e4), (0.03, 60.0), (0.1, 40.0))  # of Re, t* at the end, and t*: the same in all plots


class Panel(NamedTuple):
    """One pair of plots.

    title: of both.
    ends: by series, a Reynolds number, a time and how the run ended: "failed", "steady" or "steps".
    errors: by series, times and errors of one run.
    """

    title: str
    ends: Mapping[str, Sequence[tuple[float, float, str]]]
    errors: Mapping[str, Sequence[tuple[float, float]]]


@styled
def robustness_panels(panels: Sequence[Panel], title: str) -> Figure:
    """Draw a row a panel: times of failure, filled, and of other ends, open; and errors against time."""
    figure, axes = grid(2 * len(panels), 2, (5.2, 2.9), title)
    names: dict[str, None] = {}
    for row, panel in enumerate(panels):
        left, right = axes[2 * row], axes[2 * row + 1]
        for name, ends in panel.ends.items():
            _ends(left, name, ends)
            names[name] = None
        for name, points in panel.errors.items():
            if points:
                times, errors = zip(*points, strict=True)
                right.plot(times, errors, _dashes(name), color=look(name).colour, linewidth=1.3)
        left.set(xscale="log", yscale="log", xlabel="Re", ylabel="t* at the end", title=panel.title)
        left.set(xlim=RANGES[0], ylim=RANGES[1])
        right.set(xscale="log", yscale="log", xlabel="t*", ylabel="RMS error", title=f"{panel.title}, Re = 0.5")
        right.set(xlim=RANGES[2])
        right.axhline(0.12, color=FAINT, linewidth=0.8)
    handles = {
        name: Line2D([], [], color=look(name).colour, marker=look(name).marker, linestyle=_dashes(name))
        for name in names
    }
    open_ = {"open: did not fail": Line2D([], [], color=FAINT, marker="o", fillstyle="none", linestyle="none")}
    key(figure, handles | open_)
    return figure


def _ends(ax: Axes, name: str, ends: Sequence[tuple[float, float, str]]) -> None:
    colour, marker = look(name)
    ordered = sorted(ends)
    ax.plot([e[0] for e in ordered], [e[1] for e in ordered], _dashes(name), color=colour, linewidth=1.1)
    for reynolds, time, how in ordered:
        fill = "full" if how == "failed" else "none"
        ax.plot(reynolds, time, marker, color=colour, fillstyle=fill, markersize=5.5)


def _dashes(name: str) -> Any:
    return {"cleary_4.24": "--", "cleary_4.96333": ":"}.get(name, "-")
