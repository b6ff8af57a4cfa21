"""Tables 1 to 3 of Zheng, Ma & Shao (2018), Study on SPH viscosity term formulations, Applied Sciences 8(2):249."""

from __future__ import annotations

SIZES = (20, 40, 60, 80, 100)
"""Particles a side of the patch test."""

TERMS = {"VISC-01": "morris", "VISC-02": "gotoh", "VISC-03": "schwaiger", "VISC-04": "oger"}
"""The paper's labels, and the names here."""

TABLE_1: dict[str, tuple[float, ...]] = {
    "morris": (5.00e-5, 9.81e-6, 4.08e-6, 2.22e-6, 1.40e-6),
    "gotoh": (1.68e-5, 4.24e-6, 1.84e-6, 1.02e-6, 6.45e-7),  # the last is printed 6.45e-6, a misprint
    "schwaiger": (4.65e-6, 2.37e-7, 4.38e-8, 1.34e-8, 5.39e-9),
    "oger": (4.65e-6, 2.37e-7, 4.38e-8, 1.34e-8, 5.39e-9),
}
"""Mean errors, uniform particles, by size."""

TABLE_2: dict[str, tuple[float, ...]] = {
    "morris": (2.79e-3, 1.25e-3, 8.41e-4, 6.04e-4, 4.72e-4),
    "gotoh": (1.32e-3, 5.85e-4, 3.80e-4, 2.94e-4, 2.27e-4),
    "schwaiger": (5.62e-5, 1.18e-5, 5.25e-6, 2.90e-6, 1.82e-6),
    "oger": (2.84e-3, 1.28e-3, 8.68e-4, 6.20e-4, 4.85e-4),
}
"""Mean errors, non-uniform particles, by size."""

TABLE_3: dict[str, tuple[float, ...]] = {
    "morris": (0.089, 0.382, 0.900, 1.526, 2.444),
    "gotoh": (0.074, 0.307, 0.739, 1.269, 1.987),
    "schwaiger": (0.204, 0.850, 1.976, 3.500, 5.493),
    "oger": (0.179, 0.741, 1.719, 3.024, 4.722),
}
"""CPU time in seconds, non-uniform particles, by size."""
