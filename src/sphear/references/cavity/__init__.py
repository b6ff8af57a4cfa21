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

from sphear.references.cavity.computed import MAC_TIMES, OPENFOAM_TIMES, cavity_cylinder, mac, openfoam
from sphear.references.cavity.curve import Curve
from sphear.references.cavity.extrema import Extrema, extrema
from sphear.references.cavity.flow import CavityFlow
from sphear.references.cavity.published import GHIA_REYNOLDS, MARCHI_REYNOLDS, botella_peyret, ghia, marchi

__all__ = [
    "GHIA_REYNOLDS",
    "MAC_TIMES",
    "MARCHI_REYNOLDS",
    "OPENFOAM_TIMES",
    "CavityFlow",
    "Curve",
    "Extrema",
    "botella_peyret",
    "cavity_cylinder",
    "extrema",
    "ghia",
    "mac",
    "marchi",
    "openfoam",
]
