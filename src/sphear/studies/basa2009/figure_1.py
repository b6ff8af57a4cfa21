"""Figure 1: second derivatives of the cubic spline in two dimensions."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from sphear.kernels import CubicSpline
from sphear.results.table import Column, Table
from sphear.studies.result import Agreement, Progress, StudyResult

if TYPE_CHECKING:
    from matplotlib.figure import Figure

POINTS = 161  # along each axis, an odd number: the centre is one of them
CLAIM = (
    "d2W/dxdy is antisymmetric across both axes and so cancels on particles symmetric about them, d2W/dx2 is symmetric"
    " and does not"
)


def second_derivatives() -> tuple[Any, Any, Any]:
    """The coordinates, and d2W/dx2 and d2W/dxdy of the cubic spline with h = 1 on their grid, x along columns."""
    kernel = CubicSpline(1.0)
    axis = np.linspace(-2, 2, POINTS)
    xx, xy = np.empty((POINTS, POINTS)), np.empty((POINTS, POINTS))
    for i, y in enumerate(axis):
        for j, x in enumerate(axis):
            r2 = float(x * x + y * y)
            hessian = kernel.hessian((float(x), float(y)), r2) if r2 > 1e-12 else kernel.hessian_at_zero(2)
            xx[i, j], xy[i, j] = hessian[0]
    return axis, xx, xy


def lattice_sums(dx_over_h: float = 0.637) -> tuple[float, float]:
    """sum_j V_j d2W/dx2 and sum_j V_j d2W/dxdy on a lattice: what they make of a constant field, times h^2."""
    kernel = CubicSpline(1.0)
    most = math.ceil(kernel.support / dx_over_h)
    reach = range(-most, most + 1)
    totals = np.zeros(2)
    for i in reach:
        for j in reach:
            d = (i * dx_over_h, j * dx_over_h)
            r2 = d[0] ** 2 + d[1] ** 2
            hessian = kernel.hessian(d, r2) if r2 else kernel.hessian_at_zero(2)
            totals += dx_over_h**2 * np.array(hessian[0])
    return float(totals[0]), float(totals[1])


def run(*, quick: bool, progress: Progress) -> StudyResult:
    """Both surfaces, their symmetry and their sums on a lattice."""
    axis, xx, xy = second_derivatives()
    across = float(max(np.abs(xy + xy[:, ::-1]).max(), np.abs(xy + xy[::-1]).max()) / np.abs(xy).max())
    same = float(max(np.abs(xx - xx[:, ::-1]).max(), np.abs(xx - xx[::-1]).max()) / np.abs(xx).max())
    sum_xx, sum_xy = lattice_sums()
    finding = (
        f"d2W/dxdy changes its sign across the axes to {across:.0e} and sums to {sum_xy:.0e} on a lattice with dx/h ="
        f" 0.637; d2W/dx2 is symmetric to {same:.0e} and sums to {sum_xx:.3f} / h^2 there instead of 0, which is the"
        f" error that model A makes of a constant"
    )
    holds = across < 1e-12 and same < 1e-12 and abs(sum_xy) < 1e-12 < abs(sum_xx)
    agrees: Agreement = "yes" if holds else "no"
    rows = [
        {"derivative": "d2W/dx2", "maximum": float(xx.max()), "minimum": float(xx.min()), "lattice_sum": sum_xx},
        {"derivative": "d2W/dxdy", "maximum": float(xy.max()), "minimum": float(xy.min()), "lattice_sum": sum_xy},
    ]
    table = Table(
        "Figure 1 of Basa, Quinlan & Lastiwka 2009: second derivatives of the cubic spline, h = 1",
        (
            Column("derivative", "derivative"),
            Column("maximum", "maximum", ".4f"),
            Column("minimum", "minimum", ".4f"),
            Column("lattice_sum", "sum on a lattice, dx/h = 0.637", ".2e"),
        ),
        rows,
    )
    return StudyResult(CLAIM, finding, agrees, rows, [table], {"figure-1": lambda: _figure(axis, xx, xy)})


def _figure(axis: Any, xx: Any, xy: Any) -> Figure:
    from sphear.results.figure import surface_panels

    x, y = np.meshgrid(axis, axis)
    panels = {"d2W/dx2": (x, y, xx), "d2W/dxdy": (x, y, xy)}
    return surface_panels(panels, "x / h", "y / h", "Cubic spline in 2-D (Basa, Quinlan & Lastiwka 2009, figure 1)")
