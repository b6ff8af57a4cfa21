"""Names, aliases and the nearest valid name: one registry class for kernels, corrections and viscous terms."""

from __future__ import annotations

import difflib
import inspect
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
    """Named things of one kind, found by name or alias whatever the case, with '-' and ' ' read as '_'.

    One that is open also has the names of extensions: packages that declare some are imported when a name that is not
    known is looked up, or when all names are gone through.

    Attributes:
        kind: of what has names.
        published: the names that every process knows, those of the package itself; none where it is not open.
    """

    def __init__(self, kind: str) -> None:
        self.kind = kind
        self.published: frozenset[str] = frozenset()
        self._open = False
        self._items: dict[str, T] = {}
        self._aliases: dict[str, str] = {}
        self._given: dict[str, tuple[str, ...]] = {}

    def __repr__(self) -> str:
        """The kind and the names."""
        return f"<Registry of {self.kind}: {', '.join(self._items)}>"

    def open(self) -> None:
        """Let extensions add names from now on; those so far are the package's own."""
        self.published = frozenset(self._items)
        self._open = True

    def add(self, name: str, item: T, aliases: Iterable[str] = ()) -> None:
        """Register an item.

        Raises:
            SphearError: the name or an alias is taken, with what has it.
        """
        aliases = tuple(aliases)
        for key in (name, *aliases):
            if (holder := self.holder(key)) is not None:
                raise SphearError(
                    f"the {self.kind} name {quoted(key)} is taken by {self._whose(holder)}: choose another"
                )
        self._aliases |= {self._plain(key): name for key in (name, *aliases)}
        self._items[name] = item
        self._given[name] = aliases

    def put(self, name: str, item: T) -> None:
        """Register an item in place of what has its name, if anything has."""
        if (holder := self.holder(name)) is not None:
            self.remove(holder)
        self.add(name, item)

    def holder(self, name: str) -> str | None:
        """The registered name that a name or an alias belongs to so far; None where it is free."""
        return self._aliases.get(self._plain(name))

    def held(self, name: str) -> T:
        """The item of a registered name, no extension being looked for."""
        return self._items[name]

    def _whose(self, name: str) -> str:
        """An item in the words of an error: its name, and where it comes from unless that is this package."""
        item = self._items[name]
        kind = item if inspect.isclass(item) else type(item)
        if name in self.published or kind.__module__.startswith("sphear."):
            return f"sphear's own {name}"
        return f"{kind.__qualname__} of the module {kind.__module__}"

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
        if self._plain(name) not in self._aliases:
            self._discover()
        try:
            return self._aliases[self._plain(name)]
        except KeyError:
            raise unknown(self.kind, name, self._items, self._aliases, key) from None

    def __getitem__(self, name: str) -> T:
        return self._items[self.name(name)]

    def __iter__(self) -> Iterator[str]:
        self._discover()
        return iter(tuple(self._items))

    def __len__(self) -> int:
        self._discover()
        return len(self._items)

    def __contains__(self, name: object) -> bool:
        if name not in self._items:
            self._discover()
        return name in self._items

    def _discover(self) -> None:
        """Import what installed packages extend the registry with, the first time."""
        if self._open:
            from sphear.extensions.discovery import discover

            discover()

    _plain = staticmethod(plain)
