"""The card of a term measured by one call: what the committed cards say of the package's own."""

from __future__ import annotations

import pytest

import sphear
from sphear.viscosity.card import measured


@pytest.mark.parametrize("name", ["morris", "violeau"])
def test_a_published_term_measures_as_its_card_says(name: str) -> None:
    found = sphear.measured_card(name)
    known = measured()[name]
    assert found.as_dict() == {key: known[key] for key in found.as_dict()}
    assert repr(found) == repr(sphear.VISCOSITY[name]).rpartition("\n")[0]  # but for the cost


@pytest.mark.usefixtures("my_terms")
def test_an_extension_is_measured_by_name_and_as_an_object() -> None:
    said: list[str] = []
    found = sphear.measured_card("my term", said.append)
    assert found == sphear.measured_card(sphear.VISCOSITY["mine"])
    assert (found.linear_momentum, found.angular_momentum, found.dissipative) == (True, False, True)
    assert found.order_lattice == pytest.approx(measured()["morris"]["order_lattice"], abs=0.02)
    assert said == ["order on a lattice", "order on jittered particles", "conservation"]
    assert str(found).startswith("Mine(factor=2.0)\n  in words         That of Morris, Fox & Zhu, with a factor\n")


@pytest.mark.parametrize("wrong", ["moris", 3, sphear.Morris])
def test_what_is_no_term_is_refused(wrong: str) -> None:
    with pytest.raises(sphear.SphearError, match=r"no viscosity named|takes the name of a viscous term or an object"):
        sphear.measured_card(wrong)
