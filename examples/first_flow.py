"""A first flow: a square of fluid whose lid slides, the lid-driven cavity at Re = 100.

The incompressible Navier-Stokes equations are solved from rest until the flow no longer changes. The lid drags fluid to
the right, which turns round in one large vortex. Look at the least u on the vertical centreline: Botella & Peyret
(1998) have -0.2140 lid speeds at Re = 100, and the value here approaches it as particles become smaller.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

import sphear

LEAST_U = -0.2140424  # Botella & Peyret 1998, Comput. Fluids 27:421


def main(resolution: int = 40, folder: Path | None = None) -> dict[str, float]:
    """The least u on the centreline, and its deviation from the published one, in parts of that.

    Args:
        resolution: particles a side.
        folder: gets a picture.
    """
    centreline = sphear.Profile("u", x=0.5)
    simulation = sphear.Simulation(
        sphear.Rectangle((0, 0), (1, 1)),
        spacing=1 / resolution,
        fluid=sphear.Fluid(kinematic_viscosity=0.01),
        boundaries={"upper": sphear.NoSlip(velocity=(1, 0))},
        observers=[centreline],
    )
    simulation.run(until=15)
    if folder is not None:
        draw(simulation, folder / "first_flow.png")
    least = float(centreline.values.min())
    return {"least u on the centreline": least, "deviation from the published one": least / LEAST_U - 1}


def draw(simulation: sphear.Simulation, path: Path) -> None:
    """The speed, and lines along the velocity, on a grid between the particles."""
    from matplotlib.figure import Figure
    from scipy.interpolate import griddata

    x, y = np.meshgrid(np.linspace(0, 1, 81), np.linspace(0, 1, 81))
    u, v = griddata(simulation.positions, simulation.velocities, (x, y)).transpose(2, 0, 1)
    near = griddata(simulation.positions, simulation.velocities, (x, y), method="nearest").transpose(2, 0, 1)
    u, v = np.where(np.isnan((u, v)), near, (u, v))  # within half a spacing of walls
    figure = Figure(figsize=(5.2, 4.4), layout="constrained")
    axes = figure.add_subplot(aspect="equal", xlabel="x", ylabel="y", title="Lid-driven cavity, Re = 100")
    speed = axes.contourf(x, y, np.hypot(u, v), levels=np.linspace(0, 1, 21), cmap="viridis")
    axes.streamplot(x, y, u, v, color="white", density=1.1, linewidth=0.7, arrowsize=0.8)
    figure.colorbar(speed, label="speed, in lid speeds", ticks=[0, 0.2, 0.4, 0.6, 0.8, 1])
    axes.set(xlim=(0, 1), ylim=(0, 1))
    figure.savefig(path, dpi=100)


if __name__ == "__main__":
    for name, value in main(folder=Path()).items():
        print(f"{name}: {value:.4f}")
