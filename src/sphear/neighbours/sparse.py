"""The pair list as the pattern of a sparse matrix."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.sparse import csr_array

from sphear.neighbours.neighbours import Neighbours

Array = np.ndarray[Any, Any]


def sparse_rows(neighbours: Neighbours, weights: Array, columns: int, column: Array | None = None) -> csr_array:
    """The matrix whose row k holds the weights of the pairs of `neighbours.rows[k]`.

    Args:
        neighbours: the pairs.
        weights: (pairs,), in the order of the chunks of the pair list.
        columns: their number.
        column: (N,), the column of each particle; None is its own number.
    """
    chunks = neighbours.chunks
    starts = np.zeros(neighbours.count + 1, np.int32)
    listed = np.empty(len(weights), np.int32)
    place = neighbours.source if column is None else column[neighbours.source].astype(np.int32, copy=False)
    before = 0
    for chunk in chunks:
        starts[chunk.begin + 1 : chunk.end + 1] = chunk.first[1:] + before
        out = listed[before : before + chunk.pairs]
        np.take(place, chunk.neighbour[: chunk.pairs], out=out, mode="clip")  # "raise" would go through a copy
        before += chunk.pairs
    return csr_array((weights, listed, starts), shape=(neighbours.count, columns))
