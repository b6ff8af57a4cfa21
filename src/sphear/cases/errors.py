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
    """The errors of `computed` (M, k) against `exact` (M, k); where the exact field is zero, their absolute means."""
    of_error, of_field = _means(np.abs(computed - exact)), _means(np.abs(exact))
    l1, l2, largest = (error / size if size > 0 else error for error, size in zip(of_error, of_field, strict=True))
    return PatchErrors(l1=l1, l2=l2, max=largest, paper=l1 / max(1, len(exact)))


def _means(sizes: Array) -> tuple[float, float, float]:
    """The mean, the root of the mean square and the largest of numbers that are not negative."""
    largest = float(sizes.max(initial=0.0))
    if largest == 0:
        return 0.0, 0.0, 0.0
    scaled = sizes / largest  # so that no square is too large or too small for a number
    return largest * float(scaled.mean()), largest * float(np.sqrt((scaled**2).mean())), largest
