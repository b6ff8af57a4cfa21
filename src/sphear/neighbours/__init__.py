"""Neighbours: domain, periodic images, cell sort and pair list. Nothing outside this folder knows about cells."""

from sphear.neighbours.domain import Domain
from sphear.neighbours.neighbours import Neighbours
from sphear.neighbours.pair_list import Chunk

__all__ = ["Chunk", "Domain", "Neighbours"]
