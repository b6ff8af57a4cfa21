"""Boundaries of flows: periodic sides, and walls of mirror particles or of fixed ones.

Names are imported when first used: wall models are listed without what computes.
"""

from typing import TYPE_CHECKING

from sphear.lazy import lazy_names

if TYPE_CHECKING:
    from sphear.boundaries.box import Box
    from sphear.boundaries.continuations import CONTINUATIONS
    from sphear.boundaries.fixed import WallParticles, particles_behind, wall_particles
else:
    __getattr__ = lazy_names(
        __name__,
        {
            "sphear.boundaries.box": ("Box",),
            "sphear.boundaries.continuations": ("CONTINUATIONS",),
            "sphear.boundaries.fixed": ("WallParticles", "particles_behind", "wall_particles"),
        },
    )

__all__ = ["CONTINUATIONS", "Box", "WallParticles", "particles_behind", "wall_particles"]
