"""Fields that are the same of all particles."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from sphear.corrections import NoCorrection
from sphear.engine.sweep import Sweep
from sphear.engine.uniform import with_uniform
from sphear.engine.weights import chunk_weights
from sphear.interactions import Gradient
from sphear.interactions.concentration import Concentration
from sphear.interactions.laplacian_weights import LaplacianWeights
from sphear.kernels import WendlandC2
from sphear.neighbours import Neighbours
from sphear.viscosity import Morris
from tests.particles import jittered

KERNEL = WendlandC2(0.08)
VOLUME = 0.05**2
NEIGHBOURS = Neighbours(jittered((20, 20), 0.3, seed=1, dx=0.05), KERNEL.radius)
EVERYWHERE = np.full(400, VOLUME)


@pytest.mark.parametrize("interaction", [Concentration(KERNEL), Gradient(KERNEL, NoCorrection(), True)])
def test_sums_are_those_of_a_field_that_has_one_value(interaction: Any) -> None:
    values = {"values": np.random.default_rng(0).random((400, 2))} if isinstance(interaction, Gradient) else {}
    found = Sweep(with_uniform(interaction, (("volume", VOLUME),)), NEIGHBOURS, values)
    expected = Sweep(interaction, NEIGHBOURS, {"volume": EVERYWHERE, **values})
    assert found.records.shape[1] <= expected.records.shape[1]
    assert not any(name == "volume" for name, _ in found.formula.columns + found.formula.private)
    np.testing.assert_allclose(found.everywhere(), expected.everywhere(), rtol=1e-13, atol=1e-14)


def test_kept_weights_are_those_of_a_field_that_has_one_value() -> None:
    interaction = LaplacianWeights(Morris(), KERNEL, NoCorrection())
    found = chunk_weights(with_uniform(interaction, (("volume", VOLUME),)), NEIGHBOURS, {})
    expected = chunk_weights(interaction, NEIGHBOURS, {"volume": EVERYWHERE})
    np.testing.assert_allclose(np.concatenate(found), np.concatenate(expected), rtol=1e-13)


def test_another_value_is_no_other_code() -> None:
    one, other = (Sweep(with_uniform(Concentration(KERNEL), (("volume", v),)), NEIGHBOURS, {}) for v in (1.0, 2.0))
    assert one.module is other.module
    np.testing.assert_allclose(2.0 * one.everywhere(), other.everywhere(), rtol=1e-14)
