"""Values of order one: the plane that fits the particles around a point best."""

from __future__ import annotations

from dataclasses import dataclass

from sphear.corrections.base import Correction


@dataclass(frozen=True)
class MovingLeastSquares(Correction):
    """Moving least squares of first order: sum_j V_j W_aj (f_j - c_0 - c . (r_j - r_a))^2 is least, f_a = c_0.

    Values of linear fields are exact. It corrects values only: the derivatives of the other corrections have no part in
    it.
    """

    name = "moving_least_squares"
    aliases = ("mls", "linear")
    formula = "f_a = c_0, sum_b V_b W_ab (f_b - c_0 - c . (r_b - r_a))^2 least"
    source = "Lancaster & Salkauskas 1981; Dilts 1999"
    zeroth_order = True
