"""One flow in the cavity, from one source."""

from __future__ import annotations

from dataclasses import dataclass

from sphear.references.cavity.curve import Curve


@dataclass(frozen=True, eq=False)
class CavityFlow:
    """One flow in the cavity, from one source.

    reynolds: the Reynolds number of lid speed and side.
    source: where the numbers come from.
    time: the time of the profiles; infinite for a steady flow.
    u: the velocity along x on the line x = 1/2, a function of y.
    v: the velocity along y on the line y = 1/2, a function of x.
    energy: the kinetic energy, a function of time from the start on; None where the source has none.
    """

    reynolds: int
    source: str
    time: float
    u: Curve
    v: Curve
    energy: Curve | None = None
