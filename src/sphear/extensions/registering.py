"""A name for a thing: checked, filled in on its class where that says nothing, and put into the registry."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterable
from typing import Any, TypeVar

from sphear.corrections import VALUE_CORRECTIONS
from sphear.errors import SphearError, quoted
from sphear.names import Registry, plain

T = TypeVar("T")

_NAME = re.compile(r"\w[\w .+-]*")
_SAYING_NOTHING = ("unnamed", "not stated", ())


def checked_names(decorator: str, name: Any, aliases: Any) -> tuple[str, ...]:
    """The name and its aliases.

    Raises:
        SphearError: one is no text that can be written on a command line, or there is none.
    """
    if isinstance(name, type) or callable(name):
        raise SphearError(
            f'@sphear.{decorator} takes a name: write @sphear.{decorator}("mine") above'
            f" {getattr(name, '__name__', 'it')}"
        )
    if isinstance(aliases, str) or not isinstance(aliases, Iterable):
        raise SphearError(
            f"the aliases of {quoted(name)} are a sequence of names, such as ('my term',), not {aliases!r}"
        )
    names = (name, *aliases)
    for one in names:
        if not isinstance(one, str) or not _NAME.fullmatch(one):
            raise SphearError(
                f"a name is made of letters, digits, spaces and the signs _ . + -, and begins with a letter or digit:"
                f" {quoted(one)} is none"
            )
    return names


def register(registry: Registry[T], names: tuple[str, ...], item: T, kind: type) -> None:
    """Put an item into a registry; the same definition, run again as in a notebook, takes the place of the first.

    Args:
        registry: of its kind.
        names: the name and its aliases.
        item: the object or class that is found by the name.
        kind: its class, whose name, formula and source are filled in where it does not state them.

    Raises:
        SphearError: a name is taken, with what has it.
    """
    holders = {holder for one in names if (holder := registry.holder(one)) is not None}
    for holder in holders:
        if holder not in registry.published and _origin(registry.held(holder)) == _origin(item):
            registry.remove(holder)
    if registry.kind == "correction":
        for one in names:
            if plain(one) in VALUE_CORRECTIONS:
                raise SphearError(f"the correction name {quoted(one)} is taken by sphear's own {one}: choose another")
    registry.add(names[0], item, names[1:])
    _fill_in(kind, names)


def _origin(item: object) -> tuple[str, str]:
    kind = item if inspect.isclass(item) else type(item)
    return kind.__module__, kind.__qualname__


def _fill_in(kind: type, names: tuple[str, ...]) -> None:
    """State the name and origin on a user's class that does not; classes of the package stay as they are."""
    if kind.__module__.startswith("sphear."):
        return
    filled = {"name": names[0], "aliases": names[1:], "source": f"{kind.__qualname__} of the module {kind.__module__}"}
    for key, value in filled.items():
        if getattr(kind, key) in _SAYING_NOTHING:
            setattr(kind, key, value)
