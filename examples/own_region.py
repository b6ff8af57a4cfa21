"""A region of one's own: a tank with a cylinder that turns and a triangular bar at rest.

Shapes are subtracted from a rectangle, and walls get their conditions by name: "roller" turns, all others are at rest.
The cylinder drags fluid round, which squeezes between it, the bar and the walls. The fluid keeps its volume and no wall
lets any through, so that as much passes to the right as to the left through any line across the tank. Look at the net
flow through one, over the flow that passes there either way: it is zero, exactly; and no particle is in a solid.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

import sphear

RADIUS, SPIN = 0.25, 4.0
REGION = (
    sphear.Rectangle((0, 0), (2, 1))
    - sphear.Circle((0.6, 0.5), RADIUS, name="roller")
    - sphear.Polygon([(1.3, 0.3), (1.7, 0.45), (1.4, 0.7)], name="bar")
)


def main(resolution: int = 40, folder: Path | None = None) -> dict[str, float]:
    """The net flow through x = 0.95 over the flow either way, its mean speed, and how many particles are in solids.

    Args:
        resolution: particles over the height of the tank.
        folder: gets a picture.
    """
    section = sphear.Profile("u", x=0.95, stations=201)
    simulation = sphear.Simulation(
        REGION,
        spacing=1 / resolution,
        fluid=sphear.Fluid(kinematic_viscosity=0.02),
        boundaries={"roller": sphear.NoSlip(spin=SPIN)},
        observers=[section],
    )
    simulation.run(until=4)
    if folder is not None:
        draw(simulation, folder / "own_region.png")
    passing = np.abs(section.values).mean()
    return {
        "net flow over flow": float(section.values.mean() / passing),
        "speed there over that of the roller": float(passing / (RADIUS * SPIN)),
        "particles in solids": float((REGION.distance(simulation.positions) < 0).sum()),
    }


def draw(simulation: sphear.Simulation, path: Path) -> None:
    """The speed around the solids, and lines along the velocity, on a grid between the particles."""
    from matplotlib.figure import Figure
    from scipy.interpolate import griddata

    x, y = np.meshgrid(np.linspace(0, 2, 201), np.linspace(0, 1, 101))
    distance = REGION.distance(np.stack((x, y), axis=-1).reshape(-1, 2)).reshape(x.shape)
    u, v = griddata(simulation.positions, simulation.velocities, (x, y)).transpose(2, 0, 1)
    near = griddata(simulation.positions, simulation.velocities, (x, y), method="nearest").transpose(2, 0, 1)
    u, v = np.where(np.isnan((u, v)), near, (u, v))  # within half a spacing of walls
    figure = Figure(figsize=(7.2, 3.6), layout="constrained")
    axes = figure.add_subplot(aspect="equal", xlabel="x", ylabel="y", title="A turning cylinder and a bar in a tank")
    speed = axes.contourf(x, y, np.hypot(u, v) / (RADIUS * SPIN), levels=np.linspace(0, 1, 21), cmap="viridis")
    axes.streamplot(
        x, y, np.where(distance < 0, np.nan, u), v, color="white", density=(1.6, 1), linewidth=0.6, arrowsize=0.7
    )
    axes.contourf(x, y, distance, levels=[-9, 0], colors=["#d9d9d9"], zorder=3)
    figure.colorbar(speed, label="speed over that of the roller", shrink=0.8, ticks=[0, 0.2, 0.4, 0.6, 0.8, 1])
    axes.set(xlim=(0, 2), ylim=(0, 1))
    figure.savefig(path, dpi=95)


if __name__ == "__main__":
    for name, value in main(folder=Path()).items():
        print(f"{name}: {value:.4f}")
