"""Settings that belong together, by name."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from sphear.names import Registry, unknown

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

INCOMPRESSIBLE: Registry[Mapping[str, Any]] = Registry("preset")

# what was found best of all: the defaults
INCOMPRESSIBLE.add("modern", {})

# Zheng, Ma & Shao 2018, sections 2 and 5
INCOMPRESSIBLE.add(
    "paper",
    {
        "viscosity": "oger",
        "kernel": "cubic_spline",
        "h_over_dx": 1.2,
        "gradient": "symmetric",
        "gradient_correction": "none",
        "laplacian": "morris",
        "alpha": 0.01,
        "projection": "intermediate",
        "neumann": "sfdi",
        "wall_velocity": "mirror",
        "slip": False,
        "shifting": "none",
    },
    ("zheng2018",),
)

BY_SCHEME = {"explicit": PRESETS, "incompressible": INCOMPRESSIBLE}


def preset_settings(name: str, scheme: str) -> dict[str, Any]:
    """The settings of a preset for a scheme.

    Raises:
        SphearError: there is none of that name.
    """
    if scheme not in BY_SCHEME:
        raise unknown("scheme", scheme, BY_SCHEME)
    return dict(BY_SCHEME[scheme][name])
