"""A drum full of fluid that starts to turn.

The wall of a circle turns and drags the fluid inside, from rest to rigid rotation. The exact velocity around the
axis is W r + 2 W R sum_n J1(a_n r / R) / (a_n J0(a_n)) exp(-a_n^2 nu t / R^2), with the zeros a_n of the Bessel
function J1. Profiles along a diameter are watched on the way. Look at the largest deviation from the series at all
times, in wall speeds, and at the angular momentum in the end, over that of the series.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from scipy.special import j0, j1, jn_zeros

import sphear

RADIUS, SPIN, VISCOSITY = 1.0, 1.0, 0.1
Array = np.ndarray[Any, Any]


def exact(r: Array, time: float) -> Array:
    """The velocity around the axis at the radius r; it is odd in r."""
    a = jn_zeros(1, 60)[:, None]
    waves = j1(a * r / RADIUS) / (a * j0(a)) * np.exp(-(a**2) * VISCOSITY * time / RADIUS**2)
    return np.asarray(SPIN * r + 2 * SPIN * RADIUS * waves.sum(axis=0))


def momentum(time: float) -> float:
    """The angular momentum over that of rigid rotation."""
    a = jn_zeros(1, 60)
    return float(1 - 8 * (np.exp(-(a**2) * VISCOSITY * time / RADIUS**2) / a**2).sum())


def main(resolution: int = 40, folder: Path | None = None) -> dict[str, float]:
    """The largest deviation from the series in wall speeds, and the angular momentum at the end over the exact one.

    Args:
        resolution: particles along a diameter.
        folder: gets a picture.
    """
    diameter = sphear.Profile("v", y=0.0, stations=39, every=0.25)
    simulation = sphear.Simulation(
        sphear.Circle((0, 0), RADIUS),
        spacing=2 * RADIUS / resolution,
        fluid=sphear.Fluid(kinematic_viscosity=VISCOSITY),
        boundaries={"circle": sphear.NoSlip(spin=SPIN)},
        observers=[diameter],
    )
    simulation.run(until=2)
    if folder is not None:
        draw(diameter, folder / "turning_drum.png")
    deviations = [np.abs(values - exact(diameter.at, time)).max() for time, values in diameter.rows]
    x, y = simulation.positions.T
    u, v = simulation.velocities.T
    turning = (x * v - y * u).sum() / (SPIN * (x**2 + y**2).sum())
    return {
        "largest deviation from the series": float(max(deviations) / (SPIN * RADIUS)),
        "angular momentum over the exact one": float(turning / momentum(simulation.time)),
    }


def draw(diameter: sphear.Profile, path: Path) -> None:
    """The profiles on their way to rigid rotation."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(5.4, 4.0), layout="constrained")
    axes = figure.add_subplot(xlabel="x", ylabel="v on the diameter y = 0")
    x = np.linspace(-RADIUS, RADIUS, 301)
    axes.plot(x, SPIN * x, ":", color="#8c8c8c", label="rigid rotation")
    for number, (time, values) in enumerate(diameter.rows[row] for row in (0, 1, 3, -1)):
        colour = f"C{number}"
        axes.plot(x, exact(x, time), color=colour, lw=1, label=f"t = {time:.2f}")
        axes.plot(diameter.at, values, "o", color=colour, ms=3.5)
    axes.set_title("Spin-up of a drum: particles (dots) and series (lines)", loc="left", fontsize="medium")
    axes.grid(color="#e6e6e6")
    axes.legend(frameon=False)
    figure.savefig(path, dpi=110)


if __name__ == "__main__":
    for name, value in main(folder=Path()).items():
        print(f"{name}: {value:.5f}")
