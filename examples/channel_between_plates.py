"""A channel between two plates at rest, in which a constant force starts to drive fluid.

The channel repeats along x. From rest the flow grows to the parabola f y (L - y) / (2 nu); on its way there the exact
velocity is that parabola less a series of sines that decay as exp(-n^2 pi^2 nu t / L^2). The weakly compressible scheme
computes it, and a profile across the channel is watched every twentieth of the viscous time L^2 / nu. Look at the
largest deviation from the series at all those times, in the largest velocity of the parabola.
"""

from __future__ import annotations

from math import pi
from pathlib import Path
from typing import Any

import numpy as np

import sphear

WIDTH, VISCOSITY, FORCE = 1.0, 0.1, 0.8  # the parabola's largest velocity is 1
Array = np.ndarray[Any, Any]


def exact(y: Array, time: float) -> Array:
    """u of the start-up between plates at y = 0 and y = L."""
    n = np.arange(1, 200, 2)[:, None]
    decay = np.exp(-(n**2) * pi**2 * VISCOSITY * time / WIDTH**2)
    waves = 4 * FORCE * WIDTH**2 / (VISCOSITY * (n * pi) ** 3) * np.sin(n * pi * y / WIDTH) * decay
    return np.asarray(FORCE * y * (WIDTH - y) / (2 * VISCOSITY) - waves.sum(axis=0))


def main(resolution: int = 40, folder: Path | None = None) -> dict[str, float]:
    """The largest deviation from the series at any time, and at the end.

    Args:
        resolution: particles across the channel.
        folder: gets a picture.
    """
    profile = sphear.Profile("u", x=0.25, stations=39, every=0.5)
    simulation = sphear.Simulation(
        sphear.Rectangle((0, 0), (0.5, WIDTH)),
        spacing=1 / resolution,
        fluid=sphear.Fluid(kinematic_viscosity=VISCOSITY),
        boundaries={"x": sphear.Periodic()},
        scheme=sphear.WeaklyCompressible(),
        body_force=(FORCE, 0),
        observers=[profile],
    )
    simulation.run(until=6)
    if folder is not None:
        draw(profile, folder / "channel_between_plates.png")
    deviations = [float(np.abs(values - exact(profile.at, time)).max()) for time, values in profile.rows]
    return {"largest deviation from the series": max(deviations), "at the end": deviations[-1]}


def draw(profile: sphear.Profile, path: Path) -> None:
    """The profiles on their way to the parabola."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(5.2, 4.0), layout="constrained")
    axes = figure.add_subplot(xlabel="u", ylabel="y")
    y = np.linspace(0, WIDTH, 201)
    for number, (time, values) in enumerate(profile.rows[row] for row in (0, 1, 3, -1)):
        axes.plot(exact(y, time), y, color="#333333", lw=1, label="" if number else "series")
        axes.plot(values, profile.at, "o", color="#0072b2", ms=3.5, label="" if number else "particles")
        tip = exact(np.array([WIDTH / 2]), time)[0]
        axes.annotate(f"t = {time:.1f}", (tip, WIDTH / 2), (4, 0), textcoords="offset points", rotation=90, va="center")
    axes.set_xlim(right=1.08)
    axes.set_title("Start-up of a channel", loc="left")
    axes.grid(color="#e6e6e6")
    axes.legend(frameon=False, loc="upper right")
    figure.savefig(path, dpi=110)


if __name__ == "__main__":
    for name, value in main(folder=Path()).items():
        print(f"{name}: {value:.5f}")
