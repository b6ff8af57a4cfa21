"""Settings that belong together, by the name of the paper that has them; without one, the defaults are the best."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from sphear.names import Registry, unknown

PRESETS: Registry[Mapping[str, Any]] = Registry("preset")

# Basa, Quinlan & Lastiwka 2009, section 6; all is spelled out, so that it stays when defaults change
PRESETS.add(
    "basa2009",
    {
        "viscosity": "morris",
        "correction": "none",
        "kernel": "cubic_spline",
        "h_over_dx": None,
        "equation_of_state": "batchelor_tait",
        "density": "summation",
        "momentum": None,
        "pressure_reduction": "mean",
        "density_diffusion": 0.0,
        "diffusion_form": "molteni",
        "walls": "mirror",
        "continuation": "linear",
        "wall_divergence": "continued",
        "wall_particles": False,
        "integrator": "midpoint",
        "transport": "none",
    },
)

INCOMPRESSIBLE: Registry[Mapping[str, Any]] = Registry("preset")

# Zheng, Ma & Shao 2018, sections 2 and 5
INCOMPRESSIBLE.add(
    "zheng2018",
    {
        "viscosity": "oger",
        "kernel": "cubic_spline",
        "h_over_dx": 1.2,
        "gradient": "symmetric",
        "gradient_correction": "none",
        "laplacian": "morris",
        "alpha": 0.01,
        "projection": "intermediate",
        "walls": "sfdi",
        "continuation": "mirror",
        "wall_divergence": "continued",
        "shifting": "none",
    },
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
