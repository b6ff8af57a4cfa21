"""Tables of results, for the terminal and for a file."""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import rich.box
import rich.table
from rich.cells import cell_len
from rich.console import Console, ConsoleOptions, JustifyMethod, RenderResult
from rich.text import Text

ABSENT = "–"
"""What the terminal shows where a row has no value."""


@dataclass(frozen=True)
class Column:
    """One column of a table.

    Attributes:
        key: Where a row keeps the value; the heading of the column in a CSV file.
        heading: What a reader sees above the column.
        format: Format specification of numbers (``".2e"``, ``"d"``); without one the column is text.
    """

    key: str
    heading: str
    format: str = ""

    def text(self, value: object) -> str:
        """Return a value as a paper prints it: 5.00e-5, not 5.00e-05."""
        if value is None or (isinstance(value, float) and math.isnan(value)):
            return ABSENT
        if isinstance(value, str) or not self.format:
            return str(value)
        return re.sub(r"e\+?(-?)0*(?=\d)", r"e\1", format(value, self.format))


@dataclass(frozen=True)
class Blocks:
    """A table as wide as a console: columns that do not fit go below, behind the first one, and no number is broken.

    Only where a console is narrower than two columns is a value wrapped, and no digit is ever cut off.
    """

    table: Table

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        """Yield a Rich table for each block."""
        table = self.table
        cells = [[column.text(row.get(column.key)) for row in table.rows] for column in table.columns]
        widths = [_width(column, values) for column, values in zip(table.columns, cells, strict=True)]
        whole = sum(max(cell_len(text) for text in (column.heading, *values)) + 2
                    for column, values in zip(table.columns, cells, strict=True))  # fmt: skip
        fits = whole + len(widths) + 1 <= options.max_width
        blocks = [list(range(len(widths)))] if fits else packed(widths, options.max_width)
        for number, block in enumerate(blocks):
            title = Text(table.title, "bold") if number == 0 else None
            shown = rich.table.Table(title=title, title_justify="left", box=rich.box.SIMPLE_HEAD)
            narrow = sum(widths[k] + 3 for k in block) + 1 > options.max_width
            for k in block:
                column = table.columns[k]
                justify: JustifyMethod = "right" if column.format else "left"
                least = None if fits or narrow else widths[k]
                shown.add_column(Text(column.heading), justify=justify, overflow="fold", min_width=least)
            for row in range(len(table.rows)):
                shown.add_row(*(Text(cells[k][row]) for k in block))
            yield shown


def packed(widths: Sequence[int], room: int) -> list[list[int]]:
    """Columns, by number, that fit beside each other; the first is in each block.

    Args:
        widths: of the columns, in letters.
        room: width of a block, with a letter on each side of a column and between two.
    """
    blocks: list[list[int]] = []
    for k in range(1, len(widths)):
        used = sum(widths[j] + 3 for j in blocks[-1]) + 1 if blocks else room
        if used + widths[k] + 3 <= room:
            blocks[-1].append(k)
        else:
            blocks.append([0, k])
    return blocks or [[0]][: len(widths)]


def _width(column: Column, values: Sequence[str]) -> int:
    """The least width at which nothing but text between words is wrapped."""
    whole = values if column.format else [word for value in values for word in value.split()]
    return max(map(cell_len, (*column.heading.split(), *whole)), default=1)


@dataclass(frozen=True)
class Table:
    """Rows of results and how to show them; a row may lack values and may hold more than is shown."""

    title: str
    columns: tuple[Column, ...]
    rows: Sequence[Mapping[str, object]]

    def render(self) -> Blocks:
        """Return the table for a Rich console, in as many blocks of columns as its width needs."""
        return Blocks(self)

    def to_csv(self, path: Path) -> None:
        """Write the columns to a CSV file, numbers in full precision and absent values empty."""
        with path.open("w", encoding="utf-8", newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(column.key for column in self.columns)
            writer.writerows([row.get(column.key) for column in self.columns] for row in self.rows)
