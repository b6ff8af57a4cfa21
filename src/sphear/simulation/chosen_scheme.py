"""The scheme of a simulation, as an object or by its name."""

from __future__ import annotations

from typing import Any

from sphear.names import unknown
from sphear.schemes.common import Scheme
from sphear.schemes.incompressible.settings import Incompressible
from sphear.schemes.registered_names import named
from sphear.schemes.weakly_compressible.settings import WeaklyCompressible

SCHEMES: dict[str, type[Scheme]] = {"incompressible": Incompressible, "weakly_compressible": WeaklyCompressible}


def chosen_scheme(given: object) -> Any:
    """A scheme, by its name too, with the registered names of its parts."""
    if given is None:
        return Incompressible()
    if isinstance(given, str):
        if given not in SCHEMES:
            raise unknown("scheme", given, SCHEMES)
        return SCHEMES[given]()
    return named(given) if isinstance(given, Scheme) else given
