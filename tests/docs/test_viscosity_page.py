"""The documentation's page of viscous terms is that of the measured cards."""

from __future__ import annotations

from pathlib import Path

from sphear.viscosity.page import page

PAGE = Path(__file__).parents[2] / "docs" / "theory" / "viscosity.md"


def test_the_page_is_up_to_date() -> None:
    assert PAGE.read_text(encoding="utf-8") == page(), "run python validation/measure_cards.py"
