"""`import sphear` as users and their type checkers see it: everything there, nothing imported, nothing that is Any."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any, assert_type

import numpy as np
import pytest

import sphear
from sphear.cases.flow import FLOWS
from sphear.cases.flow.options import FlowOptions
from sphear.schemes.incompressible.settings import IncompressibleSettings
from sphear.schemes.weakly_compressible.settings import WeaklyCompressibleSettings

SOURCE = Path(sphear.__file__).parent

Array = np.ndarray[Any, Any]
X = np.random.default_rng(0).random((40, 2))


def test_type_checkers_and_programs_know_the_same_names() -> None:
    tree = ast.parse((SOURCE / "__init__.py").read_text(encoding="utf-8"))
    block = next(node for node in tree.body if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING")
    typed = {
        (node.module, alias.name, alias.asname)
        for node in block.body
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    }
    modules = {("sphear", name, name) for name in sphear._MODULES}
    assert typed == modules | {(home, name, name) for home, names in sphear._HOMES.items() for name in names}


def test_every_name_is_what_its_home_has() -> None:
    for home, names in sphear._HOMES.items():
        for name in names:
            assert getattr(sphear, name) is getattr(import_module(home), name)
    for name in sphear._MODULES:
        assert getattr(sphear, name) is import_module(f"sphear.{name}")
    assert dir(sphear) == sorted(sphear.__all__)
    with pytest.raises(AttributeError, match="no attribute 'nonsense'"):
        sphear.nonsense  # type: ignore[attr-defined]  # noqa: B018


def test_importing_the_package_imports_nothing_else() -> None:
    code = "import sys; before = set(sys.modules); import sphear; print(*sorted(set(sys.modules) - before))"
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split()
    heavy = {"llvmlite", "matplotlib", "numba", "numpy", "pydantic", "rich", "scipy", "typer", "yaml"}
    assert {name.split(".")[0] for name in found} & heavy == set()
    assert [name for name in found if name.startswith("sphear.")] == []


# mypy checks this file as strictly as a user may check a script: a type that is Any is no other, and a comment that
# silences an error where there is none is an error itself


def test_the_types_that_users_meet() -> None:
    assert_type(sphear.laplacian(X, X, viscosity=sphear.Morris()), Array)
    assert_type(sphear.Particles.read(X), sphear.Particles)
    assert_type(sphear.Particles.read(X).volumes, Array)
    assert_type(sphear.VISCOSITY["morris"], sphear.ViscousTerm)
    assert_type(sphear.KERNELS["cubic_spline"], type[sphear.Kernel])
    assert_type(sphear.PatchTest(sizes=(20,)).h_over_dx, float | None)
    run = sphear.flow("cavity", viscosity=sphear.Cleary(xi=2), reynolds=100.0, resolution=12)
    assert_type(run, sphear.CaseRun)
    assert_type(run.history, list[dict[str, float]])
    assert_type(run.flow.velocities, Array)
    assert_type(run.flow.time_step, float)


WRONG: list[Callable[[], object]] = [
    lambda: sphear.nonsense,  # type: ignore[attr-defined]
    lambda: sphear.laplacian(X, "abc", viscosity=3),  # type: ignore[arg-type]
    lambda: sphear.flow("cavity", reynold=100),  # type: ignore[call-arg]
    lambda: sphear.flow("cavity", reynolds="many"),  # type: ignore[arg-type]
    lambda: sphear.flow(3),  # type: ignore[arg-type]
    lambda: sphear.Cleary(alpha=1),  # type: ignore[call-arg]
    lambda: sphear.PatchTest(dim=3),  # type: ignore[call-arg]
    lambda: sphear.PatchTest(dimension=4),  # type: ignore[arg-type]
]


@pytest.mark.parametrize("wrong", WRONG)
def test_wrong_calls_are_errors_to_type_checkers_and_when_they_are_made(wrong: Callable[[], object]) -> None:
    with pytest.raises((sphear.SphearError, AttributeError, TypeError)):
        wrong()


def test_the_settings_of_flows_are_those_that_type_checkers_know() -> None:
    kinds = [
        WeaklyCompressibleSettings,
        IncompressibleSettings,
        *(kind for case in FLOWS for kind in FLOWS[case].kinds.values()),
    ]
    assert set(FlowOptions.__annotations__) == {name for kind in kinds for name in kind.model_fields}


def test_what_is_printed_of_objects_is_short_and_telling() -> None:
    run = sphear.flow("cavity", scheme="incompressible", reynolds=400, resolution=12)
    assert repr(run) == ("<CaseRun of cavity: incompressible, fatehi_manzari, Re = 400, 144 particles, t = 0, step 0>")
    assert repr(run.flow).startswith("<IncompressibleFlow of 144 particles, fatehi_manzari: t = 0, 0 steps of 0.0")
    assert repr(sphear.flow("couette", resolution=12).flow).startswith("<WeaklyCompressibleFlow of ")
    assert repr(sphear.KERNELS).startswith("<Registry of kernel: cubic_spline, ")
    assert repr(sphear.Particles.read(X, kernel=sphear.WendlandC2(0.2))) == (
        "<Particles: 40 in 2-D, WendlandC2(h=0.2), float64>"
    )
