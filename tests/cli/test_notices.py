"""What the command line says of compiling and of its cache, and what it makes of a file that ends too early."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from sphear.cli import main
from sphear.cli.notices import say_notices
from sphear.engine.notices import notices


@pytest.fixture(autouse=True)
def listeners() -> Iterator[None]:
    yield
    notices.listen()


def test_the_library_prints_nothing_of_compiling(capfd: pytest.CaptureFixture[str]) -> None:
    notices.listen()
    notices.compiling(Path("folder"))
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize(
    ("folder", "line"),
    [
        (Path("folder"), "sphear: compiling (once; kept in folder)\n"),
        (None, "sphear: compiling, in this process alone\n"),
    ],
)
def test_that_code_is_compiled_is_said_once(folder: Path | None, line: str, capfd: pytest.CaptureFixture[str]) -> None:
    say_notices(as_json=False)
    notices.compiling(folder)
    notices.compiling(folder)
    assert capfd.readouterr() == ("", line)


def test_programs_are_told_what_is_wrong_only(capfd: pytest.CaptureFixture[str]) -> None:
    say_notices(as_json=True)
    notices.compiling(Path("folder"))
    notices.warn("others may write to it")
    notices.warn("others may write to it")
    assert capfd.readouterr() == ("", "sphear: warning: others may write to it\n")


def test_someone_at_a_terminal_is_told_with_json_too(
    monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    say_notices(as_json=True)
    notices.compiling(Path("folder"))
    assert capfd.readouterr().err == "sphear: compiling (once; kept in folder)\n"


def test_a_file_that_ends_too_early_is_no_ctrl_c(sphear: Callable[..., Any], monkeypatch: pytest.MonkeyPatch) -> None:
    def ended(*_: object, **__: object) -> None:
        raise EOFError("Ran out of input")

    monkeypatch.setattr("sphear.cases.patch_test.PatchTest.rows", ended)
    monkeypatch.setattr(sys, "argv", ["sphear", "patch-test"])
    with pytest.raises(EOFError, match="Ran out of input"):
        main()
