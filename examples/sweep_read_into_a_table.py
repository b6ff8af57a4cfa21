"""A sweep whose results are read into a table.

Taylor-Green vortices are computed for all combinations of three Reynolds numbers and three resolutions, by two
processes. Each result is stored as it comes; the same call later takes what is stored and computes what is missing.
Results are read into a NumPy table, printed and drawn. Look at the error of the velocities against the exact decay:
it falls with the spacing at each Reynolds number.
"""

from __future__ import annotations

from math import log
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

import sphear

REYNOLDS = (10.0, 100.0, 1000.0)
Array = np.ndarray[Any, Any]


def main(resolution: int = 48, folder: Path | None = None, workers: int = 2) -> dict[str, float]:
    """The largest error at the finest resolution, and the observed order from half of it to it at Re = 100.

    Args:
        resolution: most particles a side.
        folder: gets a picture, and the results in `sweep`; None forgets the results.
        workers: processes.
    """
    sizes = [resolution // 2, resolution * 3 // 4, resolution]
    over = {"reynolds": REYNOLDS, "resolution": sizes}
    runs = sphear.plan("taylor-green", over, {"scheme": "incompressible", "until": 0.2})
    with TemporaryDirectory() as forgotten:
        store = sphear.Store(forgotten if folder is None else folder / "sweep")
        results = sphear.run_sweep(runs, store, workers=workers)
    table = np.array([
        (result.settings["reynolds"], result.settings["resolution"], result.metrics["l2_error"])
        for result in results
    ], dtype=[("reynolds", float), ("resolution", int), ("error", float)])  # fmt: skip
    errors = table["error"].reshape(len(REYNOLDS), len(sizes))
    if folder is not None:
        show(table)
        draw(sizes, errors, folder / "sweep_read_into_a_table.png")
    coarsest, *_, finest = errors[REYNOLDS.index(100.0)]
    return {"error at the finest spacing": float(errors[:, -1].max()), "order at Re = 100": log(coarsest / finest, 2)}


def show(table: Array) -> None:
    """A line for each run."""
    print("Reynolds  resolution     error")
    for reynolds, size, error in table:
        print(f"{reynolds:8g}  {size:10d}  {error:8.5f}")


def draw(sizes: list[int], errors: Array, path: Path) -> None:
    """The error against the spacing, a line for each Reynolds number."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(5.2, 3.8), layout="constrained")
    axes = figure.add_subplot(xlabel="spacing", ylabel="error of the velocities", xscale="log", yscale="log")
    spacings = 1 / np.array(sizes)
    for reynolds, row, colour, marker in zip(REYNOLDS, errors, ("#0072b2", "#e69f00", "#009e73"), "os^", strict=True):
        axes.plot(spacings, row, color=colour, marker=marker, label=f"Re = {reynolds:g}")
    axes.set_xticks(spacings, [f"1/{size}" for size in sizes])
    axes.set_yticks([0.01, 0.02, 0.04], ["0.01", "0.02", "0.04"])
    axes.minorticks_off()
    axes.set_title("A sweep over Reynolds number and spacing", loc="left")
    axes.grid(color="#e6e6e6")
    axes.legend(frameon=False)
    figure.savefig(path, dpi=110)


if __name__ == "__main__":  # workers import this file
    for name, value in main(folder=Path()).items():
        print(f"{name}: {value:.5f}")
