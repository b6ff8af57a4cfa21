"""Boundaries of flows: periodic sides, and walls of mirror particles or of fixed ones."""

from sphear.boundaries.box import Box
from sphear.boundaries.continuation import CONTINUATIONS
from sphear.boundaries.fixed import WallParticles, particles_behind, wall_particles

__all__ = ["CONTINUATIONS", "Box", "WallParticles", "particles_behind", "wall_particles"]
