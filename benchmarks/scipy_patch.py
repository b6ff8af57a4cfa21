"""The Morris Laplacian by vectorised SciPy and NumPy (a k-d tree's pairs) against `sphear.laplacian`, on one thread.

Both find the neighbours and sum over them. SciPy's pairs come as a sparse matrix of distances, as such scripts do
it, or each once from `query_pairs`, with its two sides summed. Everything is checked, then timed in turn.
"""

from __future__ import annotations

from functools import partial

import numpy as np
from _bench import Array, Report, best_of, clocked, difference, jittered_square
from scipy.spatial import cKDTree

import sphear

H_OVER_DX = 1.57


def slope_over_r(r: Array, h: float) -> Array:
    """(1/r) dW/dr of the cubic spline in 2-D."""
    q = r / h
    slope: Array = np.where(q < 1, 2.25 * q - 3, -0.75 * (2 - q) ** 2 / q) * 10 / (7 * np.pi * h**4)
    return slope


def by_distances(positions: Array, values: Array, volume: float, h: float) -> Array:
    """lap f_i = 2 sum_j V_j (f_i - f_j) W'(r_ij) / r_ij over all pairs."""
    tree = cKDTree(positions)
    pairs = tree.sparse_distance_matrix(tree, 2 * h, output_type="coo_matrix")
    apart = pairs.data > 0
    i, j, r = pairs.row[apart], pairs.col[apart], pairs.data[apart]
    return np.bincount(i, 2 * volume * (values[i] - values[j]) * slope_over_r(r, h), len(positions))


def by_pairs(positions: Array, values: Array, volume: float, h: float) -> Array:
    """The same, each pair once."""
    i, j = cKDTree(positions).query_pairs(2 * h, output_type="ndarray").T
    r = np.sqrt(((positions[i] - positions[j]) ** 2).sum(axis=1))
    flow = 2 * volume * (values[i] - values[j]) * slope_over_r(r, h)
    return np.bincount(i, flow, len(positions)) - np.bincount(j, flow, len(positions))


def main() -> None:
    report = Report(__doc__ or "")
    for side in (100, 316):
        positions, h, volume = jittered_square(side), H_OVER_DX / side, 1 / side**2
        values = (positions**4).sum(axis=1)
        mine = partial(sphear.laplacian, positions, values, kernel=sphear.CubicSpline(h), volumes=volume, threads=1)
        theirs = {f.__name__: partial(f, positions, values, volume, h) for f in (by_distances, by_pairs)}
        for name, function in theirs.items():
            if not (found := difference(function(), mine())) < 1e-10:
                raise SystemExit(f"{name} differs from sphear by {found:.1e} of the largest value")
        times = best_of(8, clocked("sphear", mine, 10), *(clocked(name, call) for name, call in theirs.items()))
        report.say(f"{side}x{side}, sphear {times['sphear'] * 1e3:.2f} ms")
        for name, at_least in (("by_distances", 15), ("by_pairs", None)):
            what = f"{side}x{side}, speed, sphear / SciPy {name.replace('_', ' ')}"
            report.add(what, times[name] / times["sphear"], at_least=at_least)
    report.close()


if __name__ == "__main__":
    main()
