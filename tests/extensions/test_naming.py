"""Decorated terms, kernels, corrections and equations of state: found by name wherever a name is taken."""

from __future__ import annotations

import pickle
import sys
from dataclasses import dataclass
from typing import Any, assert_type

import numpy as np
import pytest

import sphear
from sphear.algebra import Scalar, Vector
from sphear.cases.flow import FLOWS
from sphear.schemes.weakly_compressible.flow import WeaklyCompressibleFlow

X = np.random.default_rng(0).random((300, 2))
F = X[:, 0] ** 2 * X[:, 1]

pytestmark = pytest.mark.usefixtures("my_terms")


def same(one: Any, other: Any) -> None:
    np.testing.assert_allclose(one, other, rtol=1e-12)


@pytest.mark.parametrize("name", ["mine", "My-Term", "by_function"])
def test_a_term_is_found_by_name_and_alias(name: str) -> None:
    same(sphear.laplacian(X, F, viscosity=name), sphear.laplacian(X, F, viscosity="morris"))


def test_an_object_of_a_class_has_a_name_of_its_own() -> None:
    same(sphear.laplacian(X, F, viscosity="tripled"), 3 * sphear.laplacian(X, F, viscosity="morris"))
    assert sphear.VISCOSITY["tripled"] is sys.modules["my_terms"].tripled


def test_a_kernel_and_a_correction_are_found_by_name() -> None:
    own = sphear.gradient(X, F, kernel="my_kernel", correction="own")
    same(own, sphear.gradient(X, F, kernel="wendland_c2", correction="shepard"))


def test_all_of_them_work_in_flows_and_patch_tests() -> None:
    own: dict[str, Any] = {"viscosity": "my term", "kernel": "my_kernel", "correction": "my_correction"}
    package: dict[str, Any] = {"viscosity": "morris", "kernel": "wendland_c2", "correction": "shepard"}
    chosen: dict[str, Any] = {"scheme": "incompressible", "resolution": 12, "until": 0.01}
    one, other = (sphear.flow("cavity", **chosen, **names).run() for names in (own, package))
    np.testing.assert_allclose(one.flow.velocities, other.flow.velocities, rtol=0, atol=1e-13)
    assert one.as_dict()["settings"]["viscosity"] == "mine"
    rows = [
        sphear.PatchTest(sizes=(20,), **{**names, "viscosity": (names["viscosity"],)}).rows()
        for names in (own, package)
    ]
    same(rows[0][0]["l1"], rows[1][0]["l1"])
    assert rows[0][0]["viscosity"] == "mine"


def test_an_object_that_has_a_name_is_written_by_it() -> None:
    assert sphear.flow("cavity", viscosity=sys.modules["my_terms"].Mine(), resolution=12).settings.viscosity == "mine"


def test_a_flow_takes_an_equation_of_state_by_name() -> None:
    chosen = [FLOWS["cavity"].explicit(resolution=12, equation_of_state=name) for name in ("My-Equation", "linear")]
    one, other = (WeaklyCompressibleFlow(FLOWS["cavity"].problem(settings), settings) for settings in chosen)
    assert one.settings.equation_of_state == "my_equation"
    assert one.sound_speed == other.sound_speed
    one.advance(2)
    other.advance(2)
    np.testing.assert_array_equal(one.pressure, other.pressure)


def test_a_named_thing_is_pickled_as_what_its_module_has() -> None:
    for name in ("mine", "tripled", "by_function"):
        term = sphear.VISCOSITY[name]
        assert pickle.loads(pickle.dumps(term)) == term
    kernel = sphear.KERNELS["my_kernel"]
    assert pickle.loads(pickle.dumps(kernel)) is kernel


def test_a_definition_that_is_run_again_takes_the_place_of_the_first() -> None:
    def define(factor: float) -> None:
        @sphear.viscous_term("again", aliases=("once more",))
        @dataclass(frozen=True, repr=False)
        class Again(sphear.Morris):
            scale: float = factor

    define(1.0)
    define(3.0)
    assert vars(sphear.VISCOSITY["once more"])["scale"] == 3.0


def test_type_checkers_keep_the_type() -> None:
    @sphear.viscous_term("typed")
    class Typed(sphear.LaplacianTerm):
        factor: float = 2.0

        def weight(
            self, kernel: sphear.Kernel, correction: sphear.Correction, own: Any, d: Vector, r2: Scalar
        ) -> Scalar:
            return self.factor

    @sphear.viscous_term("typed_function")
    def weight(kernel: sphear.Kernel, correction: sphear.Correction, own: Any, d: Vector, r2: Scalar) -> Scalar:
        return 1.0

    assert_type(Typed(factor=3.0), Typed)
    assert_type(Typed(factor=3.0).factor, float)
    assert_type(sphear.viscous_term("other")(Typed(factor=3.0)), Typed)
    assert_type(weight, sphear.LaplacianTerm)
    with pytest.raises(TypeError, match="wrong"):
        Typed(wrong=3.0)  # type: ignore[call-arg]
