"""Boundaries of flows: periodic sides, and walls by mirror particles whose velocity is continued beyond the wall."""

from sphear.boundaries.box import Box
from sphear.boundaries.wall_velocity import WALL_VELOCITIES

__all__ = ["WALL_VELOCITIES", "Box"]
