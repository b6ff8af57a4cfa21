"""Viscous terms: one file each, with its formula and its source."""

from __future__ import annotations

from sphear.names import Registry
from sphear.viscosity.base import LaplacianTerm, ViscousTerm, uncorrected
from sphear.viscosity.cleary import Cleary
from sphear.viscosity.espanol_revenga import EspanolRevenga
from sphear.viscosity.fatehi_manzari import FatehiManzari
from sphear.viscosity.gotoh import Gotoh
from sphear.viscosity.least_squares import LeastSquares
from sphear.viscosity.monaghan import Monaghan
from sphear.viscosity.morris import Morris
from sphear.viscosity.oger import Oger
from sphear.viscosity.schwaiger import Schwaiger
from sphear.viscosity.takeda import Takeda
from sphear.viscosity.two_pass import TwoPass
from sphear.viscosity.varying import with_varying_viscosity
from sphear.viscosity.violeau import Violeau

VISCOSITY: Registry[ViscousTerm] = Registry("viscosity")
for _term in (
    Takeda(),
    TwoPass(),
    Violeau(),
    Cleary(),
    Morris(),
    Monaghan(),
    Gotoh(),
    Schwaiger(),
    Oger(),
    EspanolRevenga(),
    FatehiManzari(),
    LeastSquares(),
):
    VISCOSITY.add(_term.name, _term, _term.aliases)
# settings of a term that have a name of their own
VISCOSITY.add("cleary_4.24", Cleary(xi=4.24))
VISCOSITY.add("cleary_4.96333", Cleary(xi=4.96333))
VISCOSITY.add("least_squares_3", LeastSquares(degree=3))
VISCOSITY.add("least_squares_4", LeastSquares(degree=4))
VISCOSITY.open()

__all__ = [
    "VISCOSITY",
    "Cleary",
    "EspanolRevenga",
    "FatehiManzari",
    "Gotoh",
    "LaplacianTerm",
    "LeastSquares",
    "Monaghan",
    "Morris",
    "Oger",
    "Schwaiger",
    "Takeda",
    "TwoPass",
    "Violeau",
    "ViscousTerm",
    "uncorrected",
    "with_varying_viscosity",
]
