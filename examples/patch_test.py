"""The patch test: how exactly viscous terms give the Laplacian of a field that is known.

The field sin(2 pi x) sin(2 pi y) has the Laplacian -8 pi^2 times itself. Each term computes it on particles that are
jittered by 0.3 spacings, as disordered as those of a flow. Look at the slopes: the error of `morris` grows as particles
become smaller, that of `fatehi_manzari` falls at an order between 1 and 2, and that of `least_squares_3`, which is
exact for cubic fields, at second order.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import sphear

TERMS = ("morris", "fatehi_manzari", "least_squares_3")
COLOURS = ("#0072b2", "#e69f00", "#009e73")


def main(resolution: int = 160, folder: Path | None = None) -> dict[str, float]:
    """The order of each term's mean error from half the resolution to the resolution.

    Args:
        resolution: most particles a side.
        folder: gets a picture.
    """
    sizes = tuple(resolution // parts for parts in (8, 4, 2, 1) if resolution // parts >= 20)
    test = sphear.PatchTest(
        viscosity=TERMS, sizes=sizes, field="sin(2*pi*x) * sin(2*pi*y)", jitter=0.3, seeds=4, threads=1
    )
    rows = test.rows()
    if folder is not None:
        draw(rows, folder / "patch_test.png")
    return {f"order of {row['viscosity']}": row["order"] for row in rows if row["particles"] == resolution}


def draw(rows: list[dict[str, Any]], path: Path) -> None:
    """Errors against the spacing."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(5.2, 3.8), layout="constrained")
    axes = figure.add_subplot(xlabel="spacing", ylabel="mean error of the Laplacian", xscale="log", yscale="log")
    for term, colour, marker in zip(TERMS, COLOURS, "os^", strict=True):
        mine = [row for row in rows if row["viscosity"] == term]
        axes.plot(
            [row["dx"] for row in mine], [row["l1"] for row in mine], color=colour, marker=marker, ms=5, label=term
        )
    axes.set_xticks([row["dx"] for row in mine], [f"1/{row['particles']}" for row in mine])
    axes.minorticks_off()
    axes.set_title("Laplacian on jittered particles", loc="left")
    axes.grid(color="#e6e6e6")
    axes.legend(frameon=False)
    figure.savefig(path, dpi=110)


if __name__ == "__main__":
    for name, value in main(folder=Path()).items():
        print(f"{name}: {value:.2f}")
