"""The front of a dam break beside the experiment of Martin & Moyce (1952), with 10, 20 and 40 particles across.

    python validation/dam_break.py

Writes dam_break.json beside itself, and the picture of the documentation.
"""

from __future__ import annotations

import json
from argparse import ArgumentParser, RawDescriptionHelpFormatter
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from sphear.cases.flow import FLOWS, CaseRun
from sphear.references import dam_break as experiment
from sphear.results.figure import save
from sphear.results.figure.flow import draw_particles
from sphear.results.figure.style import INK, grid, look, styled
from sphear.simulation.observers import Snapshot, Snapshots

SIZES = (10, 20, 40)  # particles across the column
SHOWN = (1.0, 2.0, 3.0)  # times
PICTURE = Path(__file__).parents[1] / "docs" / "images" / "dam-break.png"


def computed(size: int) -> tuple[dict[str, Any], list[Snapshot]]:
    """What is kept of a run, and its particles at the times shown."""
    case = FLOWS["dam-break"]
    settings = case.settings(resolution=size)
    snapshots = Snapshots(when=np.array(SHOWN) * case.time_unit(settings))
    run = CaseRun(case, settings, observers=[snapshots]).run()
    time, front, energy = (np.array([row[key] for row in run.history]) for key in ("time", "front", "energy"))
    known = np.array(experiment.TIMES) <= time[-1]
    times, fronts = np.array(experiment.TIMES)[known], np.array(experiment.FRONTS)[known]
    kept = {
        "particles across": size,
        "steps": run.flow.steps,
        "time": time.round(4).tolist(),
        "front": front.round(4).tolist(),
        "widths ahead": (np.interp(times, time, front) - fronts).round(4).tolist(),
        "time ahead": (times - np.interp(fronts, front, time)).round(4).tolist(),
        "largest growth of energy": float(f"{np.diff(energy).max():.3g}"),
        "energy at the end": round(float(energy[-1]), 4),
    }
    return kept, snapshots.rows


@styled
def figure(rows: list[dict[str, Any]], snapshots: list[Snapshot]) -> Figure:
    """The particles of the finest run, and the fronts."""
    made, axes = grid(4, 2, (5.2, 2.7), "A dam breaks")
    for ax, snapshot, time in zip(axes, snapshots, SHOWN, strict=False):
        draw_particles(ax, snapshot.positions, snapshot.velocities, 1 / rows[-1]["particles across"])
        ax.set(title=f"speed at t = {time:g}", xlim=(0, 4.2), ylim=(0, 2.1))
    for row, marker in zip(rows, ("-.", "--", "-"), strict=True):
        axes[3].plot(row["time"], row["front"], marker, color=look("morris").colour, label=f"{row['particles across']}")
    axes[3].plot(experiment.TIMES, experiment.FRONTS, "o", color=INK, markersize=4, label="Martin & Moyce")
    axes[3].set(title="front, by particles across", xlabel="t", ylabel="x")
    axes[3].legend()
    return made


def main() -> None:
    """Compute, print, write and draw."""
    ArgumentParser(description=__doc__, formatter_class=RawDescriptionHelpFormatter).parse_args()
    rows = []
    for size in SIZES:
        row, snapshots = computed(size)
        print({key: value for key, value in row.items() if key not in ("time", "front")})
        rows.append(row)
    lines = ",\n ".join(json.dumps(row) for row in rows)
    Path(__file__).with_suffix(".json").write_text(f"[\n {lines}\n]\n", encoding="utf-8")
    save(figure(rows, snapshots), PICTURE, "png")


if __name__ == "__main__":
    main()
