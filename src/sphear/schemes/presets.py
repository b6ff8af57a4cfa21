"""Settings that belong together, by name."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from sphear.names import Registry

PRESETS: Registry[Mapping[str, Any]] = Registry("preset")

# Basa, Quinlan & Lastiwka 2009, section 6: what the settings are if nothing else is said
PRESETS.add("paper", {}, ("basa2009",))

# what was found best of all: second derivatives that are exact for quadratic fields, first ones for linear fields, a
# density that diffusion keeps smooth, particles that shifting keeps regular
PRESETS.add(
    "modern",
    {
        "viscosity": "fatehi_manzari",
        "correction": "bonet_lok",
        "kernel": "wendland_c2",
        "density": "continuity",
        "density_diffusion": 0.1,
        "diffusion_form": "antuono",
        "pressure_reduction": "none",
        "transport": "shifting",
        "walls": "mirror",
        "slip": True,
        "wall_velocity": "quadratic",
    },
)
