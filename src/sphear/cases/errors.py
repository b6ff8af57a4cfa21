"""Errors of a computed field against the exact one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, fields
from typing import Any

import numpy as np

Array = np.ndarray[Any, Any]


@dataclass(frozen=True)
class PatchErrors:
    """Four readings of the error of a patch test.

    Attributes:
        l1: sum |computed - exact| / sum |exact|.
        l2: the same with squares, under a root.
        max: max |computed - exact| / max |exact|.
        paper: l1 divided by the number of sample points M once more: what Tables 1 and 2 of Zheng, Ma & Shao (2018)
            show. It falls like 1 / M even where the error itself does not fall.
    """

    l1: float
    l2: float
    max: float
    paper: float

    def as_dict(self) -> dict[str, float]:
        """The errors by name."""
        return asdict(self)

    @classmethod
    def mean(cls, errors: Sequence[PatchErrors]) -> PatchErrors:
        """The mean of each error."""
        return cls(*(float(np.mean([getattr(one, f.name) for one in errors])) for f in fields(cls)))


def patch_errors(computed: Array, exact: Array) -> PatchErrors:
    """The errors of `computed` (M, k) against `exact` (M, k), absolute where the exact field is zero."""
    difference = np.abs(computed - exact)
    size = np.abs(exact)

    def ratio(error: float, norm: float) -> float:
        return error / norm if norm > 0 else error

    l1 = ratio(float(difference.sum()), float(size.sum()))
    return PatchErrors(
        l1=l1,
        l2=ratio(float(np.sqrt((difference**2).sum())), float(np.sqrt((size**2).sum()))),
        max=ratio(float(difference.max(initial=0.0)), float(size.max(initial=0.0))),
        paper=l1 / max(1, len(exact)),
    )
