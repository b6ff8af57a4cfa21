"""Settings that are objects, and names that a program gave them, on their way to worker processes."""

from __future__ import annotations

import pickle
import sys
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from sphear.errors import SphearError

if TYPE_CHECKING:
    from sphear.sweeps.plan import Run


@dataclass(frozen=True)
class Named:
    """A viscous term by a name that a program gave it, which another process does not know."""

    name: str
    term: Any


def sent(settings: Mapping[str, Any]) -> dict[str, Any]:
    """The settings of a run as a worker gets them: viscous terms that a program named go along with their names."""
    from sphear.viscosity import PUBLISHED, VISCOSITY

    return {
        key: Named(value, VISCOSITY[value])
        if key in ("viscosity", "laplacian") and isinstance(value, str) and value not in PUBLISHED
        else value
        for key, value in settings.items()
    }


def received(settings: Mapping[str, Any]) -> dict[str, Any]:
    """The settings that were sent, their names known from now on."""
    for value in settings.values():
        if isinstance(value, Named):
            from sphear.viscosity import VISCOSITY

            if value.name not in VISCOSITY:
                VISCOSITY.add(value.name, value.term)
    return {key: value.name if isinstance(value, Named) else value for key, value in settings.items()}


def check_sendable(runs: Iterable[Run]) -> None:
    """Refuse objects of classes that a process of its own cannot import.

    Raises:
        SphearError: one is of a class of a notebook, an interactive session or a function.
    """
    alone = not hasattr(sys.modules["__main__"], "__file__")  # nothing that a worker could import again
    for run in runs:
        for key, value in run.sent.items():
            found = value.term if isinstance(value, Named) else value
            try:
                pickle.dumps(found)
                reached = not (alone and type(found).__module__ == "__main__")
            except (pickle.PicklingError, AttributeError, TypeError):
                reached = False
            if not reached:
                raise SphearError(
                    f"the {key} {type(found).__name__} of this sweep is of a class that worker processes cannot import:"
                    " put the class into a module, or at the top of the script that starts the sweep"
                )
