"""Growth rates of disorder on a lattice under a pressure, by the symmetric gradient of eq. 3.

Particles of a lattice are displaced by xi exp(i k . x). Under an even pressure p the gradient of eq. 3 is then
2 p S xi, with S(k) = sum_j V_j H(r_j) (1 - cos k . r_j) and H the second derivatives of the kernel, and

    rho d2 xi / dt2 = -2 p S xi - rho nu q(k) d xi / dt,   q(k) = -2 sum_j V_j W'(r_j) / r_j (1 - cos k . r_j)

with eq. 15 for the viscosity. The projection takes out what the divergence of eq. 4 sees, D(k) = sum_j V_j grad W
sin k . r_j: what is left is xi across D. Negative pressures, for which particles attract each other, grow at

    s = sqrt(2 |p| S / rho + (nu q / 2)^2) - nu q / 2

with S, q of the fastest k; without viscosity as sqrt(|p| / rho) / dx.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from sphear.kernels import Kernel
from sphear.studies.rows import significant

Array = np.ndarray[Any, Any]

BLIND = 1e-9  # of the divergence, over dx, that sees a displacement
WAVES = 24  # wave numbers along each axis, up to pi / dx


def _lattice(kernel: Kernel, spacing: float) -> tuple[Array, Array]:
    """The neighbours of a lattice's particle, (n, 2), and their squared distances."""
    reach = int(kernel.radius / spacing) + 1
    ticks = np.arange(-reach, reach + 1) * spacing
    points = np.stack(np.meshgrid(ticks, ticks), axis=-1).reshape(-1, 2)
    r2 = (points**2).sum(axis=1)
    near = (r2 > 0) & (r2 < kernel.radius**2)
    return points[near], r2[near]


def growth(kernel: Kernel, spacing: float, pressure: float, viscosity: float) -> float:
    """The fastest growth of displacements that the divergence does not see, per unit time; 0 where none grows.

    Args:
        kernel: with its smoothing length.
        spacing: dx.
        pressure: p over the density.
        viscosity: kinematic.
    """
    points, r2 = _lattice(kernel, spacing)
    volume = spacing**2
    slopes = np.array([kernel.gradient(tuple(d), s) for d, s in zip(points, r2, strict=True)])
    second = np.array([kernel.hessian(tuple(d), s) for d, s in zip(points, r2, strict=True)])
    over_r = -(slopes * points).sum(axis=1) / r2
    ticks = np.arange(WAVES + 1) * np.pi / spacing / WAVES
    waves = np.stack(np.meshgrid(ticks, ticks), axis=-1).reshape(-1, 2)[1:]
    phase = waves @ points.T
    moved = 1.0 - np.cos(phase)
    stiffness = volume * np.einsum("kn,nab->kab", moved, second)
    seen = volume * np.sin(phase) @ slopes
    length = np.hypot(*seen.T)
    some = length * spacing > BLIND
    across = np.stack((-seen[some, 1], seen[some, 0]), axis=1) / length[some, None]
    rates = -2.0 * pressure * np.linalg.eigvalsh(stiffness)  # where the divergence sees neither direction
    rates[some] = -2.0 * pressure * np.einsum("ka,kab,kb->k", across, stiffness[some], across)[:, None]
    half = volume * (moved @ over_r) * viscosity
    drive = np.maximum(rates.max(axis=1), 0.0)
    return float((np.sqrt(drive + half**2) - half).max())


def predicted(row: dict[str, Any]) -> float | None:
    """The growth under the least pressure of a run with the symmetric gradient; None of others, and without pressure.

    Where the level of the pressure is chosen, that of the corner or the cut one is below what was solved for by an
    amount that is not kept: none of these either.
    """
    from sphear.operators import arguments
    from sphear.schemes.presets import preset_settings
    from sphear.studies.zheng2018.cavities import PAPER, REYNOLDS

    settings = {**preset_settings(PAPER, "incompressible"), "pressure_level": "free", **row["changes"]}
    if settings["gradient"] != "symmetric" or settings["pressure_level"] != "free" or row["least_pressure"] is None:
        return None
    spacing = 1.0 / row["resolution"]
    kernel = arguments.read_kernel(settings["kernel"], settings["h_over_dx"], spacing)
    return significant(growth(kernel, spacing, row["least_pressure"], 1.0 / REYNOLDS), 3)
