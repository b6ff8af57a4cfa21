"""Zheng, Ma & Shao 2018: four viscous terms in an incompressible solver."""
