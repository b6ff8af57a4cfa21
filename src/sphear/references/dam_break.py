"""The front of a collapsing column of water.

Martin & Moyce 1952, Part IV. An experimental study of the collapse of liquid columns on a rigid horizontal plane,
Phil. Trans. R. Soc. Lond. A 244:312, table 2: a column of the width a = 2.25 inches and twice that height.
"""

from __future__ import annotations

COLUMN = 2.0
"""Height over width of the column, n^2 there."""
TIMES = (0.41, 0.84, 1.19, 1.43, 1.63, 1.83, 1.98, 2.20, 2.32, 2.51, 2.65, 2.83, 2.98, 3.11, 3.33)
"""T = n t sqrt(g / a)."""
FRONTS = (1.11, 1.22, 1.44, 1.67, 1.89, 2.11, 2.33, 2.56, 2.78, 3.00, 3.22, 3.44, 3.67, 3.89, 4.11)
"""Z = z / a, the place of the front."""
