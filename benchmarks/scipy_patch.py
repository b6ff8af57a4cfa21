"""The Morris Laplacian by vectorised SciPy and NumPy (a k-d tree's pairs) against `sphear.laplacian`, on one thread.

Both find the neighbours and sum over them; both results are checked against each other before they are timed in turn.
"""

from __future__ import annotations

from functools import partial

import numpy as np
from _bench import Array, Report, best_of, clocked, difference, jittered_square
from scipy.spatial import cKDTree

import sphear

H_OVER_DX = 1.57


def scipy_laplacian(positions: Array, values: Array, volume: float, h: float) -> Array:
    """lap f_i = 2 sum_j V_j (f_i - f_j) W'(r_ij) / r_ij with the cubic spline, each pair of the tree used twice."""
    i, j = cKDTree(positions).query_pairs(2 * h, output_type="ndarray").T
    q = np.sqrt(((positions[i] - positions[j]) ** 2).sum(axis=1)) / h
    slope_over_q = np.where(q < 1, 2.25 * q - 3, -0.75 * (2 - q) ** 2 / q)
    flow = 20 / (7 * np.pi * h**4) * volume * slope_over_q * (values[i] - values[j])
    count = len(positions)
    return np.bincount(i, flow, count) - np.bincount(j, flow, count)


def main() -> None:
    report = Report(__doc__ or "")
    for side in (100, 316):
        positions, h, volume = jittered_square(side), H_OVER_DX / side, 1 / side**2
        values = (positions**4).sum(axis=1)
        mine = partial(sphear.laplacian, positions, values, kernel=sphear.CubicSpline(h), volumes=volume, threads=1)
        theirs = partial(scipy_laplacian, positions, values, volume, h)
        if not (found := difference(mine(), theirs())) < 1e-10:
            raise SystemExit(f"the two differ by {found:.1e} of the largest value")
        times = best_of(8, clocked("sphear", mine, 10), clocked("scipy", theirs))
        report.add(f"{side}x{side}, sphear", times["sphear"] * 1e3, "ms")
        report.add(f"{side}x{side}, SciPy", times["scipy"] * 1e3, "ms")
        report.add(f"{side}x{side}, speed, sphear / SciPy", times["scipy"] / times["sphear"], at_least=15)
    report.close()


if __name__ == "__main__":
    main()
