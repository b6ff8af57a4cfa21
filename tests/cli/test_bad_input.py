"""A user's mistake is exit status 2 and one sentence on stderr, with nothing on stdout and no file."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import sphear.cases.patch_test as case

Run = Callable[..., Any]

GENERAL = {
    "lits": "no such command 'lits'. Did you mean 'list'?",
    "--nonsense": "no such option: --nonsense",
    "list kernls": "no kind named 'kernls': did you mean kernels",
    "list kernels extra": "unexpected extra argument",
    "list --jsn": "no such option: --jsn",
    "show": "missing argument 'KIND'",
    "show viscosity": "show needs a name after viscosity",
    "show colour red": "no kind named 'colour'",
    "show viscosity moris": "no viscosity named 'moris': did you mean morris",
    "show kernel cubik_spline": "no kernel named 'cubik_spline': did you mean cubic_spline",
    "show correction shepherd": "no correction named 'shepherd': did you mean shepard",
    "show study zheng2081": "no paper named 'zheng2081': did you mean zheng2018",
    "show study zheng2018 table-4": "no item of zheng2018 named 'table-4': did you mean table-",
    "show case patchtest": "no case named 'patchtest': did you mean patch-test",
    "reproduce": "missing argument 'PAPER'",
    "reproduce zhen2018": "no paper named 'zhen2018': did you mean zheng2018",
    "reproduce zheng2018 tabel-1": "no item of zheng2018 named 'tabel-1': did you mean table-1",
    "reproduce zheng2018 table-1 figure-19": "no item of zheng2018 named 'figure-19'",
    "reproduce basa2009 table-1": "no item of basa2009 named 'table-1'",
    "reproduce basa2009 --out": "requires an argument",
}
PATCH_TEST: dict[str, tuple[list[str], str]] = {
    "unknown term": (["-v", "moris"], "no viscosity named 'moris': did you mean morris"),
    "one unknown term of two": (["-v", "morris", "-v", "olger"], "no viscosity named 'olger': did you mean oger"),
    "unknown kernel": (["--kernel", "wendland_c3"], "no kernel named 'wendland_c3': did you mean wendland_c"),
    "unknown correction": (["--correction", "level_2"], "no correction named 'level_2': did you mean level_"),
    "unknown field": (["--field", "quartik"], "did you mean quartic?"),
    "unknown edges": (["--edges", "open"], "edges should be 'continued' or 'truncated', not 'open'"),
    "unknown samples": (["--samples", "none"], "samples should be 'interior' or 'all', not 'none'"),
    "unknown fallback": (["--fallback", "zero"], "fallback should be 'uncorrected' or 'nan', not 'zero'"),
    "unknown precision": (["--precision", "half"], "precision should be 'float64' or 'float32', not 'half'"),
    "unknown option": (["--jiter", "0.1"], "no such option: --jiter"),
    "option without its value": (["--jitter"], "'--jitter' requires an argument"),
    "extra argument": (["morris"], "unexpected extra argument"),
    "no number": (["--jitter", "some"], "invalid value for '--jitter'"),
    "no whole number": (["--seeds", "1.5"], "invalid value for '--seeds'"),
    "sizes are words": (["--sizes", "few,many"], "whole numbers separated by commas, such as 20,40, not 'few,many'"),
    "a size is missing": (["--sizes", "20,,40"], "whole numbers separated by commas"),
    "no sizes": (["--sizes", ""], "whole numbers separated by commas"),
    "a size is zero": (["--sizes", "0"], "sizes must be positive, not 0"),
    "a size is negative": (["--sizes", "20,-40"], "sizes must be positive, not -40"),
    "a size without samples": (["--sizes", "7"], "size 7 is too small: no particle has its support of 4 spacings"),
    "a size beyond reason": (["--sizes", "1" + 40 * "0"], "sizes should be less than or equal to 1000000"),
    "more particles than can be counted": (["--sizes", "100000"], "100000 intervals a side"),
    "jitter too large": (["--jitter", "1.01"], "jitter should be less than or equal to 1, not 1.01"),
    "jitter negative": (["--jitter", "-0.1"], "jitter should be greater than or equal to 0, not -0.1"),
    "jitter is no number": (["--jitter", "nan"], "jitter should be"),
    "h is zero": (["--h-over-dx", "0"], "h-over-dx should be greater than"),
    "h is negative": (["--h-over-dx", "-1.5"], "h-over-dx should be greater than"),
    "h is no number": (["--h-over-dx", "nan"], "h-over-dx should be"),
    "h is infinite": (["--h-over-dx", "inf"], "h-over-dx should be"),
    "one dimension": (["--dim", "1"], "dimension should be 2 or 3, not 1"),
    "negative seed": (["--seed", "-1"], "seed should be greater than or equal to 0, not -1"),
    "no seeds": (["--seeds", "0"], "seeds should be greater than or equal to 1, not 0"),
    "no threads": (["--threads", "0"], "threads should be greater than or equal to 1, not 0"),
    "expression with a slip": (["--field", "sin(x"], "in the expression 'sin(x', something is wrong at character 4"),
    "expression with an unknown function": (["--field", "sinus(x)"], "not understood (did you mean sin?)"),
    "expression with code": (["--field", "__import__('os')"], "is not understood"),
    "expression with a missing axis": (["--field", "x*z"], "not so many dimensions"),
    "expression that is empty": (["--field", ""], "there is nothing to read"),
    "expression over lines": (["--field", "x +\ny + @"], "is not understood"),
    "undefined value": (["--field", "sqrt(x)"], "sqrt(x) has no finite real value at x = -0.45, y = -0.45"),
    "undefined derivative": (["--field", "sqrt(x)", "--edges", "truncated", "--samples", "all"], "at x = 0, y = 0"),
    "field too large": (["--field", "1e307*x**4"], "too large for float64"),
    "too few neighbours": (
        ["-v", "least_squares", "--h-over-dx", "0.55"],
        "289 of 289 particles have too few neighbours for viscosity 'least_squares', the first at (0.1, 0.1): take a"
        " larger h_over_dx, or ask for fallback 'uncorrected' or 'nan'",
    ),
    "too few neighbours for a correction": (
        ["--correction", "bonet_lok", "--h-over-dx", "0.4"],
        "361 of 361 particles have too few neighbours for correction 'bonet_lok', the first at (0.05, 0.05): take a",
    ),
    "correction beside a term's own": (
        ["-v", "oger", "--correction", "shepard"],
        "viscosity 'oger' carries its own correction and takes no other",
    ),
    "radial term without velocity": (["-v", "violeau"], "(--velocity)"),
}  # fmt: skip


def refused(outcome: Any, sentence: str) -> None:
    """All that is promised of a refusal."""
    assert sentence in outcome.err
    assert outcome.err.startswith("sphear: ")
    assert outcome.err.count("\n") == 1
    assert outcome.err.endswith("\n")
    assert (outcome.status, outcome.out) == (2, "")
    assert list(Path.cwd().iterdir()) == []


@pytest.mark.parametrize("arguments", GENERAL)
def test_wrong_words(arguments: str, sphear: Run) -> None:
    refused(sphear(*arguments.split()), GENERAL[arguments])


@pytest.mark.parametrize("as_json", [False, True])
@pytest.mark.parametrize("mistake", PATCH_TEST)
def test_wrong_patch_test(mistake: str, as_json: bool, sphear: Run) -> None:
    options, sentence = PATCH_TEST[mistake]
    refused(sphear("patch-test", "--out", "results", *(["--json"] if as_json else []), *options), sentence)


@pytest.mark.parametrize("command", ["patch-test", "reproduce basa2009"])
@pytest.mark.parametrize("folder", ["", "  "])
def test_an_output_folder_without_a_name(command: str, folder: str, sphear: Run) -> None:
    refused(sphear(*command.split(), "--out", folder), "the output folder needs a name")


@pytest.mark.parametrize("command", ["patch-test", "reproduce basa2009"])
@pytest.mark.parametrize("below", ["", "/results"])
def test_an_output_folder_that_is_a_file(
    command: str, below: str, sphear: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "taken").write_text("mine")
    (tmp_path / "empty").mkdir()
    monkeypatch.chdir(tmp_path / "empty")
    refused(sphear(*command.split(), "--out", f"../taken{below}"), "taken is a file")
    assert (tmp_path / "taken").read_text() == "mine"


@pytest.mark.parametrize("command", ["patch-test --sizes 12", "reproduce basa2009"])
def test_an_output_folder_that_cannot_be_written(command: str, sphear: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    access = os.access
    monkeypatch.setattr(os, "access", lambda path, mode: access(path, mode) and not mode & os.W_OK)
    refused(sphear(*command.split(), "--out", "results"), "is not writable")


def test_a_folder_is_refused_before_anything_is_computed(
    sphear: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "taken").touch()
    (tmp_path / "empty").mkdir()
    monkeypatch.chdir(tmp_path / "empty")
    refused(sphear("patch-test", "--sizes", "1000", "--dim", "3", "--out", "../taken"), "is a file")


def test_where_memory_does_not_suffice(sphear: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object, **__: object) -> None:
        raise MemoryError

    monkeypatch.setattr(case, "lattice", full)
    outcome = sphear("patch-test")
    assert (outcome.status, outcome.out) == (1, "")
    assert outcome.err == "sphear: there is not enough memory for this\n"


def test_no_mistake_leaves_a_traceback_behind(sphear: Run) -> None:
    assert "Traceback" not in sphear("patch-test", "--field", "1/0").err
    assert sys.exc_info() == (None, None, None)
