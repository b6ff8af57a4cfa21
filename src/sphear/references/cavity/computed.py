"""The flows from rest, computed by two programs with meshes."""

from __future__ import annotations

from collections.abc import Mapping

from sphear.errors import SphearError
from sphear.references.cavity.flow import CavityFlow
from sphear.references.cavity.tables import available, read_curve

OPENFOAM_TIMES = {100: (20,), 1000: (40,)}
"""The Reynolds numbers of `openfoam`, each with the times of its profiles."""
MAC_TIMES = {100: (20,), 1000: (40, 80)}
"""The Reynolds numbers of `mac`, each with the times of its profiles."""

_MESHES = {"openfoam": {100: (128, 64), 1000: (200, 100)}, "mac": {100: (128, 64), 1000: (256, 128)}}
_PROGRAMS = {
    "openfoam": "OpenFOAM 1912, icoFoam, second order",
    "mac": "staggered grid, central differences, SSP-RK3, exact projection",
}


def openfoam(reynolds: float, time: float | None = None, *, extrapolated: bool = True) -> CavityFlow:
    """The flow from rest, by OpenFOAM.

    Args:
        reynolds: one of `OPENFOAM_TIMES`.
        time: that of the profiles, one of `OPENFOAM_TIMES[reynolds]`; the last of them by default.
        extrapolated: by Richardson from two meshes; else the finer mesh as it is, whose energy is low by 0.4 % at
            Re = 100 and 1 % at Re = 1000.

    Raises:
        SphearError: there is no such Reynolds number or time.
    """
    return _computed("openfoam", reynolds, OPENFOAM_TIMES, time, extrapolated)


def mac(reynolds: float, time: float | None = None, *, extrapolated: bool = True) -> CavityFlow:
    """The flow from rest, by a staggered-grid solver: the best time-accurate reference.

    Args:
        reynolds: one of `MAC_TIMES`.
        time: that of the profiles, one of `MAC_TIMES[reynolds]`; the last of them by default.
        extrapolated: by Richardson from two meshes; else the finer mesh as it is.

    Raises:
        SphearError: there is no such Reynolds number or time.
    """
    return _computed("mac", reynolds, MAC_TIMES, time, extrapolated)


def cavity_cylinder(*, extrapolated: bool = True) -> CavityFlow:
    """The flow from rest around a fixed cylinder of diameter 1/2 in the centre, Re = 1000, profiles at t = 40.

    By OpenFOAM on a body-fitted grid; no second program has checked it, and the extrapolated profiles are uncertain by
    0.001 to 0.003, the energy by 0.6 %. The energy is that of the fluid, whose area is 1 - pi/16. Within the cylinder
    the profiles are NaN.

    Args:
        extrapolated: by Richardson from two meshes; else the finer mesh as it is.
    """
    prefix, source = "cavity_cylinder_re1000_openfoam", f"{_PROGRAMS['openfoam']}, body-fitted grid"
    source += ", 52 x 52 and 32 x 32 cells a block, extrapolated" if extrapolated else ", 52 x 52 cells a block"
    return _flow(prefix, 1000, 40, source, extrapolated, gap=(0.25, 0.75))


def _computed(
    program: str, reynolds: float, times: Mapping[int, tuple[int, ...]], time: float | None, extrapolated: bool
) -> CavityFlow:
    number = available(reynolds, times, f"the {program} reference")
    if time is None:
        time = times[number][-1]
    if time not in times[number]:
        choice = " and ".join(map(str, times[number]))
        raise SphearError(f"the {program} reference at Re = {number} has no profiles at t = {time:g}, only at {choice}")
    fine, coarse = _MESHES[program][number]
    meshes = (
        f"{fine} x {fine} and {coarse} x {coarse} cells, extrapolated" if extrapolated else f"{fine} x {fine} cells"
    )
    prefix = f"cavity_re{number}_{program}"
    return _flow(prefix, number, int(time), f"{_PROGRAMS[program]}, {meshes}", extrapolated)


def _flow(
    prefix: str, reynolds: int, time: int, source: str, extrapolated: bool, gap: tuple[float, float] | None = None
) -> CavityFlow:
    ending = "_extrap" if extrapolated else ""
    u = read_curve(f"{prefix}_u_t{time}.csv", "y", f"u{ending}", gap)
    v = read_curve(f"{prefix}_v_t{time}.csv", "x", f"v{ending}", gap)
    energy = read_curve(f"{prefix}_energy.csv", "t", f"E{ending}")
    return CavityFlow(reynolds, source, time, u, v, energy)
