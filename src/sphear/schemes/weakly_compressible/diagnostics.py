"""Diagnostics of an explicit flow: how compressible it is, and how near its particles come to each other."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from sphear.schemes.checks import tree_of
from sphear.schemes.energy import greatest_speed

if TYPE_CHECKING:
    from sphear.schemes.weakly_compressible.flow import WeaklyCompressibleFlow

Array = np.ndarray[Any, Any]


def diagnostics(flow: WeaklyCompressibleFlow) -> dict[str, float]:
    """The state of the fluid and of its particles.

    - mach: the greatest speed over the speed of sound at rest.
    - density_deviation: the root mean square of rho / rho_0 - 1.
    - divergence: the mean of |d rho / dt| / rho, which is |div u| but for what density diffusion adds, times length
      over speed; where the density is integrated.
    - smallest_distance: of two particles, in spacings; 1 on a lattice.
    """
    problem = flow.problem
    metrics = {
        "mach": greatest_speed(flow.velocities) / flow.sound_speed,
        "density_deviation": float(np.sqrt(np.mean((flow.density / problem.density - 1.0) ** 2))),
    }
    if (rate := flow.density_rate) is not None:
        metrics["divergence"] = float(np.abs(rate / flow.density).mean() * problem.length / problem.speed)
    if flow.count > 1 and np.isfinite(flow.positions).all():
        tree = tree_of(problem, flow.positions)
        metrics["smallest_distance"] = float(np.min(tree.query(tree.data, k=2)[0][:, 1])) / problem.spacing
    return metrics
