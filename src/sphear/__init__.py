"""sphear: viscous flow with smoothed particle hydrodynamics.

Every published viscous term, exchangeable. The operators work on NumPy arrays of particles:

    laplacian(positions, values, viscosity="morris")
    viscous_acceleration(positions, velocities, viscosity="violeau", dynamic_viscosity=0.01)
    gradient(positions, values, correction="shepard")
    interpolate(positions, values, at=points)

Flows of the cases run from their start to their end:

    flow("cavity", scheme="incompressible", viscosity="oger", reynolds=400).run()

Names are imported when first used, so that importing the package costs nothing.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

__version__ = "0.1.0"

_HOMES = {
    "sphear.cases.flow": ("flow",),
    "sphear.errors": ("SphearError", "TooFewNeighboursError"),
    "sphear.neighbours": ("Domain", "Neighbours"),
    "sphear.operators": ("Particles", "gradient", "interpolate", "laplacian", "viscous_acceleration"),
    "sphear.kernels": (
        "KERNELS", "CubicSpline", "Gaussian", "Kernel", "QuarticSpline", "QuinticSpline", "WendlandC2", "WendlandC4",
        "WendlandC6",
    ),
    "sphear.corrections": ("CORRECTIONS", "BonetLok", "Correction", "NoCorrection", "Renormalised", "Shepard"),
    "sphear.viscosity": (
        "VISCOSITY", "Cleary", "EspanolRevenga", "FatehiManzari", "Gotoh", "LeastSquares", "Monaghan", "Morris", "Oger",
        "Schwaiger", "Takeda", "TwoPass", "ViscousTerm", "Violeau",
    ),
}  # fmt: skip
_HOME = {name: home for home, names in _HOMES.items() for name in names}

__all__ = ["__version__", *_HOME]


def __getattr__(name: str) -> Any:
    if name in _HOME:
        return getattr(import_module(_HOME[name]), name)
    raise AttributeError(f"module 'sphear' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(__all__)
