"""Incompressible flow by projection: a pressure that makes the velocity free of divergence in each step."""
