"""The text of a stage that depends on a flow's formulas, and the arrays that it asks for."""

from __future__ import annotations

from dataclasses import dataclass, field

from sphear.engine.backends.cpu import sizes
from sphear.engine.flags import options_text

_MODULE = '''
"""{title}"""

from numba import prange
from sphear.engine.backends.cpu.views import (
    float_table, floats, integer_table, integers, octet_table, octets, short_integer_table, short_integers,
)
from sphear.engine.cache import njit
{imports}


@njit({options})
def stage(table, sizes):
    """{title}"""
    {views}
    {body}
    return 0
'''


def block(lines: list[str], indent: int) -> str:
    """Lines at a place of a text that is indented so far."""
    return ("\n" + " " * indent).join(lines) if lines else "pass"


@dataclass
class WrittenStage:
    """A stage that is being written.

    Attributes:
        title: said in its text.
        arrays: the names of the arrays in its table, in the order in which it was given them.
        imports: lines of its module.
        views: lines that make arrays of addresses.
        body: lines that compute.
    """

    title: str
    arrays: list[str] = field(default_factory=list)
    imports: list[str] = field(default_factory=list)
    views: list[str] = field(default_factory=list)
    body: list[str] = field(default_factory=list)

    def view(self, name: str, array: str, kind: str, *shape: int | str) -> str:
        """Make an array known to the text.

        Args:
            name: in the text.
            array: the name of the array in memory.
            kind: of `sphear.engine.backends.cpu.views`.
            shape: its extents, as text: a number, or the name of one of the sizes.
        """
        line = f"{name} = {kind}(table[{{place}}], {', '.join(map(self._extent, shape))})"
        if not any(known.startswith(f"{name} = ") for known in self.views):
            self.views.append(line.format(place=len(self.arrays)))
            self.arrays.append(array)
        return name

    @staticmethod
    def _extent(extent: int | str) -> str:
        """A number of the array of sizes, by its name, or a number."""
        if isinstance(extent, int):
            return str(extent)
        name, _, more = extent.partition(" ")
        return f"sizes[{getattr(sizes, name)}]{' ' + more if more else ''}"

    def size(self, name: str, size: str) -> None:
        """Make one of the sizes known to the text."""
        self.views.append(f"{name} = {self._extent(size)}")

    def text(self, parallel: bool) -> str:
        """The module of the stage.

        Args:
            parallel: whether loops over parts are shared out to threads.
        """
        return _MODULE.format(
            title=self.title,
            imports="\n".join(self.imports),
            options=options_text() + (", parallel=True" if parallel else ""),
            views=block(self.views, 4),
            body=block(self.body, 4),
        )
