"""The patch test of section 4, with the definition that reproduces the paper's tables.

f = x^4 + y^4, cubic spline, h = dx, V = dx^2, eta = 0; samples are the particles whose support lies inside the square,
and all neighbours are there. Err is the L1-relative error divided by the number of samples M once more, not the mean
relative error that eq. 21 defines: only so do all entries of Table 1 come out.
"""

from __future__ import annotations

from typing import Any

from sphear.cases.patch_test import PatchTest
from sphear.references.zheng2018 import SIZES, TERMS
from sphear.results.table import Column, Table
from sphear.studies.result import Progress

JITTER = 0.3
"""Of Table 2, in dx: the printed amplitude of 1 gives other numbers."""

SEEDS = 16


def settings(**changes: Any) -> PatchTest:
    """The paper's patch test with some settings changed."""
    base = {"viscosity": tuple(TERMS.values()), "sizes": SIZES, "field": "quartic", "h_over_dx": 1.0}
    return PatchTest.model_validate(base | changes)


def compared(test: PatchTest, published: dict[str, tuple[float, ...]], progress: Progress) -> list[dict[str, Any]]:
    """Rows of a table of errors: published beside computed, and the L1-relative error."""
    return [
        {
            "particles": row["particles"],
            "viscosity": row["viscosity"],
            "published": published[row["viscosity"]][SIZES.index(row["particles"])],
            "computed": row["paper"],
            "l1_relative": row["l1"],
            "order": row["order"],
        }
        for row in test.rows(progress)
    ]


def error_table(title: str, rows: list[dict[str, Any]]) -> Table:
    """Published and computed errors side by side, one line a term and size."""
    label = {name: paper for paper, name in TERMS.items()}
    return Table(
        title,
        (
            Column("label", "paper"),
            Column("viscosity", "viscosity"),
            Column("particles", "particles a side", "d"),
            Column("published", "Err published", ".2e"),
            Column("computed", "Err computed", ".2e"),
            Column("difference", "difference %", "+.1f"),
            Column("l1_relative", "L1-relative error", ".2e"),
            Column("order", "its order", "+.2f"),
        ),
        [
            {**row, "label": label[row["viscosity"]], "difference": 100 * (row["computed"] / row["published"] - 1)}
            for row in rows
        ],
    )


def last(rows: list[dict[str, Any]], viscosity: str, key: str) -> float:
    """A number of the finest size of a term."""
    return float(max((r for r in rows if r["viscosity"] == viscosity), key=lambda r: r["particles"])[key])


def first(rows: list[dict[str, Any]], viscosity: str, key: str) -> float:
    """A number of the coarsest size of a term."""
    return float(min((r for r in rows if r["viscosity"] == viscosity), key=lambda r: r["particles"])[key])
