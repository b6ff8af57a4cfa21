import csv
import io
import math
from dataclasses import FrozenInstanceError
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import given
from hypothesis import strategies as st
from rich.console import Console

from sphear.results import Column, Table
from sphear.results.table import packed

TABLE = Table(
    "Errors of two viscous terms",
    (Column("viscosity", "viscous term"), Column("particles", "N", "d"), Column("error", "error [L1]", ".2e")),
    [
        {"viscosity": "morris", "particles": 20, "error": 5.004e-5, "seed": 7},
        {"viscosity": "[bold]gotoh", "particles": 400},
    ],
)


def shown(table: Table, width: int = 80) -> str:
    file = io.StringIO()
    Console(file=file, width=width).print(table.render())
    return file.getvalue()


@pytest.mark.parametrize(
    ("value", "spec", "text"),
    [
        (5.00e-5, ".2e", "5.00e-5"),
        (1.5e12, ".1e", "1.5e12"),
        (0.0, ".2e", "0.00e0"),
        (1e-100, ".0e", "1e-100"),
        (math.inf, ".2e", "inf"),
        (20, "d", "20"),
        (0.0131, ".1%", "1.3%"),
        (None, ".2e", "–"),
        ("diverges", ".2e", "diverges"),
        ("e-05", "", "e-05"),
    ],
)
def test_numbers_look_as_in_a_paper(value: object, spec: str, text: str) -> None:
    assert Column("key", "heading", spec).text(value) == text


@given(st.floats(allow_nan=False))
def test_a_number_shown_is_the_number_rounded(value: float) -> None:
    assert float(Column("key", "heading", ".2e").text(value)) == float(f"{value:.2e}")


def test_a_table_shows_headings_values_and_absences() -> None:
    text = shown(TABLE)
    for part in (TABLE.title, "viscous term", "error [L1]", "5.00e-5", "[bold]gotoh", "–"):
        assert part in text
    assert "seed" not in text


def test_a_narrow_terminal_cuts_no_digit_off() -> None:
    value = 123456789012
    text = shown(Table("", (Column("a", "a", "d"), Column("b", "b", "d")), [{"a": value, "b": value}]), width=16)
    digits = [character for character in text if character.isdigit()]
    assert sorted(digits) == sorted(2 * str(value))
    assert "…" not in text


def test_a_csv_file_has_keys_and_full_precision(tmp_path: Path) -> None:
    path = tmp_path / "table.csv"
    TABLE.to_csv(path)
    assert path.read_text() == "viscosity,particles,error\nmorris,20,5.004e-05\n[bold]gotoh,400,\n"


@given(st.lists(st.tuples(st.text("a,\"\n'é", min_size=1), st.floats(allow_nan=False))))
def test_a_csv_file_gives_back_what_was_written(rows: list[tuple[str, float]]) -> None:
    columns = (Column("name", "name"), Column("value", "value", ".1e"))
    with TemporaryDirectory() as folder:
        path = Path(folder, "table.csv")
        Table("", columns, [{"name": name, "value": value} for name, value in rows]).to_csv(path)
        with path.open(encoding="utf-8", newline="") as file:
            read = [(row["name"], float(row["value"])) for row in csv.DictReader(file)]
    assert read == rows


def test_a_table_does_not_change() -> None:
    with pytest.raises(FrozenInstanceError):
        TABLE.title = "another"  # type: ignore[misc]


def wide(columns: int, rows: int = 2) -> Table:
    names = [f"quantity {k}" for k in range(columns)]
    values = [{name: 1234.5 + 1e-3 * k + row for k, name in enumerate(names)} for row in range(rows)]
    return Table("many", tuple(Column(name, f"a long name of {name}", ".8g") for name in names), values)


@pytest.mark.parametrize("width", [24, 40, 80, 120])
@pytest.mark.parametrize("columns", [1, 2, 7, 14])
def test_no_number_is_broken_and_no_line_is_too_long(columns: int, width: int) -> None:
    table = wide(columns)
    text = shown(table, width)
    assert max(map(len, text.splitlines())) <= width
    for row in table.rows:
        for column in table.columns:
            if column.key != "quantity 0" or columns == 1:
                assert text.split().count(column.text(row[column.key])) == 1


def test_each_block_has_the_first_column() -> None:
    text = shown(wide(14), 60)
    blocks = text.count("1234.5 ")
    assert blocks > 1
    assert text.count("many") == 1
    assert shown(wide(14), 1000).count("1234.5 ") == 1


@pytest.mark.parametrize(
    ("widths", "room", "blocks"),
    [
        ([3, 3, 3], 19, [[0, 1, 2]]),
        ([3, 3, 3], 18, [[0, 1], [0, 2]]),
        ([3], 2, [[0]]),
        ([9, 9], 5, [[0, 1]]),
        ([], 80, []),
    ],
)
def test_columns_are_packed(widths: list[int], room: int, blocks: list[list[int]]) -> None:
    assert packed(widths, room) == blocks
