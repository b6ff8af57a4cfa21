"""The lid-driven cavity at Re = 100 against published numbers.

`sphear.flow` runs the cases that the package brings along, with their references. At t = 20 the flow is steady to
3e-5, and its velocity on the vertical centreline is compared at the 15 stations of Marchi, Suero & Araki (2009, J.
Braz. Soc. Mech. Sci. Eng. 31:186), whose error is 1e-7. Look at the mean and the largest deviation, in lid speeds, and
at the deviation of the other profile from a computation by finite differences that comes with the package.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

import sphear

# u on x = 1/2 at y = 1/16, 2/16, ..., 15/16, table of Marchi et al.
PUBLISHED = (
    -0.041974991, -0.077125399, -0.109816214, -0.141930064, -0.172712391, -0.198470859, -0.212962392, -0.209149142,
    -0.182080595, -0.131256301, -0.060245594, 0.027874448, 0.140425325, 0.310557090, 0.597466694,
)  # fmt: skip
Y = np.arange(1, 16) / 16


def main(resolution: int = 50, folder: Path | None = None) -> dict[str, float]:
    """The mean and the largest deviation of u from the table, and the mean one of v from finite differences.

    Args:
        resolution: particles a side.
        folder: gets a picture.
    """
    run = sphear.flow("cavity", scheme="incompressible", reynolds=100, resolution=resolution, until=20).run()
    result = run.as_dict()
    stations, u = (np.array(result["profiles"][name]) for name in ("stations", "u"))
    deviation = np.abs(np.interp(Y, stations, u) - PUBLISHED)
    if folder is not None:
        draw(run, folder / "cavity_against_reference.png")
    return {
        "mean deviation of u": float(deviation.mean()),
        "largest deviation of u": float(deviation.max()),
        "mean deviation of v": result["metrics"]["v_mean_deviation"],
    }


def draw(run: sphear.CaseRun, path: Path) -> None:
    """Both profiles beside their references, and the table."""
    from matplotlib.figure import Figure

    profiles = run.as_dict()["profiles"]
    stations = profiles["stations"]
    figure = Figure(figsize=(7.2, 3.6), layout="constrained")
    left, right = figure.subplots(1, 2)
    left.plot(profiles["u"], stations, color="#0072b2", label="particles")
    left.plot(PUBLISHED, Y, "o", color="#333333", ms=4, label="Marchi et al. 2009")
    left.set(xlabel="u on x = 1/2", ylabel="y")
    left.legend(frameon=False)
    right.plot(stations, profiles["v"], color="#0072b2", label="particles")
    for comparison in list(run.case.comparisons(run.settings, run.flow).values())[1:]:
        right.plot(comparison.reference_at, comparison.reference, "--", color="#333333", label="finite differences")
    right.set(xlabel="x", ylabel="v on y = 1/2")
    right.legend(frameon=False)
    for axes in (left, right):
        axes.grid(color="#e6e6e6")
    figure.suptitle("Lid-driven cavity, Re = 100, t = 20", x=0.02, ha="left", fontsize="medium")
    figure.savefig(path, dpi=110)


if __name__ == "__main__":
    for name, value in main(folder=Path()).items():
        print(f"{name}: {value:.5f}")
