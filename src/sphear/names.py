"""Names, aliases and the nearest valid name: one registry class for kernels, corrections and viscous terms."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Iterator
from typing import Generic, TypeVar

from sphear.errors import LONGEST, SphearError, quoted

T = TypeVar("T")


def unknown(kind: str, name: object, valid: Iterable[str], aliases: Iterable[str] = (), key: str = "") -> SphearError:
    """The error for a name that does not exist, with the nearest valid ones (aliases too) first.

    Args:
        kind: of what has names.
        name: as it was given.
        valid: the names that there are.
        aliases: other names of these.
        key: the setting that was given it, where that is called otherwise than the kind.
    """
    valid = list(valid)
    spellings: dict[str, str] = {}  # one for all that differ in case, hyphens and underscores: the first
    for known in (*valid, *aliases):
        spellings.setdefault(plain(known), known)
    near = difflib.get_close_matches(plain(name)[:LONGEST], list(spellings), n=3, cutoff=0.5)
    hint = f"did you mean {' or '.join(spellings[found] for found in near)}? " if near else ""
    where = f"{key} is to be a {kind}, and " if key else ""
    return SphearError(
        f"{where}there is no {kind} named {quoted(str(name))}: {hint}{kind} is one of {', '.join(valid)}"
    )


def plain(name: object) -> str:
    """A name whatever the case, with '-' and ' ' read as '_'."""
    return str(name).strip().lower().replace("-", "_").replace(" ", "_")


class Registry(Generic[T]):
    """Named things of one kind, found by name or alias whatever the case, with '-' and ' ' read as '_'."""

    def __init__(self, kind: str) -> None:
        self.kind = kind
        self._items: dict[str, T] = {}
        self._aliases: dict[str, str] = {}
        self._given: dict[str, tuple[str, ...]] = {}

    def __repr__(self) -> str:
        """The kind and the names."""
        return f"<Registry of {self.kind}: {', '.join(self._items)}>"

    def add(self, name: str, item: T, aliases: Iterable[str] = ()) -> None:
        """Register an item; a name or alias taken twice is a programming error."""
        aliases = tuple(aliases)
        for key in (name, *aliases):
            if self._plain(key) in self._aliases:
                raise KeyError(f"the {self.kind} name {key!r} is taken twice")
            self._aliases[self._plain(key)] = name
        self._items[name] = item
        self._given[name] = aliases

    def aliases(self, name: str) -> list[str]:
        """The other names of an item, as they were given."""
        return list(self._given[self.name(name)])

    def remove(self, name: str) -> None:
        """Forget an item that was added for a time."""
        del self._items[name], self._given[name]
        self._aliases = {alias: of for alias, of in self._aliases.items() if of != name}

    def name(self, name: str, key: str = "") -> str:
        """The registered name behind a name or an alias.

        Args:
            name: as it was given.
            key: the setting that was given it, where that is called otherwise than the kind.

        Raises:
            SphearError: there is none, with the nearest names.
        """
        try:
            return self._aliases[self._plain(name)]
        except KeyError:
            raise unknown(self.kind, name, self._items, self._aliases, key) from None

    def __getitem__(self, name: str) -> T:
        return self._items[self.name(name)]

    def __iter__(self) -> Iterator[str]:
        return iter(self._items)

    def __len__(self) -> int:
        return len(self._items)

    _plain = staticmethod(plain)
