"""Boundaries of flows: periodic sides, and walls of mirror particles or of fixed ones."""

from sphear.boundaries.box import Box
from sphear.boundaries.fixed import WallParticles, wall_particles
from sphear.boundaries.wall_velocity import WALL_VELOCITIES

__all__ = ["WALL_VELOCITIES", "Box", "WallParticles", "wall_particles"]
