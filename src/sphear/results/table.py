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
from rich.console import JustifyMethod
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
class Table:
    """Rows of results and how to show them; a row may lack values and may hold more than is shown."""

    title: str
    columns: tuple[Column, ...]
    rows: Sequence[Mapping[str, object]]

    def render(self) -> rich.table.Table:
        """Return the table for a Rich console; one that is too narrow wraps a number but never cuts digits off."""
        table = rich.table.Table(title=Text(self.title, "bold"), title_justify="left", box=rich.box.SIMPLE_HEAD)
        for column in self.columns:
            justify: JustifyMethod = "right" if column.format else "left"
            table.add_column(Text(column.heading), justify=justify, overflow="fold")
        for row in self.rows:
            table.add_row(*(Text(column.text(row.get(column.key))) for column in self.columns))
        return table

    def to_csv(self, path: Path) -> None:
        """Write the columns to a CSV file, numbers in full precision and absent values empty."""
        with path.open("w", encoding="utf-8", newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(column.key for column in self.columns)
            writer.writerows([row.get(column.key) for column in self.columns] for row in self.rows)
