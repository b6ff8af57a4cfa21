"""The compiled loops of a pressure equation that walk a pair list: see `sphear.pressure.pair_rows`."""

from __future__ import annotations

import numpy as np

from sphear.engine.cache import compiled, njit
from sphear.pressure.rows import ALONE, FINE, NOT_FINITE, ROUNDING, WRONG_SIGN, square_distance


@compiled
def sum_pairs(begin, end, first, neighbour, weights, own, pressures, vector, result):  # type: ignore[no-untyped-def]
    """result[row] = own[row] vector[row] + sum_k weights[k] pressures[neighbour[k]], of rows begin ... end."""
    for row in range(begin, end):
        total = own[row] * vector[row]
        for k in range(first[row - begin], first[row - begin + 1]):
            total += weights[k] * pressures[neighbour[k]]
        result[row] = total


@compiled
def spread(vector, unknown, starts, columns, shares, behind, pressures):  # type: ignore[no-untyped-def]
    """The pressures of all entries: of the unknowns, and `behind` walls by the rows of these."""
    for wall in range(len(behind)):
        total = 0.0
        for m in range(starts[wall], starts[wall + 1]):
            total += shares[m] * vector[columns[m]]
        behind[wall] = total
    unknowns = len(vector)
    for entry in range(len(pressures)):
        number = unknown[entry]
        pressures[entry] = vector[number] if number < unknowns else behind[number - unknowns]


@njit(nogil=True, fastmath={"reassoc"})
def prepare(  # type: ignore[no-untyped-def]
    begin, end, first, neighbour, weights, unknown, unknowns, starts, columns, shares, seen, sums, jump, fixed,
    some_fixed, outside, own, diagonal, jump_terms, kinds, neutral,
):  # fmt: skip
    """Drop weights that rows begin ... end do not have, and find their diagonals, what jumps add, and their faults.

    `own` is what multiplies the row's pressure beside its pairs; the `diagonal` has the walls' shares of it too.
    """
    for row in range(begin, end):
        from_, to = first[row - begin], first[row - begin + 1]
        fluid, size, largest, itself = 0.0, 0.0, np.uint32(0), 0
        for k in range(from_, to):
            number = unknown[neighbour[k]]
            largest = max(largest, number)
            itself += number == row
            fluid += weights[k]
            size += abs(weights[k])
        behind, back, given, walls, listed = 0.0, 0.0, 0.0, 0.0, size > 0.0
        if some_fixed or itself > 0 or largest >= unknowns:  # most rows are far from walls
            fluid, listed = 0.0, False
            for k in range(from_, to):
                number, weight = unknown[neighbour[k]], weights[k]
                if number < unknowns:
                    fluid += weight
                    if fixed[number] or fixed[row]:
                        weights[k] = 0.0
                    elif number == row:  # of its own image
                        back += weight
                    else:
                        listed = listed or weight != 0.0
                    continue
                wall = number - unknowns
                if not seen[wall]:
                    weights[k] = 0.0
                    continue
                behind += weight
                given += weight * jump[wall]
                walls += weight * sums[wall]
                share = 0.0
                for m in range(starts[wall], starts[wall + 1]):
                    share += shares[m] if columns[m] == row else 0.0
                back += weight * share
                listed = listed or share != sums[wall]
                if fixed[row]:
                    weights[k] = 0.0
        if fixed[row]:  # it holds its diagonal alone
            own[row] = diagonal[row] = -(fluid + behind) if fluid + behind > 0.0 else -1.0
            jump_terms[row], neutral[row] = 0.0, False
            kinds[row] = FINE if np.isfinite(own[row]) else NOT_FINITE
            continue
        if behind != 0.0 and back - fluid - behind >= 0.0:
            # in a narrow corner pressures behind walls may be mostly the particle's own: the row does without them
            back, behind, given, walls = 0.0, 0.0, 0.0, 0.0
            for k in range(from_, to):
                number = unknown[neighbour[k]]
                if number >= unknowns:
                    weights[k] = 0.0
                elif number == row:
                    back += weights[k]
        own[row] = outside[row] - fluid - behind
        diagonal[row] = own[row] + back
        jump_terms[row] = given
        total = own[row] + walls + fluid
        if some_fixed:
            total = own[row] + walls
            for k in range(from_, to):
                if unknown[neighbour[k]] < unknowns:
                    total += weights[k]
        neutral[row] = abs(total) <= ROUNDING * (size + abs(own[row]))
        if not np.isfinite(size):
            kinds[row] = NOT_FINITE
        elif not listed:
            kinds[row] = ALONE
        else:
            kinds[row] = FINE if diagonal[row] < 0.0 else WRONG_SIGN


@compiled
def row_sums(starts, shares, sums, seen):  # type: ignore[no-untyped-def]
    """The sum of each wall particle's row, and whether it is not empty."""
    for wall in range(len(sums)):
        total, size = 0.0, 0.0
        for m in range(starts[wall], starts[wall + 1]):
            total += shares[m]
            size += abs(shares[m])
        sums[wall], seen[wall] = total, size != 0.0


@compiled
def pair_moments(  # type: ignore[no-untyped-def]
    begin, end, first, neighbour, weights, unknown, unknowns, starts, columns, shares, positions, periods, step
):
    """As `sphear.pressure.rows.moments`, of rows begin ... end of a pair list."""
    total, rows = 0.0, 0
    for row in range(begin + -begin % step, end, step):
        for k in range(first[row - begin], first[row - begin + 1]):
            number = unknown[neighbour[k]]
            if number < unknowns:
                total += weights[k] * square_distance(positions, row, number, periods)
            elif weights[k] != 0.0:
                for m in range(starts[number - unknowns], starts[number - unknowns + 1]):
                    total += weights[k] * shares[m] * square_distance(positions, row, columns[m], periods)
        rows += 1
    return total, rows
