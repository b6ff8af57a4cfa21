"""The matrix of the pressure equation from pair weights: wall particles are eliminated, fixed pressures too."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.sparse import csr_array

from sphear.engine.cache import compiled

Array = np.ndarray[Any, Any]


@compiled
def _eliminate(  # type: ignore[no-untyped-def]
    starts, columns, weights, unknowns, to, of, share, jump, fixed, natural, place, new_starts, new_columns,
    new_weights, jump_terms,
):  # fmt: skip
    """See `eliminated`, on arrays of compressed rows; how many numbers were written, or -1 if there is no room."""
    rows, room, count = len(starts) - 1, len(new_columns), 0
    seen = np.zeros(len(to) - 1, np.bool_)  # walls with fluid before them
    for wall in range(len(seen)):
        for m in range(to[wall], to[wall + 1]):
            seen[wall] |= share[m] != 0.0
    for row in range(rows):
        begin, diagonal = count, 0.0
        most, simple = 1, not fixed[row]
        for k in range(starts[row], starts[row + 1]):
            column = columns[k]
            if column < unknowns:
                most += 1
                simple = simple and not fixed[column]
            else:
                most += 1 if natural else to[column - unknowns + 1] - to[column - unknowns]
                simple = False
        if begin + most > room:
            return -1
        if simple:  # far from walls and surfaces, where most particles are, a row is copied
            count += 1
            for k in range(starts[row], starts[row + 1]):
                new_columns[count], new_weights[count] = columns[k], weights[k]
                diagonal -= weights[k]
                count += 1
            new_columns[begin], new_weights[begin] = row, diagonal
            new_starts[row + 1] = count
            continue
        walls = not natural
        while True:
            place[row] = begin  # where a column of this row is kept; the diagonal comes first
            new_columns[begin], new_weights[begin] = row, 0.0
            count += 1
            for k in range(starts[row], starts[row + 1]):
                column, weight = columns[k], weights[k]
                if column < unknowns:
                    diagonal -= weight
                    if not (fixed[column] or fixed[row]):
                        if place[column] < begin:
                            place[column] = count
                            new_columns[count], new_weights[count] = column, 0.0
                            count += 1
                        new_weights[place[column]] += weight
                elif walls and seen[column - unknowns]:
                    wall = column - unknowns
                    diagonal -= weight
                    if not fixed[row]:
                        jump_terms[row] += weight * jump[wall]
                    for m in range(to[wall], to[wall + 1]):
                        column = of[m]
                        if not (fixed[column] or fixed[row]):
                            if place[column] < begin:
                                place[column] = count
                                new_columns[count], new_weights[count] = column, 0.0
                                count += 1
                            new_weights[place[column]] += weight * share[m]
            if not walls or fixed[row] or new_weights[begin] + diagonal < 0.0:
                break
            for m in range(begin, count):  # in a narrow corner pressures behind walls may be mostly the particle's own
                place[new_columns[m]] = -1
            walls, diagonal, jump_terms[row], count = False, 0.0, 0.0, begin
        new_weights[begin] += diagonal if not fixed[row] or diagonal < 0.0 else -1.0  # of a particle that is alone
        new_starts[row + 1] = count
    return count


def eliminated(
    weights: csr_array, mirrored: csr_array | None, jump: Array, fixed: Array, unknowns: int
) -> tuple[csr_array, Array]:
    """The rows sum_j w_ij (p_j - p_i) with the pressures of wall particles put in as p_w = sum_k m_wk p_k + jump_w.

    Args:
        weights: (R, unknowns + W), w_ij; row i is of unknown i.
        mirrored: (W, unknowns), m_wk; a wall particle without any is left out, and None leaves out all: the natural
            condition. So has a row whose diagonal they would make positive, as can be in a narrow corner.
        jump: (W,).
        fixed: (unknowns,), where the pressure is zero: these rows hold their diagonal only.
        unknowns: how many pressures are asked for.

    Returns:
        matrix: (R, unknowns), with the diagonal.
        jump_terms: (R,), sum_w w_iw jump_w, which belongs to the matrix's side of the equation.
    """
    natural = mirrored is None
    none = np.zeros(1, np.int32)
    to, of, share = (
        (none, none, np.zeros(1)) if mirrored is None else (mirrored.indptr, mirrored.indices, mirrored.data)
    )
    rows = weights.shape[0]
    starts, jump_terms = np.zeros(rows + 1, np.int32), np.zeros(rows)
    room = 2 * weights.nnz + rows
    while True:
        columns, values, place = np.empty(room, np.int32), np.empty(room), np.full(unknowns, -1, np.int64)
        jump_terms[:] = 0.0
        count = _eliminate(
            weights.indptr, weights.indices, weights.data, unknowns, to, of, share, jump, fixed, natural, place, starts,
            columns, values, jump_terms,
        )  # fmt: skip
        if count >= 0:
            return csr_array((values[:count], columns[:count], starts), shape=(rows, unknowns)), jump_terms
        room *= 2
