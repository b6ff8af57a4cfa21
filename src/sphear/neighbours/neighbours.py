"""Which particles are near which: what every sweep walks over, and the only thing it knows about space."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np

from sphear.engine.threads import on_threads, thread_count
from sphear.errors import SphearError
from sphear.neighbours.cells import CellSort, cell_sort
from sphear.neighbours.domain import Domain
from sphear.neighbours.pair_list import Chunk, build_chunk

Array = np.ndarray[Any, Any]

CHUNK_ROWS = 16384  # of the pair list built and swept at once: its coefficients stay in the cache


class Neighbours:
    """The pairs of particles nearer than the support.

    Particles are summed for in the order of `rows`, which is that of the cells, so that neighbours are near each other
    in memory as well. An *entry* is a particle or one of its periodic images.

    Args:
        positions: (N, d), finite.
        support: the distance within which two particles are neighbours.
        domain: None for open space.
        threads: how many threads build and sweep; None takes all processors for many particles, one for few.
        keep_coincident: list pairs at no distance too (of a point of evaluation and a particle) instead of refusing
            them.

    Attributes:
        coordinates: (d, E + 8), positions of the entries in the order of the cells.
        source: (E,), the particle that each entry is (an image) of.
        entry: (N,), the entry of each row.
        rows: (N,), the particle of each row.
        chunks: the pair list, for ranges of rows.

    Raises:
        SphearError: two particles at the same place.
    """

    def __init__(
        self,
        positions: Array,
        support: float,
        domain: Domain | None = None,
        *,
        threads: int | None = None,
        keep_coincident: bool = False,
    ) -> None:
        self.count, self.dimension = positions.shape
        self.support = float(support)
        self.threads = thread_count(threads, self.count)
        entries, source = domain.with_images(positions, self.support) if domain else (positions, None)
        cells = cell_sort(np.ascontiguousarray(entries, np.float64), self.support)
        self.coordinates = cells.coordinates
        self.source = cells.order if source is None else source[cells.order]
        # the particles themselves come before their images in `entries`
        self.entry = (
            np.arange(self.count, dtype=np.int32)
            if source is None
            else np.flatnonzero(cells.order < self.count).astype(np.int32)
        )
        self.rows = self.source[self.entry]
        self.chunks = self._chunks(cells, keep_coincident)

    @property
    def pairs(self) -> int:
        """The number of pairs, each counted from both of its particles."""
        return sum(chunk.pairs for chunk in self.chunks)

    def particles(self, chunk: Chunk) -> Array:
        """The particle of each row of a chunk, (rows of the chunk,)."""
        return self.rows[chunk.begin : chunk.end]

    def _chunks(self, cells: CellSort, keep_coincident: bool) -> list[Chunk]:
        parts = max(self.threads, -(-self.count // CHUNK_ROWS))
        bounds = np.linspace(0, self.count, parts + 1).astype(int).tolist()
        ranges = [(begin, end) for begin, end in pairwise(bounds) if begin < end]

        def build(rows: tuple[int, int]) -> tuple[Chunk, int]:
            return build_chunk(cells, self.entry, *rows, self.support, keep_coincident)

        built = on_threads(build, ranges, self.threads)
        for chunk, coincident in built:
            if coincident and not keep_coincident:
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
