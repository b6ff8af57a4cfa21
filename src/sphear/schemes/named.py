"""Settings with the registered names, whatever alias was given."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

from sphear.boundaries import WALL_VELOCITIES
from sphear.corrections import CORRECTIONS
from sphear.kernels import KERNELS
from sphear.names import Registry
from sphear.pressure import PRECONDITIONERS
from sphear.viscosity import VISCOSITY

if TYPE_CHECKING:
    from sphear.schemes.common import SchemeSettings

Chosen = TypeVar("Chosen", bound="SchemeSettings")

REGISTRIES: dict[str, Registry[Any]] = {
    "viscosity": VISCOSITY,
    "correction": CORRECTIONS,
    "gradient_correction": CORRECTIONS,
    "kernel": KERNELS,
    "laplacian": VISCOSITY,
    "wall_velocity": WALL_VELOCITIES,
    "preconditioner": PRECONDITIONERS,
}


def named(settings: Chosen) -> Chosen:
    """The same settings by the registered names.

    Raises:
        SphearError: something has no such name.
    """
    given = {key: getattr(settings, key) for key in REGISTRIES if hasattr(settings, key)}
    if getattr(settings, "scheme", None) == "incompressible":  # which has its own, without aliases
        given.pop("wall_velocity")
    return settings.model_copy(update={key: REGISTRIES[key].name(value) for key, value in given.items()})
