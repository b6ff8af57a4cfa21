"""The neighbours of particles: all that a sweep walks over, and the only thing it knows about space."""

from __future__ import annotations

from copy import copy
from dataclasses import replace
from functools import cached_property
from typing import Any

import numpy as np

from sphear.engine.threads import on_threads, ranges, thread_count
from sphear.errors import SphearError
from sphear.neighbours.cell_sort import cell_sort
from sphear.neighbours.cells import PADDING, REACH, point_cells
from sphear.neighbours.domain import Domain
from sphear.neighbours.limits import refuse_pairs
from sphear.neighbours.pair_list import Chunk, build_chunk, list_capacity
from sphear.reading import real_numbers

Array = np.ndarray[Any, Any]

SMALLEST, LARGEST = 1e-100, 1e100  # of a support: its fifth power is taken, of volumes and derivatives in other units
CHUNK_ROWS = 16384  # of the pair list built and swept at once: its coefficients stay in the cache


class Neighbours:
    """The pairs of particles nearer than the support.

    Particles are summed for in the order of `rows`, which is that of the cells, so that neighbours are near each other
    in memory as well. An *entry* is a particle or one of its periodic images.

    Args:
        positions: (N, d) or more, finite.
        support: the distance within which two particles are neighbours.
        domain: None for open space.
        threads: how many threads build and sweep; None takes all processors for many particles, one for few.
        each_pair_once: make the list of pairs listed once, instead of the full one.
        keep_coincident: list pairs at no distance too (of a point of evaluation and a particle) instead of refusing
            them.
        rows: sums are made for the first so many particles; the others are their neighbours only. None is all.
        at: (M, d), points that sums are made for instead of the particles; they are nobody's neighbours.

    Attributes:
        coordinates: (d, E + 8), positions of the entries in the order of the cells.
        source: (E,), the particle that each entry is (an image) of.
        count: N, of the particles that sums are made for.
        entry: (N,), the entry of each row.
        rows: (N,), the particle of each row.
        chunks: all neighbours of each row, for ranges of rows.
        chunks_once: each pair once; of the two lists, one is made at once and the other when first asked for.

    Raises:
        SphearError: two particles at the same place; more images or pairs than memory holds; a support for which
            floating point has no squares.

    Examples:
        >>> import numpy as np
        >>> import sphear
        >>> positions = np.argwhere(np.ones((20, 20))) / 20  # a lattice, 0.05 apart
        >>> domain = sphear.Domain((0, 0), (1, 1))
        >>> sphear.Neighbours(positions, support=0.06, domain=domain).pairs / 400  # neighbours of each
        4.0
    """

    def __init__(
        self,
        positions: Array,
        support: float,
        domain: Domain | None = None,
        *,
        threads: int | None = None,
        each_pair_once: bool = False,
        keep_coincident: bool = False,
        rows: int | None = None,
        at: Array | None = None,
    ) -> None:
        positions = real_numbers(positions, "positions")
        self.dimension = positions.shape[1]
        self.count = len(at) if at is not None else len(positions) if rows is None else rows
        self.support = float(support)
        if not SMALLEST <= self.support <= LARGEST:
            raise SphearError(f"the support must be between {SMALLEST:g} and {LARGEST:g}, not {self.support:.3g}")
        self.threads = thread_count(threads, self.count)
        entries, source = domain.with_images(positions, self.support) if domain else (positions, None)
        self._keep_coincident = keep_coincident or at is not None
        entries = np.ascontiguousarray(entries, np.float64)
        self._cells = cells = cell_sort(entries, self.support, self.threads)
        self.coordinates = cells.coordinates
        self.source = cells.order if source is None else source[cells.order]
        self._image = np.zeros(len(cells.order) + PADDING, np.bool_)
        if len(cells.order) > self.count:  # particles summed for come first, and images last in `entries`
            self._image[: len(cells.order)] = cells.order >= self.count
        self.entry = np.flatnonzero(~self._image[: len(cells.order)]).astype(np.int32)
        self.rows = self.source[self.entry]
        if at is not None:
            self._put_points(domain.wrapped(at) if domain else at, entries)
        _ = self.chunks_once if each_pair_once else self.chunks

    def _put_points(self, points: Array, entries: Array) -> None:
        """Append the points to the entries, in the order of their cells, as the rows; no cell holds them."""
        cell = point_cells(points, entries, self.support)
        order = np.argsort(cell, kind="stable").astype(np.int32)
        held = len(self.source)
        places = np.full((self.dimension, held + len(points) + PADDING), np.inf)
        places[:, :held], places[:, held:-PADDING] = self.coordinates[:, :held], points[order].T
        self._cells = replace(self._cells, coordinates=places, cell=np.concatenate((self._cells.cell, cell[order])))
        self.coordinates = places
        self.source = np.concatenate((self.source, np.zeros(len(points), np.int32)))  # any: sums do not ask for it
        self._image = np.zeros(len(self.source) + PADDING, np.bool_)
        self.entry = np.arange(held, len(self.source), dtype=np.int32)
        self.rows = order

    def scaled(self, unit: float) -> Neighbours:
        """The same pairs, with lengths in another unit: a power of two, so that nothing is rounded."""
        found = copy(self)
        found.coordinates = self.coordinates / unit
        found.support = self.support / unit
        found._cells = replace(self._cells, coordinates=found.coordinates)
        return found

    def of(self, chosen: Array) -> Neighbours:
        """The same particles, sums being made for some of them only: those that are True in `chosen`, (N,)."""
        found = copy(self)
        rows = np.flatnonzero(chosen[self.rows])
        found.entry, found.rows, found.count = self.entry[rows], self.rows[rows], len(rows)
        for listed in ("chunks", "chunks_once", "alternating"):
            found.__dict__.pop(listed, None)
        return found

    @property
    def alone(self) -> Array:
        """The particles that have no neighbour, in their order."""
        chunks = self.chunks_once if "chunks_once" in self.__dict__ else self.chunks
        lonely = [self.entry[c.begin : c.end][c.first[1:] == c.first[:-1]] for c in chunks]
        found = np.concatenate(lonely) if lonely else np.empty(0, np.int32)
        if len(found) and "chunks_once" in self.__dict__:  # they may be listed as those of others
            listed = np.zeros(len(self.source), np.bool_)
            for chunk in chunks:
                listed[chunk.neighbour[: chunk.pairs]] = True
            found = found[~listed[found]]
        return np.sort(self.source[found]) if len(found) else found

    @cached_property
    def chunks(self) -> list[Chunk]:
        """All neighbours of each row: for sums that depend on what was prepared for the one particle."""
        return self._listed(once=False)

    @cached_property
    def chunks_once(self) -> list[Chunk]:
        """Each pair of particles listed from one side only: half the list, and the sums of both sides in one go."""
        return self._listed(once=True)

    @cached_property
    def alternating(self) -> bool:
        """True if every second chunk of `chunks_once` may be summed at the same time.

        A chunk adds to the sums of its own rows and of entries after them; these must not go beyond the next chunk.
        """
        ends = [*(int(self.entry[chunk.begin]) for chunk in self.chunks_once), len(self.source), len(self.source)]
        reaches = (int(chunk.neighbour[: chunk.pairs].max(initial=0)) for chunk in self.chunks_once)
        return all(reach < end for reach, end in zip(reaches, ends[2:], strict=True))

    @property
    def pairs(self) -> int:
        """The number of pairs, each counted from both of its particles."""
        return sum(chunk.pairs for chunk in self.chunks)

    def particles(self, chunk: Chunk) -> Array:
        """The particle of each row of a chunk, (rows of the chunk,)."""
        return self.rows[chunk.begin : chunk.end]

    def _listed(self, once: bool) -> list[Chunk]:
        refuse_pairs(self._cells.start, self._cells.rows, REACH, len(self._cells.order), self.count, once)
        share = (
            min(2 * self.threads, max(1, self.count)) if self.threads > 1 else 1
        )  # each thread has as many chunks, every second one too
        parts = max(1, share * -(-self.count // (share * CHUNK_ROWS)))
        parts_of_rows = [(begin, end) for begin, end in ranges(self.count, parts) if begin < end]

        # one piece of memory for the lists of all chunks: the system maps and clears smaller ones anew each time
        size, most = list_capacity(self._cells, -(-self.count // parts), once)
        memory = np.empty((len(parts_of_rows), size), np.int32)

        def build(number: int) -> tuple[Chunk, int]:
            return build_chunk(
                self._cells,
                self._image,
                self.entry,
                *parts_of_rows[number],
                self.support,
                memory[number],
                most,
                once=once,
                keep_coincident=self._keep_coincident,
            )

        built = on_threads(build, range(len(parts_of_rows)), self.threads)
        for chunk, coincident in built:
            if coincident and not self._keep_coincident:
                self._refuse_coincident(chunk)
        return [chunk for chunk, _ in built]

    def _refuse_coincident(self, chunk: Chunk) -> None:
        from scipy.spatial import cKDTree

        points = self.coordinates[:, : len(self.source)].T
        entries = self.entry[chunk.begin : chunk.end]
        distances, nearest = map(np.asarray, cKDTree(points).query(points[entries], k=2))
        pair = nearest[np.argmin(distances[:, 1])]  # the particle and the other one, in any order
        a, b = self.source[pair]
        place = ", ".join(f"{x:.6g}" for x in points[pair[0]])
        what = f"particles {min(a, b)} and {max(a, b)} are" if a != b else f"particle {a} and its periodic image are"
        raise SphearError(f"{what} at the same place ({place}): particles must be apart")
