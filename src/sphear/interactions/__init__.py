"""What is summed over pairs of particles."""

from sphear.interactions.density import SummationDensity
from sphear.interactions.gradient import Divergence, Gradient
from sphear.interactions.interpolation import Interpolation, NumberDensity
from sphear.interactions.laplacian import Laplacian
from sphear.interactions.momentum import Momentum
from sphear.interactions.reduced_momentum import ReducedMomentum
from sphear.interactions.viscous_acceleration import ViscousAcceleration

__all__ = [
    "Divergence",
    "Gradient",
    "Interpolation",
    "Laplacian",
    "Momentum",
    "NumberDensity",
    "ReducedMomentum",
    "SummationDensity",
    "ViscousAcceleration",
]
