"""The pair list as the pattern of a sparse matrix."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from scipy.sparse import csr_array

from sphear.neighbours.pair_list import Chunk

Array = np.ndarray[Any, Any]


def sparse_rows(chunks: Sequence[Chunk], weights: Sequence[Array], place: Array, columns: int) -> csr_array:
    """The matrix whose row k holds the weights of the pairs of row k of a pair list.

    Args:
        chunks: the pair list.
        weights: of each chunk's pairs, in the order of its list; what follows them is left out.
        place: (E,), the column of each entry.
        columns: their number.
    """
    rows = chunks[-1].end if chunks else 0
    starts = np.zeros(rows + 1, np.int64)
    for chunk in chunks:
        starts[chunk.begin + 1 : chunk.end + 1] = starts[chunk.begin] + chunk.first[1:]
    listed, numbers = np.empty(starts[-1], np.int32), np.empty(starts[-1])
    for chunk, values in zip(chunks, weights, strict=True):
        part = slice(starts[chunk.begin], starts[chunk.end])
        listed[part], numbers[part] = place[chunk.neighbour[: chunk.pairs]], values[: chunk.pairs]
    return csr_array((numbers, listed, starts), shape=(rows, columns))
