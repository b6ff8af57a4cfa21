"""Draw up docs/reference/settings.md from the docstrings of the settings.

    python validation/settings_page.py

A test compares the page with them.
"""

from __future__ import annotations

from pathlib import Path

from sphear.cli.settings_page import settings_page

PAGE = Path(__file__).parents[1] / "docs" / "reference" / "settings.md"

if __name__ == "__main__":
    PAGE.write_text(settings_page(), encoding="utf-8")
