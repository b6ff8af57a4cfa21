"""Points that stay where they are, and the particles around them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from sphear.neighbours.cell_sort import CellSort, cell_sort
from sphear.neighbours.cells import PADDING, point_cells
from sphear.neighbours.domain import Domain
from sphear.neighbours.neighbours import Neighbours
from sphear.neighbours.pair_list import Chunk, build_chunk, list_capacity

Array = np.ndarray[Any, Any]


@dataclass(frozen=True)
class SortedParticles:
    """Particles sorted once, for the neighbours of any points.

    Attributes:
        positions: (E, d), of the particles and their periodic images.
        cells: the same, sorted.
        source: (E,), the particle that each sorted one is, or is an image of.
        count: the number of particles.
        support: the largest that neighbours can be asked for.
    """

    positions: Array
    cells: CellSort
    source: Array
    count: int
    support: float


def sorted_particles(positions: Array, support: float, domain: Domain | None) -> SortedParticles:
    """Sort particles at positions (N, d), with their images in the periods of a domain, for supports up to one."""
    entries, source = domain.with_images(positions, support) if domain else (positions, None)
    entries = np.ascontiguousarray(entries, np.float64)
    cells = cell_sort(entries, support)
    listed = cells.order if source is None else source[cells.order]
    return SortedParticles(entries, cells, listed, len(positions), support)


class PointNeighbours(Neighbours):
    """The particles nearer to each point than the support; the points themselves are nobody's neighbours.

    Rows are the points in their own order, which ought to lie along curves, so that those beside each other are near
    each other in memory. The fields of a sweep hold the particles' values first and the points' after them.

    Args:
        points: (M, d), in the box of a periodic domain.
        around: the particles.
        support: the distance within which they are neighbours, at most that which they are sorted for.
        coincident: list particles at the place of a point too.
    """

    def __init__(self, points: Array, around: SortedParticles, support: float, coincident: bool = True) -> None:
        held = len(around.source)
        self.count, self.dimension = points.shape
        self.support, self.threads, self._keep_coincident = support, 1, coincident
        cell = point_cells(points, around.positions, around.support)
        places = np.full((self.dimension, held + self.count + PADDING), np.inf)
        places[:, :held], places[:, held:-PADDING] = around.cells.coordinates[:, :held], points.T
        self._cells = replace(around.cells, coordinates=places, cell=np.concatenate((around.cells.cell, cell)))
        self.coordinates = places
        self.rows = np.arange(self.count, dtype=np.int32)
        numbers = np.arange(around.count, around.count + self.count, dtype=np.int32)
        self.source = np.concatenate((around.source, numbers))
        self.entry = np.arange(held, held + self.count, dtype=np.int32)
        self._image = np.zeros(len(self.source) + PADDING, np.bool_)

    def listed(self, begin: int, end: int) -> Chunk:
        """The particles around the points begin ... end; several ranges may be listed at the same time."""
        size, most = list_capacity(self._cells, end - begin, once=False)
        chunk, _ = build_chunk(
            self._cells, self._image, self.entry, begin, end, self.support, np.empty(size, np.int32), most,
            keep_coincident=self._keep_coincident,
        )  # fmt: skip
        return chunk
