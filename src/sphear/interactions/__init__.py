"""Interactions: what is summed over the neighbours of each particle."""

from sphear.interactions.continuity import Continuity, DensityDiffusion, DensityGradient
from sphear.interactions.density import SummationDensity
from sphear.interactions.gradient import Divergence, Gradient
from sphear.interactions.internal_energy import InternalEnergy
from sphear.interactions.interpolation import Interpolation, NumberDensity
from sphear.interactions.laplacian import Laplacian
from sphear.interactions.pressure_force import PressureForce
from sphear.interactions.rates import Part, Rates
from sphear.interactions.transport import (
    Advection,
    DensityAdvection,
    Shifting,
    TransportStress,
    TransportVelocity,
)
from sphear.interactions.viscous_acceleration import ViscousAcceleration, ViscousForce

__all__ = [
    "Advection",
    "Continuity",
    "DensityAdvection",
    "DensityDiffusion",
    "DensityGradient",
    "Divergence",
    "Gradient",
    "InternalEnergy",
    "Interpolation",
    "Laplacian",
    "NumberDensity",
    "Part",
    "PressureForce",
    "Rates",
    "Shifting",
    "SummationDensity",
    "TransportStress",
    "TransportVelocity",
    "ViscousAcceleration",
    "ViscousForce",
]
