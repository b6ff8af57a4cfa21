"""The pressure equation from a cold start to 1e-6: iterations, and the time of a solve against plain BiCGSTAB of SciPy.

Jittered particles (0.2 dx each way) in a square with walls, without and with a cylinder of radius 0.25, and a
free-surface column in a tank; Morris' Laplacian, Wendland C2 of support 3 dx; noise on the right-hand side. The time of
a solve includes the set-up of its preconditioner, made anew for each step's matrix. `renormalised` is the same matrix
with each row divided by a number of its own, hence not symmetric: BiCGSTAB, whose iterations have two products each.
Then the systems that flows have, cavities without and with a cylinder after some steps, by how walls enter them.

SciPy is given one thread for its BLAS: with more it takes many times as long while other programs keep the processors
busy, see `sphear.pressure.vectors`.
"""

from __future__ import annotations

import os

os.environ["OPENBLAS_NUM_THREADS"] = "1"  # read when NumPy is imported

import time
from functools import partial
from itertools import product
from typing import Any

import numpy as np
from _bench import Array, Report, best_of, clocked, jittered_square, own_clock
from scipy.sparse import csr_matrix, diags_array
from scipy.sparse.linalg import bicgstab
from scipy.spatial import cKDTree

from sphear.cases.flow import FLOWS
from sphear.pressure import AlgebraicMultigrid, PressureSystem, Solution, solve
from sphear.schemes.base import flow_of
from sphear.schemes.incompressible import pressures

STEPS = 20  # of a flow, before its system is looked at
WALLS = {"natural": 15, "mirror_points": 15, "sfdi": 25}  # and the iterations asked for


def laplacian(positions: Array, dx: float) -> csr_matrix:
    """Rows sum_j 2 V W'(r) / r (p_i - p_j), W'(r) / r = -35 (1 - q / 2)^3 / (4 pi h^4), h = 1.5 dx, q = r / h."""
    h = 1.5 * dx
    i, j = cKDTree(positions).query_pairs(2 * h, output_type="ndarray").T
    q = np.sqrt(((positions[i] - positions[j]) ** 2).sum(axis=1)) / h
    weight = 2 * dx**2 * 35 / (4 * np.pi * h**4) * (1 - q / 2) ** 3
    half = csr_matrix((weight, (i, j)), shape=(len(positions),) * 2)
    whole = half + half.T
    return csr_matrix(whole - diags_array(np.asarray(whole.sum(axis=1)).ravel()))


def square(side: int, cylinder: bool) -> PressureSystem:
    positions = jittered_square(side, 0.4)
    if cylinder:
        positions = positions[np.hypot(*(positions - 0.5).T) > 0.25]
    return PressureSystem(
        laplacian(positions, 1 / side), positions, (0, 0), (1, 1), (False, False), 1 / side, True, True
    )


def column(side: int) -> PressureSystem:
    positions = jittered_square(side, 0.4)
    positions = positions[(positions < (0.5, 0.7)).all(axis=1)]
    free = (positions < (0.5 - 1 / side, 0.7 - 1 / side)).all(axis=1)
    matrix = csr_matrix(laplacian(positions, 1 / side)[free][:, free])
    return PressureSystem(matrix, positions[free], (0, 0), (1, 1), (False, False), 1 / side, True, False)


def renormalised(system: PressureSystem) -> PressureSystem:
    pairs = system.matrix.tocoo()
    r2 = ((system.positions[pairs.row] - system.positions[pairs.col]) ** 2).sum(axis=1)
    quality = np.bincount(pairs.row, pairs.data * r2, system.unknowns) / 4
    matrix = csr_matrix(diags_array(1 / quality) @ system.matrix)
    box = (system.lower, system.upper, system.periodic, system.spacing)
    return PressureSystem(matrix, system.positions, *box, symmetric=False, singular=True)


def plain(system: PressureSystem, right: Array) -> None:
    _, fault = bicgstab(system.matrix, right, rtol=1e-6)
    if fault:
        raise SystemExit("plain BiCGSTAB did not converge")


def measure(report: Report, side: int, name: str, system: PressureSystem, asked: dict[str, int]) -> None:
    right = np.random.default_rng(1).standard_normal(system.unknowns)
    right -= right.mean() if system.singular else 0.0
    names = ["grid", *(["amg"] if AlgebraicMultigrid.installed() else []), *(["jacobi"] if side <= 200 else [])]
    for preconditioner in names:
        solution = solve(system, right, preconditioner=preconditioner, most=2000)
        what = f"{side}x{side}, {name}, {preconditioner}, iterations"
        report.add(what, solution.iterations, at_most=asked.get(preconditioner))
    if not system.symmetric:
        return
    if side <= 200:
        times = best_of(
            4, clocked("grid", partial(solve, system, right), 5), clocked("plain", partial(plain, system, right))
        )
        best, other = times["grid"], times["plain"]
    else:  # a plain one takes many seconds: once is enough to tell
        best = best_of(1, clocked("grid", partial(solve, system, right), 2))["grid"]
        begin = own_clock()
        plain(system, right)
        other = own_clock() - begin
    report.add(f"{side}x{side}, {name}, grid, time of a solve", best * 1e3, "ms")
    report.add(f"{side}x{side}, {name}, speed, grid / plain BiCGSTAB", other / best)


def of_flow(name: str, side: int, neumann: str) -> tuple[PressureSystem, Array]:
    """The system and the right-hand side of a cavity's next step."""
    case, taken = FLOWS[name], list[tuple[PressureSystem, Array]]()
    chosen = case.settings(
        scheme="incompressible", reynolds=1000.0, resolution=side, threads=1, walls=neumann, max_steps=STEPS
    )
    flow = flow_of(case.problem(chosen), chosen)
    flow.advance(STEPS)
    with_it = pressures.solve

    def keep(system: PressureSystem, right: Array, *others: Any) -> Solution:
        taken.append((system, right))
        return with_it(system, right, *others)

    pressures.solve = keep  # type: ignore[assignment]
    flow.advance(1)
    pressures.solve = with_it
    return taken[0]


def main() -> None:
    report = Report(__doc__ or "")
    if not AlgebraicMultigrid.installed():
        report.say('without amg, which needs pyamg: pip install "sphear[amg]"')
    began = time.perf_counter()
    for side in (50, 100, 200, 400):
        for name, cylinder in (("square", False), ("cylinder", True)):
            system = square(side, cylinder)
            measure(report, side, name, system, {"grid": 15})
            measure(report, side, f"{name} renormalised", renormalised(system), {"grid": 25})
        measure(report, side, "free surface", column(side), {"grid": 15})
        for name, neumann in product(("cavity", "cavity-cylinder"), WALLS):
            system, right = of_flow(name, side, neumann)
            for tolerance in (1e-4, 1e-6):
                iterations = solve(system, right, tolerance=tolerance).iterations
                report.add(
                    f"{side}x{side}, {name}, walls {neumann}, iterations to {tolerance:g}",
                    iterations,
                    at_most=WALLS[neumann] if tolerance == 1e-6 else None,
                )
    report.say(f"{time.perf_counter() - began:.0f} s in all")
    report.close()


if __name__ == "__main__":
    main()
