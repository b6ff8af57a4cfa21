"""The extension `my_terms.py`, imported for one test, and its names free again after it."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import sphear
from sphear.extensions import discovery, loading
from sphear.names import Registry

REGISTRIES: tuple[Registry[Any], ...] = (
    sphear.VISCOSITY,
    sphear.KERNELS,
    sphear.CORRECTIONS,
    sphear.EQUATIONS_OF_STATE,
    sphear.SHIFTING,
    sphear.INTEGRATORS,
    sphear.WALL_MODELS,
    sphear.PRECONDITIONERS,
)
FILE = Path(__file__).with_name("my_terms.py")


@pytest.fixture(autouse=True)
def free_names(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Names and modules of extensions last for one test."""
    monkeypatch.setattr(loading, "_loaded", {})
    monkeypatch.setattr(sys, "path", list(sys.path))
    discovery.discover()
    yield
    for registry in REGISTRIES:
        for name in set(registry) - registry.published:
            registry.remove(name)
    for name in ("my_terms", "failing_extension", "working_extension"):
        sys.modules.pop(name, None)


@pytest.fixture
def my_terms() -> str:
    """The path of the extension, which is imported."""
    loading.load([str(FILE)])
    return str(FILE)
