"""The documentation's page of viscous terms: the one that the package's cards make, and its example."""

import re
from pathlib import Path
from typing import Any

import numpy as np

import sphear
from sphear.viscosity.page import page

PAGE = Path(__file__).parents[2] / "docs" / "theory" / "viscosity.md"


def test_the_page_is_up_to_date() -> None:
    assert PAGE.read_text(encoding="utf-8") == page(), "run python validation/measure_cards.py"


def test_a_term_of_ones_own_as_the_page_shows_it() -> None:
    (example,) = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    assert len([line for line in example.splitlines() if line]) <= 20
    names: dict[str, Any] = {"__name__": "example"}
    try:
        exec(example, names)
        x, run = names["x"], names["run"]
        np.testing.assert_allclose(names["lap"], sphear.laplacian(x, x[:, 0] ** 2), rtol=1e-12)
        own, morris = ([row["l1"] for row in names["rows"] if row["viscosity"] == name] for name in NAMES)
        np.testing.assert_allclose(own, morris, rtol=1e-12)
        assert (run.end, run.as_dict()["settings"]["viscosity"]) == ("time", "Mine(factor=2.1)")
        assert sphear.flow("taylor-green", viscosity=names["Mine"](), resolution=12).settings.viscosity == "mine"
    finally:
        sphear.VISCOSITY.remove("mine")


NAMES = ("Mine(factor=2.0)", "morris")
