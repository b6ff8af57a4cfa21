"""The work of forces in a step, summed over the particles in one pass."""

from __future__ import annotations

from sphear.engine.cache import compiled

BLOCK = 256  # particles, whose sums are added up: that keeps rounding small


@compiled
def work(before, after, acceleration):  # type: ignore[no-untyped-def]  # pragma: no cover
    """Sum (u + u') . a and |(u + u') . a| over particles of velocities u, u' (N, d).

    Args:
        before, after: u and u'.
        acceleration: (N, d), a, or (1, d) of all.
    """
    whole, turned = 0.0, 0.0
    for begin in range(0, len(before), BLOCK):
        of_block, turned_in_block = 0.0, 0.0
        for particle in range(begin, min(begin + BLOCK, len(before))):
            row = particle if len(acceleration) > 1 else 0
            own = 0.0
            for axis in range(before.shape[1]):
                own += (before[particle, axis] + after[particle, axis]) * acceleration[row, axis]
            of_block += own
            turned_in_block += abs(own)
        whole += of_block
        turned += turned_in_block
    return whole, turned
