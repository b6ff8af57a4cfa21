"""Room for the names at the ends of curves."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import isotonic_regression


def spread(levels: ArrayLike, distance: float) -> NDArray[np.float64]:
    """Move ascending levels apart, inside [0, 1], with the least sum of squared displacements.

    Less `distance` times its rank, a level only has to be no lower than the one before: that is isotonic regression,
    and its solution between bounds is the clipped one without. Where the levels do not fit, the last ones leave [0, 1].
    """
    levels = np.asarray(levels, float)
    rank = distance * np.arange(levels.size)
    return np.clip(isotonic_regression(levels - rank).x, 0, max(0, 1 - rank[-1])) + rank
