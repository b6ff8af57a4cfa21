"""Linear stability of a square lattice under pressure: rows that slide past each other."""

from __future__ import annotations

import math

import numpy as np

from sphear.cases.flow.poiseuille import DENSITY, KINEMATIC_VISCOSITY
from sphear.kernels import CubicSpline


def sliding_growth(pressure: float, spacing: float, h: float) -> tuple[float, float]:
    """The largest growth rate of rows that slide along themselves, in 1 / s, and k dx across them; 0 if none grows.

    Displacements cos(k y) of whole rows leave the density (11) as it is, to first order. The momentum equation (8) at
    a uniform pressure then accelerates them by -(2 p / rho^2) sum_b m_b W_xx (1 - cos(k y_ab)), and model E slows
    their velocity by (2 nu / rho) sum_b m_b (r . grad W) / r^2 (1 - cos(k y_ab)).
    """
    kernel = CubicSpline(h)
    reach = math.ceil(kernel.radius / spacing)
    pairs = []
    for i in range(-reach, reach + 1):
        for j in range(-reach, reach + 1):
            r2 = spacing**2 * (i * i + j * j)
            if 0 < r2 < kernel.radius**2:
                hessian = kernel.hessian((i * spacing, j * spacing), r2)
                # across the line to the neighbour the second derivative is W' / r
                across = (hessian[0][0] * j * j - 2 * hessian[0][1] * i * j + hessian[1][1] * i * i) / (i * i + j * j)
                pairs.append((j, hessian[0][0], across))
    best, at = 0.0, 0.0
    for k in np.linspace(0, math.pi, 181)[1:]:
        stiffness = sum(spacing**2 * xx * (1 - math.cos(k * j)) for j, xx, _ in pairs)
        drag = -2 * KINEMATIC_VISCOSITY * sum(spacing**2 * a * (1 - math.cos(k * j)) for j, _, a in pairs)
        push = -2 * pressure / DENSITY * stiffness
        if push > 0:
            rate = -drag / 2 + math.sqrt(drag**2 / 4 + push)
            best, at = max((best, at), (rate, float(k)))
    return best, at
