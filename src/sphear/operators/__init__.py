"""The operators on particles: the public functions, and `Particles` to apply many to the same particles."""

from sphear.operators.particles import Particles
from sphear.operators.public import gradient, interpolate, laplacian, viscous_acceleration

__all__ = ["Particles", "gradient", "interpolate", "laplacian", "viscous_acceleration"]
