"""The documentation's page of extensions: its examples run and do what it says."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad

import sphear

PAGE = Path(__file__).parents[2] / "docs" / "how-to" / "extending.md"
EXAMPLES = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
TERMS = ("mine", "Mine(factor=2.1)", "morris")
X = np.random.default_rng(0).random((300, 2))


@pytest.fixture
def names(monkeypatch: pytest.MonkeyPatch) -> Iterator[dict[str, Any]]:
    """The names that all examples define."""
    module = ModuleType("example")
    monkeypatch.setitem(sys.modules, "example", module)
    for example in EXAMPLES:
        exec(compile(example, "example", "exec", dont_inherit=True), vars(module))
    yield vars(module)
    for registry in (sphear.VISCOSITY, sphear.KERNELS, sphear.CORRECTIONS, sphear.SHIFTING):
        for name in set(registry) - registry.published:
            registry.remove(name)


def test_the_examples_do_what_the_page_says(names: dict[str, Any], capsys: pytest.CaptureFixture[str]) -> None:
    assert len(EXAMPLES) == 5
    assert all(len([line for line in example.splitlines() if line]) <= 20 for example in EXAMPLES)
    x, run, values = names["x"], names["run"], X[:, 0] ** 2
    for lap in (names["lap"], names["same"]):
        np.testing.assert_allclose(lap, sphear.laplacian(x, x[:, 0] ** 2), rtol=1e-12)
    assert (run.end, run.as_dict()["settings"]["viscosity"]) == ("time", "mine")
    other = names["other"].as_dict()
    assert (other["metrics"]["end"], other["settings"]["viscosity"]) == ("time", "Mine(factor=2.1)")
    assert other["metrics"]["kinetic_energy"] < run.history[-1]["kinetic_energy"]  # it is 5 % more viscous
    own, more, morris = ([row["l1"] for row in names["rows"] if row["viscosity"] == term] for term in TERMS)
    np.testing.assert_allclose(own, morris, rtol=1e-12)
    assert more[0] > own[0]
    by_function = sphear.laplacian(X, values, viscosity="from_function")
    np.testing.assert_allclose(by_function, sphear.laplacian(X, values), rtol=1e-12)
    weaker = sphear.gradient(X, values, correction="weaker")
    np.testing.assert_allclose(weaker, 0.9 * sphear.gradient(X, values, correction="none"), rtol=1e-12)
    assert np.isfinite(sphear.laplacian(X, values, kernel="quartic_dome")).all()
    gentle = sphear.Incompressible(shifting="gentle", shifting_strength=0.1)
    assert gentle.shifting_method == names["Gentle"](strength=0.1)
    assert gentle.shifting_method.drift(sphear.WendlandC2(1.0), 2.0, 0.5) == sphear.Lind(0.1).drift(
        sphear.WendlandC2(1.0), 2.0, 0.5
    )


def test_the_kernel_of_the_page_is_one(names: dict[str, Any]) -> None:
    kernel = names["QuarticDome"](1.0)
    measures = (lambda q: 2.0, lambda q: 2 * np.pi * q, lambda q: 4 * np.pi * q * q)
    for dimension, measure in enumerate(measures, 1):
        integral, _ = quad(lambda q, d=dimension, m=measure: kernel.value(q * q, d) * m(q), 0, 2)
        assert integral == pytest.approx(1)
    q, step = 0.8, 1e-4
    shape = [kernel.shape(q + k * step, 2) for k in (-1, 0, 1)]
    assert kernel.slope(q, 2) == pytest.approx((shape[2] - shape[0]) / (2 * step) / q, rel=1e-6)
    assert kernel.curvature(q, 2) == pytest.approx((shape[2] - 2 * shape[1] + shape[0]) / step**2, rel=1e-5)
