"""Names, aliases and the nearest valid name: one registry class for kernels, corrections and viscous terms."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Iterator
from typing import Generic, TypeVar

from sphear.errors import SphearError

T = TypeVar("T")


def unknown(kind: str, name: object, valid: Iterable[str], aliases: Iterable[str] = ()) -> SphearError:
    """The error for a name that does not exist, with the nearest valid ones (aliases too) first."""
    valid = list(valid)
    near = difflib.get_close_matches(str(name).lower(), list(dict.fromkeys((*valid, *aliases))), n=3, cutoff=0.5)
    hint = f"did you mean {' or '.join(near)}? " if near else ""
    return SphearError(f"there is no {kind} named {str(name)!r}: {hint}{kind} is one of {', '.join(valid)}")


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

    def name(self, name: str) -> str:
        """The registered name behind a name or an alias; raises SphearError with the nearest names."""
        try:
            return self._aliases[self._plain(name)]
        except KeyError:
            raise unknown(self.kind, name, self._items, self._aliases) from None

    def __getitem__(self, name: str) -> T:
        return self._items[self.name(name)]

    def __iter__(self) -> Iterator[str]:
        return iter(self._items)

    def __len__(self) -> int:
        return len(self._items)

    @staticmethod
    def _plain(name: str) -> str:
        return str(name).strip().lower().replace("-", "_").replace(" ", "_")
