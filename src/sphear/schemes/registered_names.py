"""Names of settings resolved: the registered name for whatever alias was given; objects stay."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, TypeVar, get_origin

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from sphear.boundaries import CONTINUATIONS
from sphear.boundaries.models import WALL_MODELS
from sphear.corrections import CORRECTIONS
from sphear.kernels import KERNELS
from sphear.names import Registry
from sphear.pressure import PRECONDITIONERS
from sphear.schemes.objects import plain
from sphear.schemes.weakly_compressible.integrators import INTEGRATORS
from sphear.shifting import SHIFTING
from sphear.viscosity import VISCOSITY

if TYPE_CHECKING:
    from sphear.schemes.common import Scheme

Chosen = TypeVar("Chosen", bound="Scheme")

REGISTRIES: dict[str, Registry[Any]] = {
    "viscosity": VISCOSITY,
    "correction": CORRECTIONS,
    "gradient_correction": CORRECTIONS,
    "kernel": KERNELS,
    "laplacian": VISCOSITY,
    "continuation": CONTINUATIONS,
    "preconditioner": PRECONDITIONERS,
    "walls": WALL_MODELS,
    "shifting": SHIFTING,
    "integrator": INTEGRATORS,
}


def named(settings: Chosen) -> Chosen:
    """The same settings by the registered names; objects stay as they are.

    Raises:
        SphearError: something has no such name.
    """
    given = {key: getattr(settings, key) for key in registries(type(settings))}
    names = {key: plain(value, REGISTRIES[key], _said(key)) for key, value in given.items()}
    changed = {key: name for key, name in names.items() if name != given[key]}  # others stay as nobody named them
    return settings.model_copy(update=changed)


def registries(kind: type[BaseModel]) -> dict[str, Registry[Any]]:
    """The registries of the settings of a class that are registered names; the others have a few of their own."""
    return {key: REGISTRIES[key] for key, field in kind.model_fields.items() if key in REGISTRIES and _open(field)}


def choices(kind: type[BaseModel]) -> dict[str, list[str]]:
    """The names that the settings of a class take, of those that are registered names."""
    flat = getattr(kind, "flat", {})
    return {
        key: [name for name in registry if key not in flat or isinstance(registry[name], flat[key].kind)]
        for key, registry in registries(kind).items()
    }


def _open(field: FieldInfo) -> bool:
    return get_origin(field.annotation) is not Literal


def _said(key: str) -> str:
    """The setting, where an error would not name it by what it takes."""
    return "" if REGISTRIES[key].kind == key.replace("_", " ") else f"the setting {key}"
