"""The style of all figures: settings, the look of each viscous term, the grid of panels, how a figure is saved."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

import matplotlib
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import ArrayLike

Curve = tuple[ArrayLike, ArrayLike]
"""The x and the y of some points."""

INK = "#333333"
FAINT = "#8c8c8c"
SOLID = "#d9d9d9"
FONT_SIZE = 9.0
KEY_WIDTH = 1.7  # inches that an entry of the key takes

# Matplotlib looks settings up when it draws as well as when it saves: what does either is decorated.
styled = matplotlib.rc_context(
    {
        "axes.axisbelow": True,
        "axes.edgecolor": FAINT,
        "axes.grid": True,
        "axes.labelcolor": INK,
        "axes.spines.right": False,
        "axes.spines.top": False,
        "axes.titlelocation": "left",
        "axes.titlesize": "medium",
        "figure.titlesize": "large",
        "figure.titleweight": "bold",
        "font.size": FONT_SIZE,
        "grid.color": "#e6e6e6",
        "grid.linewidth": 0.6,
        "legend.frameon": False,
        "lines.linewidth": 1.6,
        "svg.hashsalt": "sphear",  # the same figure is the same file
        "text.color": INK,
        "xtick.color": FAINT,
        "xtick.labelcolor": INK,
        "ytick.color": FAINT,
        "ytick.labelcolor": INK,
    }
)


class Look(NamedTuple):
    """The colour and marks of a viscous term."""

    colour: str
    marker: str


# Colours of Okabe & Ito and of Tol, told apart with any colour vision; those often drawn together differ most.
LOOKS = {
    "morris": Look("#0072b2", "o"),
    "gotoh": Look("#e69f00", "s"),
    "schwaiger": Look("#009e73", "^"),
    "oger": Look("#aa4499", "D"),
    "takeda": Look("#d55e00", "v"),
    "two_pass": Look("#56b4e9", "P"),
    "violeau": Look("#117733", "X"),
    "cleary": Look("#882255", "h"),
    "monaghan": Look("#999933", "<"),
    "espanol_revenga": Look("#44aa99", ">"),
    "fatehi_manzari": Look("#332288", "p"),
    "least_squares": Look("#cc6677", "*"),
}


def look(name: str) -> Look:
    """Return how a series is drawn: "gotoh as printed" looks like "gotoh", "cleary_4.24" like "cleary"."""
    word = name.partition(" ")[0]
    return LOOKS.get(word) or LOOKS.get(word.rpartition("_")[0], Look(INK, "d"))


def grid(panels: int, columns: int, size: tuple[float, float], title: str) -> tuple[Figure, list[Axes]]:
    """Return a figure of equal panels, each of the given width and height in inches, in rows of `columns`."""
    rows = math.ceil(panels / columns)
    figure = Figure((columns * size[0], rows * size[1] + 0.4), layout="compressed")
    figure.suptitle(title, x=0.012, horizontalalignment="left")
    return figure, [figure.add_subplot(rows, columns, k + 1) for k in range(panels)]


def key(figure: Figure, handles: Mapping[str, Line2D]) -> None:
    """Explain what is drawn, below all panels so that no point is covered."""
    columns = min(len(handles), max(1, int(figure.get_figwidth() / KEY_WIDTH)))
    figure.legend(list(handles.values()), list(handles), loc="outside lower center", ncols=columns)


@styled
def save(figure: Figure, path: Path, suffix: str) -> None:
    """Write a figure as PNG (150 dots an inch) or SVG; nothing in the file depends on when it is written."""
    figure.savefig(path, format=suffix, dpi=150, metadata={"Date": None} if suffix == "svg" else None)
