"""Lifetimes of the readings of the paper's settings, and their disorder over time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

from sphear.studies.rows import failed
from sphear.studies.zheng2018.cavities import UNTIL
from sphear.studies.zheng2018.settings_combinations import BY_NAME

if TYPE_CHECKING:
    from matplotlib.figure import Figure

DRAWN = ("stated", "differences", "least zero", "negative cut", "least zero + slipping", "least zero + alpha 0.1")
COLOURS = ("#333333", "#d55e00", "#0072b2", "#009e73", "#aa4499", "#e69f00")
DASHES: tuple[Literal["-", "--", ":"], ...] = ("-", "--", ":")  # coarse to fine


def figure(data: dict[str, Any]) -> Figure:
    """The disorder over time of some readings, and how long all of them hold."""
    from matplotlib.lines import Line2D

    from sphear.results.figure.style import FAINT, INK, grid, key, styled

    @styled
    def draw() -> Figure:
        rows = data["runs"]
        sizes = sorted({row["resolution"] for row in rows})
        whole, (growing, lasting) = grid(
            2, 2, (5.5, 6.0), "Readings of the paper's settings (Zheng, Ma & Shao 2018), cavity, Re = 1000"
        )
        handles: dict[str, Line2D] = {}
        for row in rows:
            if row["reading"] not in DRAWN or row["until"] == UNTIL or not row["curve"]["time"]:
                continue
            colour = COLOURS[DRAWN.index(row["reading"])]
            dashes = DASHES[sizes.index(row["resolution"]) % len(DASHES)]
            way = [time * row["resolution"] for time in row["curve"]["time"]]
            growing.plot(way, row["curve"]["disorder"], dashes, color=colour, linewidth=1.2)
            handles[f"{row['reading']}, {row['resolution']}"] = Line2D([], [], color=colour, linestyle=dashes)
        growing.set(xlabel="the lid's way / dx", xscale="log", yscale="log", title="Disorder: rms of dx |sum V grad W|")
        names = list(dict.fromkeys(row["reading"] for row in rows))
        for row in rows:
            place = len(names) - 1 - names.index(row["reading"])
            marker = "os^"[sizes.index(row["resolution"]) % 3]
            fill = INK if BY_NAME[row["reading"]].stated else FAINT
            lasting.plot(
                row["time"], place, marker, color=fill, fillstyle="none" if not failed(row) else "full", markersize=5
            )
            handles[f"{row['resolution']} a side"] = Line2D([], [], color=INK, marker=marker, linestyle="none")
        lasting.set_yticks(range(len(names)), names[::-1])
        lasting.set(
            xscale="log",
            xlabel="t of the failure (filled) or of the end (open)",
            title="How long (grey: beyond the text)",
        )
        key(whole, handles)
        return whole

    return draw()
