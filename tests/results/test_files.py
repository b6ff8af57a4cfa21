import os
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sphear.errors import SphearError
from sphear.results import Column, OutputFolder, Table


def test_a_folder_is_made_with_its_first_file(tmp_path: Path) -> None:
    folder = OutputFolder(tmp_path / "study" / "run")
    assert not folder.path.parent.exists()
    folder.write_text("summary.txt", "ξ = 4\n")
    assert (folder.path / "summary.txt").read_text(encoding="utf-8") == "ξ = 4\n"


def test_a_folder_knows_its_files(tmp_path: Path) -> None:
    from sphear.results.figure import loglog_convergence

    folder = OutputFolder(tmp_path)
    folder.write_text("a.txt", "a")
    folder.write_table("b", Table("b", (Column("x", "x"),), [{"x": 1.5}]))
    folder.write_figure("c", loglog_convergence({"morris": ([1, 2], [3, 4])}, "x", "y", "c"))
    assert folder.files == [tmp_path / name for name in ("a.txt", "b.csv", "c.png", "c.svg")]
    assert sorted(folder.files) == sorted(tmp_path.iterdir())
    assert (tmp_path / "b.csv").read_text() == "x\n1.5\n"
    assert (tmp_path / "c.png").read_bytes().startswith(b"\x89PNG")
    assert (tmp_path / "c.svg").read_text(encoding="utf-8").rstrip().endswith("</svg>")


def test_a_file_written_again_is_replaced(tmp_path: Path) -> None:
    folder = OutputFolder(tmp_path)
    folder.write_text("a.txt", "a longer first version")
    folder.write_text("a.txt", "second")
    assert (tmp_path / "a.txt").read_text() == "second"


def test_files_are_readable_by_whom_the_user_lets_read(tmp_path: Path) -> None:
    OutputFolder(tmp_path).write_text("a.txt", "a")
    (tmp_path / "plain").touch()
    assert (tmp_path / "a.txt").stat().st_mode == (tmp_path / "plain").stat().st_mode


@pytest.mark.parametrize("below", [".", "run", "study/run"])
def test_a_file_is_no_folder(tmp_path: Path, below: str) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(SphearError, match=r"file is a file$"):
        OutputFolder(tmp_path / "file" / below)


def test_a_folder_without_permission_is_refused_before_anything_is_computed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    access = os.access
    monkeypatch.setattr(os, "access", lambda path, mode: access(path, mode) and not mode & os.W_OK)
    with pytest.raises(SphearError, match=r"not writable$"):
        OutputFolder(tmp_path / "run")


def test_a_disk_that_fills_up_leaves_nothing_behind(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = OutputFolder(tmp_path)
    folder.write_text("a.txt", "first")

    def fills_up(path: Path, text: str, encoding: str) -> None:
        path.write_bytes(text[:3].encode(encoding))
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "write_text", fills_up)
    with pytest.raises(SphearError, match=r"a\.txt cannot be written: No space left on device$"):
        folder.write_text("a.txt", "second")
    assert [path.read_text() for path in tmp_path.iterdir()] == ["first"]
    assert folder.files == [tmp_path / "a.txt"]


def test_an_interrupted_file_leaves_nothing_behind(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(table: Table, path: Path) -> None:
        path.write_text("half")
        raise KeyboardInterrupt

    monkeypatch.setattr(Table, "to_csv", interrupted)
    with pytest.raises(KeyboardInterrupt):
        OutputFolder(tmp_path / "run").write_table("a", Table("", (), []))
    assert list((tmp_path / "run").iterdir()) == []


@given(text=st.text())
def test_any_text_is_given_back(tmp_path_factory: pytest.TempPathFactory, text: str) -> None:
    folder = OutputFolder(tmp_path_factory.getbasetemp())
    folder.write_text("any.txt", text)
    with folder.files[-1].open(encoding="utf-8", newline="") as file:
        assert file.read() == text


def test_results_do_not_import_matplotlib() -> None:
    code = "import sys, sphear.results; sys.exit('matplotlib' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
