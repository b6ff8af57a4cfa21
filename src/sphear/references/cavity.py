"""The lid-driven cavity: published tables and time-accurate computations, read from the files in `data/`.

The cavity is the unit square, its lid at y = 1 moves in +x at the speed 1, the density is 1. Lengths are in units of
the side, velocities of the lid's speed, times of side / speed, and energies, the integral of |u|^2 / 2 over the cavity,
of density x speed^2 x side^2 for a unit of depth. Each file names its sources, meshes and corrections in its first
lines.

What to compare with:

- `mac` and `openfoam` start impulsively from rest. At Re = 1000 the flow is not steady at t = 40 (the least u is
  -0.3873 there, -0.3885 at t = 80, -0.38857 in the end), so compare at equal times. The extrapolated energies of the
  two programs agree to 0.1 % from t = 1 on, their profiles to 2e-4.
- `botella_peyret` (Re = 1000) and `marchi` (Re = 100, 400, 1000) are steady and the most accurate.
- `ghia` is what everyone plots, and is itself wrong by up to 0.005 in u and 0.009 in v at Re = 100, 0.006 and 0.018 at
  Re = 1000. A converging method moves away from it below that.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import CubicSpline

from sphear.errors import SphearError
from sphear.names import unknown

GHIA = (
    "Ghia, Ghia & Shin 1982, High-Re solutions for incompressible flow using the Navier-Stokes equations and a"
    " multigrid method, J. Comput. Phys. 48:387"
)
BOTELLA_PEYRET = (
    "Botella & Peyret 1998, Benchmark spectral results on the lid-driven cavity flow, Computers & Fluids 27:421"
)
MARCHI = (
    "Marchi, Suero & Araki 2009, The lid-driven square cavity flow: numerical solution with a 1024 x 1024 grid,"
    " J. Braz. Soc. Mech. Sci. Eng. 31:186"
)

GHIA_REYNOLDS = (100, 400, 1000, 3200, 5000, 7500, 10000)
MARCHI_REYNOLDS = (100, 400, 1000)
OPENFOAM_TIMES = {100: (20,), 1000: (40,)}
"""The Reynolds numbers of `openfoam`, each with the times of its profiles."""
MAC_TIMES = {100: (20,), 1000: (40, 80)}
"""The Reynolds numbers of `mac`, each with the times of its profiles."""

_MESHES = {"openfoam": {100: (128, 64), 1000: (200, 100)}, "mac": {100: (128, 64), 1000: (256, 128)}}
_PROGRAMS = {
    "openfoam": "OpenFOAM 1912, icoFoam, second order",
    "mac": "staggered grid, central differences, SSP-RK3, exact projection",
}


@dataclass(frozen=True, eq=False)
class Curve:
    """A tabulated function of one variable.

    Args:
        stations: where it is known, increasing.
        values: its values there.
        gap: an interval within which there is no fluid; its ends are stations.
    """

    stations: NDArray[np.float64]
    values: NDArray[np.float64]
    gap: tuple[float, float] | None = None

    def __post_init__(self) -> None:
        for name in ("stations", "values"):
            array = np.array(getattr(self, name), dtype=np.float64)
            array.setflags(write=False)
            object.__setattr__(self, name, array)

    def at(self, stations: ArrayLike, kind: Literal["cubic", "linear"] = "cubic") -> NDArray[np.float64]:
        """The values at other stations; NaN within the gap.

        The computed curves are fine enough for it. The published tables are not: between their stations any
        interpolation is wrong by up to 0.03 to 0.05, so compare with them at their own stations.

        Args:
            stations: an array of any shape, within the tabulated stations.
            kind: "cubic", by splines (not-a-knot), or "linear".

        Raises:
            SphearError: a station is outside of the table, or the kind is unknown.
        """
        if kind not in ("cubic", "linear"):
            raise unknown("interpolation", kind, ("cubic", "linear"))
        x = np.asarray(stations, dtype=np.float64)
        first, last = self.stations[0], self.stations[-1]
        outside = ~((x >= first) & (x <= last))
        if outside.any():
            raise SphearError(f"the curve is known from {first:g} to {last:g} and not at {x[outside][0]:g}")
        found = np.full(x.shape, np.nan)
        ends = [(first, last)] if self.gap is None else [(first, self.gap[0]), (self.gap[1], last)]
        for start, end in ends:
            piece = (self.stations >= start) & (self.stations <= end)
            own, values = self.stations[piece], self.values[piece]
            inside = (x >= own[0]) & (x <= own[-1])
            found[inside] = (
                CubicSpline(own, values)(x[inside]) if kind == "cubic" else np.interp(x[inside], own, values)
            )
        return found


@dataclass(frozen=True, eq=False)
class CavityFlow:
    """One flow in the cavity, from one source.

    reynolds: the Reynolds number of lid speed and side.
    source: where the numbers come from.
    time: the time of the profiles; infinite for a steady flow.
    u: the velocity along x on the line x = 1/2, a function of y.
    v: the velocity along y on the line y = 1/2, a function of x.
    energy: the kinetic energy, a function of time from the start on; None where the source has none.
    """

    reynolds: int
    source: str
    time: float
    u: Curve
    v: Curve
    energy: Curve | None = None


@dataclass(frozen=True)
class Extrema:
    """The largest and least velocities on the centrelines and the least stream function; None where not given.

    source, reynolds: who says so, of which flow.
    u_min, y_u_min: the least u on x = 1/2, and its y; likewise the others on y = 1/2.
    psi_min: the least stream function.
    note: what else the table says of it, as that the numbers are not interpolated.
    """

    source: str
    reynolds: int
    u_min: float | None
    y_u_min: float | None
    v_max: float | None
    x_v_max: float | None
    v_min: float | None
    x_v_min: float | None
    psi_min: float | None
    note: str


def ghia(reynolds: float) -> CavityFlow:
    """The tables I and II of Ghia, Ghia & Shin (1982), steady, at 17 stations: see above for their error.

    Two misprints of the copies in circulation are corrected, u at Re = 10000, y = 0.5 and at Re = 3200, y = 0.4531. A
    third, v at Re = 400, x = 0.9063, whose true value is not known, is left out, so that this profile has 16 stations.

    Raises:
        SphearError: the Reynolds number is none of `GHIA_REYNOLDS`.
    """
    number = _known(reynolds, GHIA_REYNOLDS, "the tables of Ghia, Ghia & Shin")
    u = _curve("ghia1982_u.csv", "y_exact", f"re{number}")
    v = _curve("ghia1982_v.csv", "x_exact", f"re{number}")
    if number == 400:
        right = v.stations != 0.90625
        v = Curve(v.stations[right], v.values[right])
    return CavityFlow(number, GHIA, math.inf, u, v)


def botella_peyret() -> CavityFlow:
    """The tables 9 and 10 of Botella & Peyret (1998), Re = 1000, steady, spectral, at 17 stations, mirrored in x."""
    u = _curve("botella_peyret1998_u.csv", "y_exact", "u")
    v = _curve("botella_peyret1998_v.csv", "x_exact", "v")
    return CavityFlow(1000, BOTELLA_PEYRET, math.inf, u, v)


def marchi(reynolds: float) -> CavityFlow:
    """The profiles of Marchi, Suero & Araki (2009), steady, extrapolated from 1024 x 1024 cells, at k / 16.

    The velocities of the walls are added at both ends.

    Raises:
        SphearError: the Reynolds number is none of `MARCHI_REYNOLDS`.
    """
    number = _known(reynolds, MARCHI_REYNOLDS, "the tables of Marchi, Suero & Araki")
    u = _curve("marchi2009_u.csv", "y", f"re{number}")
    v = _curve("marchi2009_v.csv", "x", f"re{number}")
    return CavityFlow(number, MARCHI, math.inf, _with_walls(u, lid=1.0), _with_walls(v, lid=0.0))


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


def extrema(reynolds: float) -> tuple[Extrema, ...]:
    """The published extrema of the steady profiles, one entry a source.

    Raises:
        SphearError: there are none of this Reynolds number.
    """
    rows = _rows("published_extrema.csv")
    number = _known(reynolds, sorted({int(row["re"]) for row in rows}), "the published extrema")
    return tuple(_extrema(row) for row in rows if int(row["re"]) == number)


def _extrema(row: Mapping[str, str]) -> Extrema:
    def value(name: str) -> float | None:
        return float(row[name]) if row[name] else None

    return Extrema(
        source=row["source"].replace("_", " "),
        reynolds=int(row["re"]),
        u_min=value("u_min"),
        y_u_min=value("y_u_min"),
        v_max=value("v_max"),
        x_v_max=value("x_v_max"),
        v_min=value("v_min"),
        x_v_min=value("x_v_min"),
        psi_min=value("psi_min"),
        note=row["note"],
    )


def _computed(
    program: str, reynolds: float, times: Mapping[int, tuple[int, ...]], time: float | None, extrapolated: bool
) -> CavityFlow:
    number = _known(reynolds, times, f"the {program} reference")
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
    u = _curve(f"{prefix}_u_t{time}.csv", "y", f"u{ending}", gap)
    v = _curve(f"{prefix}_v_t{time}.csv", "x", f"v{ending}", gap)
    energy = _curve(f"{prefix}_energy.csv", "t", f"E{ending}")
    return CavityFlow(reynolds, source, time, u, v, energy)


def _known(reynolds: float, available: Collection[int], where: str) -> int:
    """The Reynolds number as an integer, if it is available."""
    if reynolds not in available:
        numbers = ", ".join(map(str, available))
        raise SphearError(f"{where} have no Reynolds number {reynolds:g}, only {numbers}")
    return int(reynolds)


def _with_walls(curve: Curve, lid: float) -> Curve:
    return Curve(np.array([0.0, *curve.stations, 1.0]), np.array([0.0, *curve.values, lid]))


def _curve(file: str, station: str, value: str, gap: tuple[float, float] | None = None) -> Curve:
    """Two columns of a file, by increasing station, without negative zeros."""
    pairs = sorted((float(row[station]), float(row[value]) + 0.0) for row in _rows(file))
    stations, values = zip(*pairs, strict=True)
    return Curve(np.array(stations), np.array(values), gap)


@cache
def _rows(file: str) -> tuple[dict[str, str], ...]:
    """The rows of a file in `data/`, by the names of its columns."""
    text = files("sphear.references").joinpath("data", file).read_text(encoding="utf-8")
    return tuple(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))
