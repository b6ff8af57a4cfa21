"""What is distributed: a source distribution to build, test and read, a wheel to run, and their description."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import tarfile
import tomllib
from email import message_from_bytes
from email.message import Message
from pathlib import Path
from zipfile import ZipFile

import pytest

ROOT = Path(__file__).parents[1]
LEFT = shutil.ignore_patterns(
    ".*_cache", ".venv", ".git", ".hypothesis", "__pycache__", "build", "dist", "demo", "*.egg-info"
)
BUILD = "import setuptools.build_meta as b; print(b.build_sdist('made')); print(b.build_wheel('made'))"


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder with both, built from a copy of the tree."""
    tree = tmp_path_factory.mktemp("distribution") / "tree"
    shutil.copytree(ROOT, tree, ignore=LEFT)
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    subprocess.run([sys.executable, "-c", BUILD], cwd=tree, check=True, capture_output=True, env=environment)
    return tree / "made"


@pytest.fixture(scope="module")
def members(made: Path) -> set[str]:
    """The files of the source distribution."""
    (archive,) = made.glob("*.tar.gz")
    with tarfile.open(archive) as file:
        return {name.partition("/")[2] for name in file.getnames()}


@pytest.fixture(scope="module")
def wheel(made: Path) -> set[str]:
    """The files of the wheel."""
    (archive,) = made.glob("*.whl")
    with ZipFile(archive) as file:
        return set(file.namelist())


@pytest.fixture(scope="module")
def metadata(made: Path) -> Message:
    (archive,) = made.glob("*.whl")
    with ZipFile(archive) as file:
        return message_from_bytes(file.read(next(name for name in file.namelist() if name.endswith("/METADATA"))))


@pytest.mark.parametrize(
    "name",
    ["README.md", "LICENSE", "CHANGELOG.md", "CITATION.cff", "Makefile", "constraints.txt", "pyproject.toml"],
)
def test_the_source_distribution_has(name: str, members: set[str]) -> None:
    assert name in members


@pytest.mark.parametrize("folder", ["src", "tests", "docs", "examples", "validation", "benchmarks"])
def test_the_source_distribution_has_all_of_a_folder(folder: str, members: set[str]) -> None:
    files = {
        str(path.relative_to(ROOT))
        for path in (ROOT / folder).rglob("*")
        if path.is_file() and "__pycache__" not in path.parts and ".egg-info" not in str(path)
    }
    assert len(files) > 5
    assert files - members == set()


def test_the_wheel_has_the_package_with_its_types_and_data_and_nothing_else(wheel: set[str]) -> None:
    source = ROOT / "src"
    files = {
        str(path.relative_to(source))
        for path in (source / "sphear").rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }
    assert "sphear/py.typed" in files
    assert {name for name in wheel if ".dist-info/" not in name} == files


def test_the_description_leads_nowhere_that_a_package_index_has_not(metadata: Message) -> None:
    text = str(metadata.get_payload())
    assert metadata["Description-Content-Type"] == "text/markdown"
    assert len(text) > 1000
    assert re.findall(r"!?\[[^]]*\]\([^)]*\)|https?://", text) == []


def test_the_examples_of_the_description_are_those_of_the_readme() -> None:
    blocks = [
        re.findall(r"```python\n.*?```", (ROOT / name).read_text(encoding="utf-8"), re.DOTALL)
        for name in ("docs/package-index.md", "README.md")
    ]
    assert blocks[0] == blocks[1][: len(blocks[0])]
    assert len(blocks[0]) == 2


def test_the_classifiers_name_the_python_versions_that_it_needs(metadata: Message) -> None:
    needed = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["requires-python"]
    versions = [
        found[1]
        for line in metadata.get_all("Classifier", [])
        if (found := re.fullmatch(r"Programming Language :: Python :: (3\.\d+)", line))
    ]
    assert needed == f">={versions[0]}"
    assert len(versions) >= 3
