"""The documentation's page of viscous terms is the one that the package's cards make."""

from pathlib import Path

from sphear.viscosity.page import page


def test_the_page_is_up_to_date():
    committed = Path(__file__).parents[2] / "docs" / "viscosity.md"
    assert committed.read_text(encoding="utf-8") == page(), "run python validation/measure_cards.py"
