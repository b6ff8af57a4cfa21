"""Basa, Quinlan & Lastiwka 2009: five viscous terms in weakly compressible and compressible solvers."""
