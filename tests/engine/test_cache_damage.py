"""Files of the code cache that are damaged, replaced or another's: never believed, never in the way, mended."""

from __future__ import annotations

import os
import pickle
import random
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from sphear.engine.cache.files import sealed
from tests.engine.cached import TEXT, Cache, cache

__all__ = ["cache"]

posix = pytest.mark.skipif(os.name != "posix", reason="links, pipes and owners are those of Unix")
root = pytest.mark.skipif(os.name != "posix" or os.geteuid() != 0, reason="only root can give a file away")


def content(change: Callable[[bytes], bytes]) -> Callable[[Path], None]:
    def damage(path: Path) -> None:
        path.write_bytes(change(path.read_bytes()))

    return damage


def one_byte(place: float) -> Callable[[bytes], bytes]:
    def change(found: bytes) -> bytes:
        k = int(place * (len(found) - 1))
        return found[:k] + bytes([found[k] ^ 1]) + found[k + 1 :]

    return change


def replaced(make: Callable[[Path], object]) -> Callable[[Path], None]:
    def damage(path: Path) -> None:
        path.unlink()
        make(path)

    return damage


def moved_behind_a_link(path: Path) -> None:
    elsewhere = path.parent.parent / "elsewhere"
    path.rename(elsewhere)
    path.symlink_to(elsewhere)


def too_large(path: Path) -> None:
    os.truncate(path, 1 << 40)


def given_away(path: Path) -> None:
    os.chown(path, 54321, 54321)


DAMAGE: dict[str, Callable[[Path], None]] = {
    "empty": content(lambda found: b""),
    "half": content(lambda found: found[: len(found) // 2]),
    "all but the last byte": content(lambda found: found[:-1]),
    "garbled": content(lambda found: random.Random(1).randbytes(len(found))),
    "zeros": content(lambda found: bytes(len(found))),
    "first byte": content(one_byte(0.0)),
    "byte of the head": content(lambda found: found[:25] + bytes([found[25] ^ 1]) + found[26:]),
    "byte in the middle": content(one_byte(0.5)),
    "last byte": content(one_byte(1.0)),
    "appended": content(lambda found: found + b"\nraise SystemExit\n"),
    "twice": content(lambda found: found + found),
    "another encoding": content(lambda found: b"\xff\xfe" + found),
    "a text": content(lambda found: b"nothing of the kind"),
    "gone": Path.unlink,
    "folder": replaced(Path.mkdir),
}
ON_UNIX: dict[str, Callable[[Path], None]] = {
    "link to itself": replaced(lambda path: path.symlink_to(path)),
    "link to nothing": replaced(lambda path: path.symlink_to(path.parent / "nothing")),
    "link to the file": moved_behind_a_link,
    "pipe": replaced(lambda path: os.mkfifo(path)),
    "too large": too_large,
    "writable by the group": lambda path: path.chmod(0o620),
    "writable by all": lambda path: path.chmod(0o602),
}  # fmt: skip
EVERY = [
    *(pytest.param(damage, id=name) for name, damage in DAMAGE.items()),
    *(pytest.param(damage, id=name, marks=posix) for name, damage in ON_UNIX.items()),
    pytest.param(given_away, id="another user's", marks=root),
]


@pytest.mark.parametrize("damage", EVERY)
def test_machine_code_is_compiled_again_and_kept_again(damage: Callable[[Path], None], cache: Cache) -> None:
    assert not cache.found()
    damage(cache.file(".code"))
    assert not cache.found()
    assert cache.found()
    assert cache.file(".code").is_file()
    assert not cache.warnings


@pytest.mark.parametrize("damage", EVERY)
def test_a_text_is_written_again_and_machine_code_found_all_the_same(
    damage: Callable[[Path], None], cache: Cache
) -> None:
    cache.found()
    whole = cache.file(".py").read_bytes()
    damage(cache.file(".py"))
    assert cache.found()
    assert cache.file(".py").read_bytes() == whole
    assert len(cache.names()) == 2


@posix
def test_a_folder_full_of_something_in_place_of_a_file_is_left_alone_and_said(cache: Cache) -> None:
    cache.found()
    path = cache.file(".code")
    path.unlink()
    path.mkdir()
    (path / "mine").touch()
    assert not cache.found()
    assert (path / "mine").exists()
    (said,) = cache.warnings
    assert said.startswith(f"compiled code cannot be kept in {cache.folder} (")


class Hostile:
    """What unpickling runs."""

    def __init__(self, marker: Path) -> None:
        self.marker = marker

    def __reduce__(self) -> tuple[object, ...]:
        return Path.touch, (self.marker,)


def test_a_pickle_without_the_seal_of_its_function_is_not_run(cache: Cache, tmp_path: Path) -> None:
    cache.found()
    hostile = pickle.dumps(Hostile(tmp_path / "marker"))
    for forged in (hostile, sealed("of another function", hostile)):
        cache.file(".code").write_bytes(forged)
        assert not cache.found()
    assert not (tmp_path / "marker").exists()


def test_text_that_was_put_into_a_file_is_not_run(cache: Cache, tmp_path: Path) -> None:
    cache.found()
    with cache.file(".py").open("a", encoding="utf-8") as file:
        file.write(f"\nopen({str(tmp_path / 'marker')!r}, 'w')\n")
    cache.found()
    assert not (tmp_path / "marker").exists()


def test_machine_code_of_another_function_is_not_taken_for_this_one(cache: Cache) -> None:
    cache.found()
    mine = cache.file(".code")
    other = TEXT.replace("2 * x", "x + x")
    cache.found(other)
    (theirs,) = set(cache.folder.glob("*.code")) - {mine}
    shutil.copy(theirs, mine)
    assert not cache.found()
    assert cache.found(other)
