"""The steady profiles that Ghia et al., Botella & Peyret and Marchi et al. published."""

from __future__ import annotations

import math

import numpy as np

from sphear.references.cavity.curve import Curve
from sphear.references.cavity.flow import CavityFlow
from sphear.references.cavity.tables import available, read_curve

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


def ghia(reynolds: float) -> CavityFlow:
    """The tables I and II of Ghia, Ghia & Shin (1982), steady, at 17 stations: see above for their error.

    Two misprints of the copies in circulation are corrected, u at Re = 10000, y = 0.5 and at Re = 3200, y = 0.4531. A
    third, v at Re = 400, x = 0.9063, whose true value is not known, is left out, so that this profile has 16 stations.

    Raises:
        SphearError: the Reynolds number is none of `GHIA_REYNOLDS`.
    """
    number = available(reynolds, GHIA_REYNOLDS, "the tables of Ghia, Ghia & Shin")
    u = read_curve("ghia1982_u.csv", "y_exact", f"re{number}")
    v = read_curve("ghia1982_v.csv", "x_exact", f"re{number}")
    if number == 400:
        right = v.stations != 0.90625
        v = Curve(v.stations[right], v.values[right])
    return CavityFlow(number, GHIA, math.inf, u, v)


def botella_peyret() -> CavityFlow:
    """The tables 9 and 10 of Botella & Peyret (1998), Re = 1000, steady, spectral, at 17 stations, mirrored in x."""
    u = read_curve("botella_peyret1998_u.csv", "y_exact", "u")
    v = read_curve("botella_peyret1998_v.csv", "x_exact", "v")
    return CavityFlow(1000, BOTELLA_PEYRET, math.inf, u, v)


def marchi(reynolds: float) -> CavityFlow:
    """The profiles of Marchi, Suero & Araki (2009), steady, extrapolated from 1024 x 1024 cells, at k / 16.

    The velocities of the walls are added at both ends.

    Raises:
        SphearError: the Reynolds number is none of `MARCHI_REYNOLDS`.
    """
    number = available(reynolds, MARCHI_REYNOLDS, "the tables of Marchi, Suero & Araki")
    u = read_curve("marchi2009_u.csv", "y", f"re{number}")
    v = read_curve("marchi2009_v.csv", "x", f"re{number}")
    return CavityFlow(number, MARCHI, math.inf, _with_walls(u, lid=1.0), _with_walls(v, lid=0.0))


def _with_walls(curve: Curve, lid: float) -> Curve:
    return Curve(np.array([0.0, *curve.stations, 1.0]), np.array([0.0, *curve.values, lid]))
