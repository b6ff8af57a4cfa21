"""Convergence: the error of a whole flow against the spacing of its particles.

The vortices of Taylor & Green are an exact solution of the Navier-Stokes equations; they decay as exp(-2 nu k^2 t).
The same flow is computed with finer and finer particles. Look at the observed order, the slope of the error of the
velocities in a double logarithmic picture. It is 3 where particles are coarse and falls to 1, as second derivatives
have on particles that the flow has disordered.
"""

from __future__ import annotations

from math import exp, log, pi
from pathlib import Path
from typing import Any

import numpy as np

import sphear

VISCOSITY, K, END = 0.02, 2 * pi, 0.3
Array = np.ndarray[Any, Any]


def vortices(positions: Array) -> Array:
    """The velocities (N, 2) of four vortices in the unit square."""
    x, y = K * positions.T
    return np.stack((-np.cos(x) * np.sin(y), np.sin(x) * np.cos(y)), axis=1)


def error(resolution: int) -> float:
    """The root mean square error of the velocities at the end, in the largest velocity at the start.

    Args:
        resolution: particles a side.
    """
    simulation = sphear.Simulation(
        sphear.Rectangle((0, 0), (1, 1)),
        spacing=1 / resolution,
        fluid=sphear.Fluid(kinematic_viscosity=VISCOSITY),
        boundaries={"x": sphear.Periodic(), "y": sphear.Periodic()},
        velocity=vortices,
    )
    simulation.run(until=END)
    exact = exp(-2 * VISCOSITY * K**2 * simulation.time) * vortices(simulation.positions)
    return float(np.sqrt(((simulation.velocities - exact) ** 2).sum(axis=1).mean()))


def main(resolution: int = 80, folder: Path | None = None) -> dict[str, float]:
    """The observed order from twice the spacing to the spacing, and the error there.

    Args:
        resolution: most particles a side.
        folder: gets a picture.
    """
    sizes = [round(resolution / 2 ** (half / 2)) for half in (4, 3, 2, 1, 0)]
    errors = [error(size) for size in sizes]
    if folder is not None:
        draw(sizes, errors, folder / "convergence.png")
    return {"observed order": log(errors[-3] / errors[-1], 2), "error of the velocities": errors[-1]}


def draw(sizes: list[int], errors: list[float], path: Path) -> None:
    """The error against the spacing, beside lines of first and third order."""
    from matplotlib.figure import Figure

    spacings = 1 / np.array(sizes)
    figure = Figure(figsize=(5.2, 3.8), layout="constrained")
    axes = figure.add_subplot(xlabel="spacing", ylabel="error of the velocities", xscale="log", yscale="log")
    axes.plot(spacings, errors[0] * (spacings / spacings[0]) ** 3, ":", color="#8c8c8c", label="third order")
    axes.plot(spacings, errors[-1] * spacings / spacings[-1], "--", color="#8c8c8c", label="first order")
    axes.plot(spacings, errors, "o-", color="#0072b2", label="Taylor-Green vortices")
    axes.set_xticks(spacings, [f"1/{size}" for size in sizes])
    axes.minorticks_off()
    axes.set_title("Error of a flow against the spacing", loc="left")
    axes.grid(color="#e6e6e6")
    axes.legend(frameon=False)
    figure.savefig(path, dpi=110)


if __name__ == "__main__":
    for name, value in main(folder=Path()).items():
        print(f"{name}: {value:.5f}")
