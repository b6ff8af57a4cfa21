"""A dam that breaks: a column of water twice as high as wide collapses in a tank.

Only a part of the region is filled at the start, and the fluid has a free surface: no pressure there. Lengths are in
column widths, and gravity is 1. Martin & Moyce (1952, Phil. Trans. R. Soc. A 244:312, table 2) measured where the front
on the floor is, against the time T = t sqrt(2 g / a). Look at the mean deviation from their front, in column widths:
water behind a gate that is pulled away starts later than here. It then runs at nearly the same speed: look at that of
the front, from its place at 1.9 widths to the last that was measured, over the measured one.
"""

from __future__ import annotations

from math import sqrt
from pathlib import Path
from typing import Any

import numpy as np

import sphear

SPEED = sqrt(2.0)  # sqrt(g h) of the column's height h = 2
MEASURED = np.array([
    (0.41, 1.11), (0.84, 1.22), (1.19, 1.44), (1.43, 1.67), (1.63, 1.89), (1.83, 2.11), (1.98, 2.33), (2.20, 2.56),
    (2.32, 2.78), (2.51, 3.00), (2.65, 3.22), (2.83, 3.44), (2.98, 3.67), (3.11, 3.89), (3.33, 4.11),
])  # fmt: skip
Array = np.ndarray[Any, Any]


def main(resolution: int = 20, folder: Path | None = None) -> dict[str, float]:
    """The mean deviation of the front from the measured one, and its speed from 1.9 widths on over the measured one.

    Args:
        resolution: particles over the width of the column.
        folder: gets a picture.
    """
    spacing = 1 / resolution
    front = sphear.Call(lambda run: (run.time * SPEED, run.positions[:, 0].max() + spacing / 2), every=0.02)
    pictures = sphear.Snapshots(every=1.1 / SPEED)
    simulation = sphear.Simulation(
        sphear.Rectangle((0, 0), (6, 4)),
        filled=sphear.Rectangle((0, 0), (1, 2)),
        spacing=spacing,
        fluid=sphear.Fluid(kinematic_viscosity=SPEED / 1000),
        body_force=(0, -1),
        scheme=sphear.Incompressible(continuation="linear"),
        speed=2 * SPEED,
        length=1.0,
        observers=[front, pictures],
    )
    simulation.run(until=3.34 / SPEED)
    times, fronts = np.array(front.rows).T
    if folder is not None:
        draw(times, fronts, pictures.rows, folder / "dam_break.png")
    places = np.interp(MEASURED[:, 0], times, fronts)
    reached = np.interp(MEASURED[[4, -1], 1], fronts, times)
    return {
        "mean deviation of the front": float(np.abs(places - MEASURED[:, 1]).mean()),
        "speed of the front over the measured one": float(np.diff(MEASURED[[4, -1], 0])[0] / np.diff(reached)[0]),
    }


def draw(times: Array, fronts: Array, pictures: list[Any], path: Path) -> None:
    """The water at some times, and the front against time."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(7.4, 3.4), layout="constrained")
    panels = figure.subplot_mosaic(
        [["water 0", "water 1", "front"], ["water 2", "water 3", "front"]], width_ratios=[1, 1, 1.3]
    )
    for number, picture in enumerate(pictures[:4]):
        x, y = picture.positions.T
        axes = panels[f"water {number}"]
        axes.scatter(x, y, c=np.hypot(*picture.velocities.T), s=1.5, cmap="viridis", vmin=0, vmax=2 * SPEED, lw=0)
        axes.set(xlim=(0, 4.5), ylim=(0, 2.2), aspect="equal", xticks=range(5), title=f"T = {picture.time * SPEED:.1f}")
    axes = panels["front"]
    axes.plot(times, fronts, color="#0072b2", label="particles")
    axes.plot(*MEASURED.T, "o", color="#333333", ms=4, label="Martin & Moyce 1952")
    axes.set(xlabel="T = t sqrt(2 g / a)", ylabel="front over the width of the column")
    axes.grid(color="#e6e6e6")
    axes.legend(frameon=False, loc="upper left", fontsize="small")
    figure.savefig(path, dpi=110)


if __name__ == "__main__":
    for name, value in main(folder=Path()).items():
        print(f"{name}: {value:.3f}")
