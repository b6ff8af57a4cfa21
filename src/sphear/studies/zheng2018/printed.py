"""Eq. 16 as printed, with u_ij = u_i - u_j and no factor: its limit in 2-D is -2 lap u."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from sphear.references.zheng2018 import SIZES
from sphear.studies.result import Progress
from sphear.studies.zheng2018.patch import settings
from sphear.viscosity import VISCOSITY, Gotoh

NAME = "gotoh_printed"


@contextmanager
def registered() -> Iterator[None]:
    """Knows the printed form by name, for the time of a reproduction only."""
    VISCOSITY.add(NAME, Gotoh(printed=True))
    try:
        yield
    finally:
        VISCOSITY.remove(NAME)


def rows(progress: Progress, **changes: Any) -> list[dict[str, Any]]:
    """The patch test of the printed form."""
    with registered():
        found = settings(viscosity=(NAME,), **changes).rows(progress)
    return [
        {
            "reading": "eq. 16 as printed",
            "particles": row["particles"],
            "viscosity": NAME,
            "computed": row["paper"],
            "l1_relative": row["l1"],
        }
        for row in found
        if row["particles"] in SIZES
    ]
