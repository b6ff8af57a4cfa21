"""`sphear patch-test` and `sphear reproduce`: what they print and what they write."""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from sphear.cases.patch_test import PatchTest
from sphear.cli.output import print_json
from sphear.references.zheng2018 import SIZES, TABLE_1

Run = Callable[..., Any]

SMALL = ("patch-test", "--sizes", "12,20")
SIGNATURES = {".png": b"\x89PNG\r\n\x1a\n", ".svg": b"<?xml", ".json": b"{", ".csv": b""}


def test_patch_test_prints_its_settings_and_rows_as_json(sphear: Run) -> None:
    found = sphear(*SMALL, "-v", "morris", "-v", "oger", "--json").json()
    test = PatchTest(viscosity=("morris", "oger"), sizes=(12, 20))
    assert list(found) == ["case", "settings", "versions", "rows"]
    assert (found["case"], found["settings"]) == ("patch-test", test.model_dump(mode="json"))
    assert found["rows"] == test.rows()


def test_a_row_has_size_errors_and_order(sphear: Run) -> None:
    first, *_ = sphear(*SMALL, "--json").json()["rows"]
    assert list(first) == ["viscosity", "particles", "dx", "l1", "l2", "max", "paper", "order"]


@pytest.mark.parametrize(
    ("options", "setting", "value"),
    [
        (["--kernel", "wendland_c2"], "kernel", "wendland_c2"),
        (["--h-over-dx", "1.2"], "h_over_dx", 1.2),
        (["--correction", "shepard"], "correction", "shepard"),
        (["--jitter", "0.25"], "jitter", 0.25),
        (["--field", "x**2"], "field", "x**2"),
        (["--dim", "3"], "dimension", 3),
        (["--velocity"], "velocity", True),
        (["--seed", "4"], "seed", 4),
        (["--seeds", "2"], "seeds", 2),
        (["--edges", "truncated"], "edges", "truncated"),
        (["--samples", "all"], "samples", "all"),
        (["--fallback", "nan"], "fallback", "nan"),
        (["--precision", "float32"], "precision", "float32"),
        (["--threads", "1"], "threads", 1),
        (["--sizes", "10, 11"], "sizes", [10, 11]),
        (["-v", "E"], "viscosity", ["E"]),
    ],
)
def test_an_option_sets_what_it_says_and_nothing_else(
    options: list[str], setting: str, value: object, sphear: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(PatchTest, "rows", lambda self, progress: [])
    changed = sphear("patch-test", *options, "--json").json()["settings"]
    assert changed == PatchTest().model_dump(mode="json") | {setting: value}


def test_the_table_of_the_patch_test(sphear: Run) -> None:
    found = sphear(*SMALL)
    assert (found.status, found.err) == (0, "")
    (row, _) = PatchTest(sizes=(12, 20)).rows()
    assert found.out.startswith("Patch test, quartic, 2-D, cubic_spline, lattice, edges continued")
    assert f"{row['l1']:.2e}".replace("e-0", "e-") in found.out


def test_numbers_that_json_does_not_know_are_null(capsys: pytest.CaptureFixture[str]) -> None:
    print_json({"a": math.nan, "b": [math.inf, 1.5], "c": {"d": (-math.inf,)}})
    assert json.loads(capsys.readouterr().out) == {"a": None, "b": [None, 1.5], "c": {"d": [None]}}


def test_what_does_not_exist_is_null_in_json(sphear: Run) -> None:
    rows = sphear("patch-test", "--sizes", "12", "--field", "3", "--json").json()["rows"]
    assert (rows[0]["l1"], rows[0]["order"]) == (0, None)


@pytest.mark.parametrize("as_json", [False, True])
def test_patch_test_writes_figure_table_and_numbers(as_json: bool, sphear: Run, tmp_path: Path) -> None:
    found = sphear(*SMALL, "--out", "a/b", *(["--json"] if as_json else []))
    assert (found.status, found.err) == (0, "")
    files = sorted((tmp_path / "a" / "b").iterdir())
    assert [path.name for path in files] == [f"patch-test{suffix}" for suffix in (".csv", ".json", ".png", ".svg")]
    assert all(path.read_bytes().startswith(SIGNATURES[path.suffix]) for path in files)
    assert min(path.stat().st_size for path in files) > 100


def test_the_json_file_is_what_json_prints(sphear: Run, tmp_path: Path) -> None:
    printed = sphear(*SMALL, "--json", "--out", "results").json()
    assert json.loads((tmp_path / "results" / "patch-test.json").read_text(encoding="utf-8")) == printed


def test_the_csv_file_has_the_rows(sphear: Run, tmp_path: Path) -> None:
    rows = sphear(*SMALL, "--json", "--out", "results").json()["rows"]
    with (tmp_path / "results" / "patch-test.csv").open(encoding="utf-8", newline="") as file:
        written = list(csv.DictReader(file))
    assert [(one["viscosity"], int(one["particles"]), float(one["l1"])) for one in written] == [
        (row["viscosity"], row["particles"], row["l1"]) for row in rows
    ]


def test_the_files_are_named_on_stdout(sphear: Run) -> None:
    last = sphear(*SMALL, "--out", "results").out.splitlines()[-1]
    assert last == "written: " + ", ".join(f"results/patch-test.{suffix}" for suffix in ("json", "csv", "png", "svg"))


def test_an_error_of_zero_can_be_drawn(sphear: Run, tmp_path: Path) -> None:
    assert sphear(*SMALL, "--field", "3", "--out", "results").status == 0
    assert (tmp_path / "results" / "patch-test.svg").exists()


def test_table_1_as_json(sphear: Run) -> None:
    found = sphear("reproduce", "zheng2018", "table-1", "--json").json()
    assert list(found) == ["study", "item", "versions", "rows", "other_readings", "claim", "finding", "agrees"]
    assert (found["study"], found["item"]) == ("zheng2018", "table-1")
    assert [(row["viscosity"], row["particles"], row["published"]) for row in found["rows"]] == [
        (name, size, value) for name, values in TABLE_1.items() for size, value in zip(SIZES, values, strict=True)
    ]


def test_a_row_of_table_1_as_json(sphear: Run) -> None:
    row = sphear("reproduce", "zheng2018", "table-1", "--json").json()["rows"][0]
    assert row == {
        "particles": 20,
        "viscosity": "morris",
        "published": 5.00e-5,
        "computed": pytest.approx(5.00e-5, rel=1e-3),
        "l1_relative": pytest.approx(5.00e-5 * 17**2, rel=1e-3),
        "order": None,
    }


def test_several_items_are_a_list_in_the_order_asked_for(sphear: Run) -> None:
    found = sphear("reproduce", "zheng2018", "figure-2", "table-1", "figure-2", "--json").json()
    assert [one["item"] for one in found] == ["figure-2", "table-1"]


def test_one_item_is_one_object(sphear: Run) -> None:
    assert sphear("reproduce", "basa2009", "figure-1", "--json").json()["item"] == "figure-1"


def test_a_paper_is_reproduced_whole_by_default(sphear: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    from sphear import studies

    quick = studies.reproduce("basa2009", "figure-1", quick=True)
    monkeypatch.setattr(studies, "reproduce", lambda *_, **__: quick)
    found = sphear("reproduce", "zheng2018", "--json").json()
    assert [one["item"] for one in found] == list(studies.ITEMS["zheng2018"])


@pytest.mark.parametrize(("options", "quick"), [([], False), (["--quick"], True)])
def test_quick_is_handed_on(options: list[str], quick: bool, sphear: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    from sphear import studies

    asked, reproduce = [], studies.reproduce

    def recorded(paper: str, item: str, *, quick: bool, **others: Any) -> Any:
        asked.append(quick)
        return reproduce(paper, item, quick=quick, **others)

    monkeypatch.setattr(studies, "reproduce", recorded)
    sphear("reproduce", "basa2009", "figure-1", *options)
    assert asked == [quick]


def test_the_text_of_a_reproduction_says_claim_finding_and_agreement(sphear: Run) -> None:
    text, facts = (sphear("reproduce", "zheng2018", "table-1", *more) for more in ([], ["--json"]))
    assert (text.status, text.err) == (0, "")
    assert f"The paper: {facts.json()['claim']}." in text.out
    assert f"Found: {facts.json()['finding']}." in text.out
    assert f"Agrees: {facts.json()['agrees']}." in text.out


def test_reproduce_writes_figures_tables_and_numbers_of_all_items(sphear: Run, tmp_path: Path) -> None:
    assert sphear("reproduce", "zheng2018", "table-1", "figure-3", "--out", "results").status == 0
    names = sorted(path.name for path in (tmp_path / "results").iterdir())
    figure = [f"zheng2018-figure-3.{suffix}" for suffix in ("csv", "json", "png", "svg")]
    assert names == sorted([*figure, "zheng2018-table-1.csv", "zheng2018-table-1.json"])


def test_a_written_item_is_what_json_prints(sphear: Run, tmp_path: Path) -> None:
    printed = sphear("reproduce", "basa2009", "figure-1", "--json", "--out", "results").json()
    assert json.loads((tmp_path / "results" / "basa2009-figure-1.json").read_text(encoding="utf-8")) == printed
