"""A simulation: a region, a fluid, what happens at walls, a scheme that computes it and observers that watch it."""
