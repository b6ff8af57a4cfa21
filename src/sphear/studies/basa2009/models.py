"""The models of the paper: viscous terms by its letters, and corrections by its levels."""

from __future__ import annotations

MODELS = {"A": "takeda", "B": "two_pass", "C": "violeau", "D": "cleary_4.24", "E": "morris"}
LEVELS = {"none": "no correction", "shepard": "level 0", "bonet_lok": "level 1"}
CORRECTIONS = tuple(LEVELS)
