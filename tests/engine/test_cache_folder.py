"""The folder of the code cache: private, whose it must be, and what is done where there can be none."""

from __future__ import annotations

import errno
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from sphear.engine.cache import cache_directory, files
from sphear.errors import SphearError
from sphear.studies.kept import runs_folder
from tests.engine.cached import TEXT, Cache, cache

__all__ = ["cache"]

posix = pytest.mark.skipif(os.name != "posix", reason="owners and modes are those of Unix")
root = pytest.mark.skipif(os.name != "posix" or os.geteuid() != 0, reason="only root can give a folder away")


@pytest.fixture
def temporary(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder for temporary files."""
    (tmp_path / "temporary").mkdir(mode=0o700)
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "temporary"))
    return tmp_path / "temporary"


def instead(temporary: Path) -> Path:
    return temporary / f"sphear-{os.geteuid()}"


@posix
@pytest.mark.parametrize("umask", [0o000, 0o002, 0o022, 0o077])
def test_all_is_for_the_user_alone_at_any_umask(umask: int, cache: Cache) -> None:
    before = os.umask(umask)
    try:
        cache.found()
    finally:
        os.umask(before)
    assert cache.folder.stat().st_mode & 0o777 == 0o700
    assert {path.stat().st_mode & 0o777 for path in cache.folder.iterdir()} == {0o600}


@posix
@pytest.mark.parametrize("mode", [0o777, 0o775, 0o702])
def test_a_folder_that_others_may_write_is_not_used(mode: int, cache: Cache, temporary: Path) -> None:
    cache.folder.mkdir()
    cache.folder.chmod(mode)
    assert not cache.found()
    assert cache.found()
    assert not list(cache.folder.iterdir())
    reason = "because others may write to it"
    assert cache.warnings == [
        f"compiled code is not kept in {cache.folder}, {reason}; it is kept in {instead(temporary)}"
    ]


@root
def test_a_folder_of_another_user_is_not_used(cache: Cache, temporary: Path) -> None:
    cache.folder.mkdir(mode=0o755)
    os.chown(cache.folder, 54321, 54321)
    assert cache_directory() == instead(temporary)
    assert "because it belongs to another user; it is kept in" in cache.warnings[0]


def wrong_name(folder: Path) -> None:
    folder.write_text("a file, not a folder", encoding="utf-8")


def loop_of_links(folder: Path) -> None:
    folder.symlink_to(folder)


@posix
@pytest.mark.parametrize("make", [wrong_name, loop_of_links])
def test_one_folder_a_user_serves_instead_and_not_one_a_process(
    make: Callable[[Path], None], cache: Cache, temporary: Path
) -> None:
    make(cache.folder)
    assert not cache.found()
    assert cache.found()
    assert [path.name for path in temporary.iterdir()] == [instead(temporary).name]
    assert instead(temporary).stat().st_mode & 0o777 == 0o700
    assert len(cache.warnings) == 1


@posix
def test_a_link_that_another_put_under_the_name_of_that_folder_is_not_followed(cache: Cache, temporary: Path) -> None:
    wrong_name(cache.folder)
    (temporary / "elsewhere").mkdir()
    instead(temporary).symlink_to(temporary / "elsewhere")
    assert cache_directory() is None
    assert not cache.found()
    assert not list((temporary / "elsewhere").iterdir())


@posix
def test_neither_home_nor_account(cache: Cache, temporary: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("SPHEAR_CACHE_DIR", "XDG_CACHE_HOME", "LOCALAPPDATA"):
        monkeypatch.delenv(name, raising=False)

    def no_home() -> Path:
        raise RuntimeError("Could not determine home directory.")

    monkeypatch.setattr(Path, "home", no_home)
    assert cache_directory() == instead(temporary)
    assert not cache.warnings


def nowhere(monkeypatch: pytest.MonkeyPatch) -> None:
    def no_folder() -> str:
        raise FileNotFoundError(errno.ENOENT, "No usable temporary directory found")

    monkeypatch.setattr(tempfile, "gettempdir", no_folder)


def test_without_any_folder_code_is_compiled_in_memory(cache: Cache, monkeypatch: pytest.MonkeyPatch) -> None:
    wrong_name(cache.folder)
    nowhere(monkeypatch)
    assert not cache.found()
    assert not cache.found()
    assert cache.compilings == [None]
    (said,) = cache.warnings
    assert said.startswith(f"compiled code is not kept in {cache.folder}, because there is no such folder (")
    assert said.endswith("; each process compiles its own")


def test_without_any_folder_runs_of_studies_are_refused(cache: Cache, monkeypatch: pytest.MonkeyPatch) -> None:
    wrong_name(cache.folder)
    nowhere(monkeypatch)
    monkeypatch.delenv("SPHEAR_RUNS_DIR", raising=False)
    with pytest.raises(SphearError, match="there is no folder to keep runs in: name one in SPHEAR_RUNS_DIR"):
        runs_folder("zheng2018")


@pytest.mark.parametrize("where", ["write", "sync", "rename"])
def test_a_full_disk_is_said_once_and_nothing_is_left(
    where: str, cache: Cache, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object, **__: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    name = {"write": "tempfile.mkstemp", "sync": "os.fsync", "rename": "pathlib.Path.replace"}[where]
    with monkeypatch.context() as patched:
        patched.setattr(name, full)
        assert not cache.found()
        assert not cache.found()
    assert cache.names() == []
    assert cache.warnings == [
        f"compiled code cannot be kept in {cache.folder} (No space left on device): what is missing there is compiled"
        " by each process"
    ]
    assert not cache.found()
    assert cache.found()


LIMITED = """
import os, resource, sys
from pathlib import Path
from sphear.engine.cache import generated_module
from sphear.engine.notices import notices
notices.listen(on_warning=print)
for limit in (0, 100, 5000):
    os.environ["SPHEAR_CACHE_DIR"] = f"{sys.argv[1]}/{limit}"
    resource.setrlimit(resource.RLIMIT_FSIZE, (limit, resource.RLIM_INFINITY))
    print(generated_module.__wrapped__(sys.argv[2]).double(21), len(list(Path(sys.argv[1], str(limit)).iterdir())))
"""


@posix
def test_files_that_may_not_grow(tmp_path: Path) -> None:
    command = [sys.executable, "-c", LIMITED, str(tmp_path), TEXT]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    # the text is 150 bytes long, the machine code some 10,000
    assert [line for line in lines if line.startswith("42")] == ["42 0", "42 0", "42 1"]
    assert [line.partition(" (")[0] for line in lines if not line.startswith("42")] == [
        f"compiled code cannot be kept in {tmp_path / str(limit)}" for limit in (0, 100, 5000)
    ]


def test_processes_that_compile_the_same_at_once_are_all_right(cache: Cache) -> None:
    code = "import sys; from sphear.engine.cache import generated_module as m; print(m(sys.argv[1]).double(21))"
    command = [sys.executable, "-c", code, TEXT]
    both = [subprocess.Popen(command, stdout=subprocess.PIPE, text=True) for _ in range(2)]
    assert [process.communicate()[0] for process in both] == ["42\n", "42\n"]
    assert sorted(path.suffix for path in cache.folder.iterdir()) == [".code", ".py"]
    assert cache.found()


def test_what_killed_processes_left_is_removed_after_an_hour(cache: Cache) -> None:
    cache.folder.mkdir(mode=0o700)
    for name, age in (("old.tmp", 2 * files.STALE), ("new.tmp", 0.0), ("old.txt", 2 * files.STALE)):
        (cache.folder / name).touch()
        os.utime(cache.folder / name, (time.time() - age,) * 2)
    cache.found()
    assert [name for name in cache.names() if name.partition(".")[0] in ("old", "new")] == ["new.tmp", "old.txt"]


def test_compiling_is_told_once_and_loading_is_not(cache: Cache) -> None:
    cache.found()
    cache.found("\n" + cache.file(".py").read_text(encoding="utf-8"))
    assert cache.compilings == [cache.folder]
    cache.compilings.clear()
    cache.found()
    assert not cache.compilings
