"""Particles are counted before they are made."""

from __future__ import annotations

from typing import Any

import pytest

import sphear
from sphear.cases import size
from sphear.cases.lattice import lattice
from sphear.errors import SphearError


@pytest.mark.parametrize("case", ["taylor-green", "poiseuille", "cavity", "cavity-cylinder", "dam-break"])
@pytest.mark.parametrize("resolution", [10**7, 10**20, 10**400, 10**5000], ids=["7", "20", "400", "5000"])
def test_a_flow_of_too_many_particles_is_refused_with_numbers(case: str, resolution: int) -> None:
    with pytest.raises(
        SphearError, match=r"^resolution=.* makes .* particles, which take .* GB or more where there"
    ) as told:
        sphear.flow(case, resolution=resolution)
    assert len(str(told.value)) < 300


def test_the_largest_resolution_that_is_named_is_allowed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(size, "memory_limit", lambda: 10**6 * size.PER_PARTICLE)
    size.check_size("resolution", 1000, (1.0, 1.0))
    with pytest.raises(SphearError, match="take a resolution of 1000 or less"):
        size.check_size("resolution", 1001, (1.0, 1.0))
    size.check_size("resolution", 100, (1.0, 1.0, 1.0))
    with pytest.raises(SphearError, match="take a size of 99 or less"):
        lattice(100, 3)


def test_where_nothing_says_how_much_memory_there_is_numbers_are_the_limit(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(size, "memory_limit", lambda: None)
    size.check_size("resolution", 40_000, (1.0, 1.0))
    with pytest.raises(SphearError, match="of which no more than 2147483647 can be numbered"):
        size.check_size("resolution", 50_000, (1.0, 1.0))


def test_memory_is_some_of_this_machine() -> None:
    found: Any = size.memory_limit()
    assert found is None or 10**7 < found < 10**16
