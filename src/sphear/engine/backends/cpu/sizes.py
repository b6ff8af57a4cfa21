"""The numbers that all stages share: how many rows arrays have, and what a stage has to tell."""

from __future__ import annotations

# places in the array of sizes
DIMENSION = 0
FLUID = 1  # particles of the fluid
PARTICLES = 2  # and of walls
ENTRIES = 3  # and images
ENTRY_ROOM = 4  # entries that arrays have room for
LISTED = 5  # rows of the pair list
PARTS = 6  # of it, each for one thread
SHARE = 7  # rows of a part at most, and one
PAIR_ROOM = 8  # pairs that a part has room for
CELLS = 9  # of the cell sort
CELL_ROOM = 10  # cells that arrays have room for
OFFSETS = 11  # to the rows of cells within reach of a cell
WORST = 12  # the particle that a step failed at
WANTED = 13  # rows that an array should have had room for
COUNT = 14

# what a stage says, besides 0 and the causes of a failure: it is called again with more room
MORE_ENTRIES, MORE_CELLS, MORE_PAIRS = -1, -2, -3
