"""The particles around points, by one sort of the particles."""

from __future__ import annotations

import numpy as np
import pytest

from sphear.neighbours import Domain, Neighbours
from sphear.neighbours.points import PointNeighbours, sorted_particles

SUPPORT = 0.2


@pytest.mark.parametrize("support", [SUPPORT, 0.6 * SUPPORT])
@pytest.mark.parametrize("periodic", [(False, False), (True, False), (True, True)])
def test_each_point_has_the_particles_around_it(periodic: tuple[bool, bool], support: float) -> None:
    rng = np.random.default_rng(3)
    particles, points = rng.random((150, 2)), 1.2 * rng.random((60, 2)) - 0.1
    domain = Domain((0.0, 0.0), (1.0, 1.0), periodic)
    inside = domain.wrapped(points)
    neighbours = PointNeighbours(inside, sorted_particles(particles, SUPPORT, domain), support)
    for begin, end in ((0, 60), (17, 41)):
        chunk = neighbours.listed(begin, end)
        for row in range(end - begin):
            entries = chunk.neighbour[chunk.first[row] : chunk.first[row + 1]]
            apart = np.hypot(*domain.shortest(particles - inside[begin + row]).T)
            np.testing.assert_array_equal(np.sort(neighbours.source[entries]), np.flatnonzero(apart < support))


@pytest.mark.parametrize("coincident", [True, False])
def test_a_particle_at_a_point(coincident: bool) -> None:
    particles = np.array([(0.5, 0.5), (0.6, 0.5)])
    around = sorted_particles(particles, SUPPORT, None)
    chunk = PointNeighbours(particles[:1], around, SUPPORT, coincident).listed(0, 1)
    assert chunk.pairs == (2 if coincident else 1)


@pytest.mark.parametrize("threads", [1, 2])
def test_some_particles_have_the_same_neighbours_as_among_all(threads: int) -> None:
    particles = np.random.default_rng(5).random((300, 2))
    domain = Domain((0.0, 0.0), (1.0, 1.0), (True, False))
    whole = Neighbours(particles, SUPPORT, domain, threads=threads)

    def listed(neighbours: Neighbours) -> dict[int, list[int]]:
        return {
            int(row): chunk.neighbour[chunk.first[k] : chunk.first[k + 1]].tolist()
            for chunk in neighbours.chunks
            for k, row in enumerate(neighbours.particles(chunk))
        }

    chosen = particles[:, 0] < 0.1
    everything, some = listed(whole), listed(whole.of(chosen))
    assert some == {row: entries for row, entries in everything.items() if chosen[row]}
    assert whole.of(np.zeros(300, bool)).chunks == []
    assert listed(whole) == everything
