"""Schemes: the order in which sweeps are made in a time step."""
