"""Settings that are objects, and names that a program gave them, on their way to worker processes."""

from __future__ import annotations

import pickle
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from sphear.errors import SphearError

if TYPE_CHECKING:
    from sphear.names import Registry
    from sphear.sweeps.plan import Run


@dataclass(frozen=True)
class Named:
    """A viscous term, kernel, correction or equation of state by a name that the package does not give it.

    Attributes:
        name: registered where the sweep is started; another process may not know it.
        item: what is found by the name.
    """

    name: str
    item: Any


def sent(settings: Mapping[str, Any]) -> dict[str, Any]:
    """The settings of a run as a worker gets them: what has a name that others gave it goes along with the name."""
    found = dict(settings)
    for key, registry in _registries():
        value = found.get(key)
        if isinstance(value, str) and value not in registry.published and registry.holder(value) == value:
            found[key] = Named(value, registry.held(value))
    return found


def packed(run: Run, dumps: Callable[[Any], bytes] = pickle.dumps) -> bytes:
    """The settings of a run in bytes, so that a worker imports extensions before it reads them."""
    return dumps(run.sent)


def received(payload: bytes) -> dict[str, Any]:
    """The settings that were sent, their names known from now on, in place of what had them before."""
    settings: dict[str, Any] = pickle.loads(payload)
    if any(isinstance(value, Named) for value in settings.values()):
        for key, registry in _registries():
            value = settings.get(key)
            if isinstance(value, Named):
                registry.put(value.name, value.item)
    return {key: value.name if isinstance(value, Named) else value for key, value in settings.items()}


def _registries() -> Iterator[tuple[str, Registry[Any]]]:
    """The settings that extensions have names for."""
    from sphear.equations_of_state import EQUATIONS_OF_STATE
    from sphear.schemes.registered_names import REGISTRIES

    yield from ((key, registry) for key, registry in REGISTRIES.items() if registry.published)
    yield "equation_of_state", EQUATIONS_OF_STATE


def check_sendable(runs: Iterable[Run]) -> None:
    """Refuse objects of classes that a process of its own cannot import.

    Raises:
        SphearError: one is of a class of a notebook, an interactive session or a function.
    """
    alone = not hasattr(sys.modules["__main__"], "__file__")  # nothing that a worker could import again
    for run in runs:
        for key, value in run.sent.items():
            found = value.item if isinstance(value, Named) else value
            kind = found if isinstance(found, type) else type(found)
            try:
                pickle.dumps(found)
                reached = not (alone and kind.__module__ == "__main__")
            except (pickle.PicklingError, AttributeError, TypeError):
                reached = False
            if not reached:
                said = f"{value.name!r}, " if isinstance(value, Named) else ""
                raise SphearError(
                    f"the {key} {said}{kind.__name__} of this sweep is of a class that worker processes cannot import:"
                    " put the class into a module, or at the top of the script that starts the sweep"
                )
