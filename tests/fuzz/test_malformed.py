"""A few malformed command lines and calls of each kind; `validation/malformed.py` has 1,500 of them."""

from __future__ import annotations

from pathlib import Path

import pytest

from sphear.errors import SphearError

from .calls import MAKERS as KINDS_OF_CALLS
from .calls import Call, calls
from .commands import MAKERS as KINDS_OF_COMMANDS
from .commands import Command, commands
from .judged import LONGEST, fault_of_call, fault_of_command, in_folder

SEED, EACH = 5, 4


@pytest.mark.parametrize("kind", KINDS_OF_COMMANDS)
def test_a_malformed_command_line_is_answered_by_one_sentence(kind: str, tmp_path: Path) -> None:
    with in_folder(tmp_path):
        drawn = [each for each in commands(EACH * len(KINDS_OF_COMMANDS), SEED) if each.kind == kind]
        faults = {str(each.arguments)[:200]: fault_of_command(each) for each in drawn}
    assert len(drawn) == EACH
    assert {words: fault for words, fault in faults.items() if fault} == {}


@pytest.mark.parametrize("kind", KINDS_OF_CALLS)
def test_a_malformed_call_is_answered_by_one_sentence(kind: str, tmp_path: Path) -> None:
    drawn = [each for each in calls(EACH * len(KINDS_OF_CALLS), SEED, tmp_path) if each.kind == kind]
    faults = {each.words: fault_of_call(each) for each in drawn}
    assert len(drawn) == EACH
    assert {words: fault for words, fault in faults.items() if fault} == {}


def test_the_same_seed_draws_the_same(tmp_path: Path) -> None:
    number = 10 * len(KINDS_OF_COMMANDS)
    assert list(commands(number, 3)) == list(commands(number, 3)) != list(commands(number, 4))
    assert [each.words for each in calls(99, 3, tmp_path)] == [each.words for each in calls(99, 3, tmp_path)]


def test_what_is_right_or_answered_otherwise_is_a_fault(tmp_path: Path) -> None:
    """The judge can find for the other side."""

    def silent() -> None: ...

    def long() -> None:
        raise SphearError("x" * (LONGEST + 1))

    def lines() -> None:
        raise SphearError("one\ntwo")

    def other() -> None:
        raise ZeroDivisionError("by zero")

    found = [fault_of_call(Call("", "", make)) for make in (silent, long, lines, other)]
    assert found == ["no error", f"{LONGEST + 1} letters: {'x' * 100}", "not one line: 'one\\ntwo'",
                     "ZeroDivisionError: by zero"]  # fmt: skip
    with in_folder(tmp_path):
        assert fault_of_command(Command("", ["list", "kernels"])) == "status 0: "
        assert fault_of_command(Command("", ["list", "kernls"])) is None
