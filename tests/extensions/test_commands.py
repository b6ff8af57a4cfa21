"""Extensions on the command line: a file that is named, and a package that is installed, as processes of their own."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

import sphear

from .conftest import FILE

SOURCE = str(Path(sphear.__file__).parents[1])
Command = Callable[..., "subprocess.CompletedProcess[str]"]


@pytest.fixture
def command(tmp_path: Path) -> Command:
    """The command line in a folder of its own, with a package there that declares an extension."""

    def run(*arguments: str, code: int = 0) -> subprocess.CompletedProcess[str]:
        paths = os.pathsep.join((SOURCE, str(tmp_path / "installed")))
        found = subprocess.run(
            [sys.executable, "-m", "sphear", *arguments], cwd=tmp_path, capture_output=True, text=True, check=False,
            env={**os.environ, "PYTHONPATH": paths},
        )  # fmt: skip
        assert found.returncode == code, found.stderr
        return found

    return run


def install(tmp_path: Path, text: str) -> None:
    """A package on the path whose entry point is a module of this text."""
    about = tmp_path / "installed" / "my_package-1.0.dist-info"
    about.mkdir(parents=True)
    (about / "METADATA").write_text("Metadata-Version: 2.1\nName: my-package\nVersion: 1.0\n")
    (about / "entry_points.txt").write_text("[sphear.extensions]\nmine = my_package.terms\n")
    package = tmp_path / "installed" / "my_package"
    package.mkdir()
    (package / "__init__.py").write_text("")
    (package / "terms.py").write_text(text)


def test_a_file_is_listed(command: Command) -> None:
    listed = json.loads(command("list", "--extension", str(FILE), "--json").stdout)
    found = {entry["name"]: entry for kind in listed.values() for entry in kind}
    assert found["mine"] == {
        "name": "mine", "aliases": ["my term"], "summary": "That of Morris, Fox & Zhu, with a factor",
    }  # fmt: skip
    assert {"tripled", "by_function", "my_kernel", "my_correction"} <= set(found)


def test_a_file_is_shown_with_what_is_measured_of_it(command: Command) -> None:
    card = command("show", "viscosity", "my term", "--extension", str(FILE)).stdout
    for line in (
        "Mine(factor=2.0)",
        "in words         That of Morris",
        "order, lattice   +0.2",
        "angular momentum: no",
    ):
        assert line in card
    kernel = command("show", "my_kernel", "--extension", str(FILE)).stdout
    assert "Wendland's, by another name" in kernel


def test_a_file_is_known_to_the_patch_test_and_flows(command: Command) -> None:
    options = ("--extension", str(FILE), "--json")
    rows = json.loads(command("patch-test", "-v", "mine", "-v", "morris", "--sizes", "20", *options).stdout)["rows"]
    assert rows[0]["viscosity"] == "mine"
    assert rows[0]["l1"] == pytest.approx(rows[1]["l1"])
    chosen = ("cavity", "--scheme", "incompressible", "--resolution", "12", "--until", "0.01", "-v", "mine")
    settings = json.loads(command("run", *chosen, "--set", "kernel=my_kernel", *options).stdout)["settings"]
    assert (settings["viscosity"], settings["kernel"]) == ("mine", "my_kernel")


def test_a_sweep_passes_a_file_to_its_workers(command: Command, tmp_path: Path) -> None:
    over = ("--over", "viscosity=mine,by_function,morris", "--set", "resolution=12", "--set", "until=0.01")
    where = ("--set", "scheme=incompressible", "--workers", "2", "--out", "out", "--extension", str(FILE))
    found = command("sweep", "cavity", *over, *where)
    assert found.stderr == "" or "lost" not in found.stderr
    runs = json.loads((tmp_path / "out" / "sweep.json").read_text())["runs"]
    assert [run["settings"]["viscosity"] for run in runs] == ["mine", "by_function", "morris"]
    assert runs[0]["metrics"]["kinetic_energy"] == pytest.approx(runs[2]["metrics"]["kinetic_energy"])


def test_without_the_file_the_name_is_unknown(command: Command) -> None:
    assert "there is no viscosity named 'mine'" in command("show", "viscosity", "mine", code=2).stderr


def test_a_file_that_fails_is_one_sentence(command: Command, tmp_path: Path) -> None:
    (tmp_path / "broken.py").write_text("import sphear\nsphear.nonsense\n")
    said = command("list", "--extension", "broken.py", code=2).stderr
    assert said == (
        "sphear: the extension 'broken.py' cannot be imported: line 2, AttributeError: module 'sphear' has no attribute"
        " 'nonsense'\n"
    )


def test_an_installed_package_is_known_without_an_import(command: Command, tmp_path: Path) -> None:
    install(tmp_path, FILE.read_text(encoding="utf-8"))
    assert "\n  mine  " in command("list", "viscosity").stdout
    rows = json.loads(command("patch-test", "-v", "mine", "--sizes", "20", "--json").stdout)["rows"]
    assert rows[0]["viscosity"] == "mine"


def test_an_installed_package_that_fails_leaves_the_rest(command: Command, tmp_path: Path) -> None:
    install(tmp_path, "import sphear\n1 / 0\n")
    found = command("list", "viscosity")
    assert "\n  morris  " in found.stdout
    assert found.stderr.startswith(
        "sphear: warning: the extension 'my_package.terms' of the package my-package cannot be imported and its names"
        " are missing: "
    )
    assert found.stderr.endswith("terms.py, line 2, ZeroDivisionError: division by zero\n")
