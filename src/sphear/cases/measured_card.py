"""A viscous term measured: the order of its Laplacian, and what it conserves, beside its card."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from sphear.cases.conservation import conservation
from sphear.cases.patch_test import PatchTest
from sphear.errors import SphearError, quoted
from sphear.operators import arguments
from sphear.progress import no_progress
from sphear.viscosity import ViscousTerm
from sphear.viscosity.card import Card, card

LATTICE, JITTERED = (160, 320), (80, 160)  # particles a side, from which to which the order is taken
JITTER = 0.3
SEEDS = 8


@dataclass(frozen=True, repr=False)
class MeasuredCard:
    """The card of a viscous term with what was measured of it just now; printed, it is the card.

    Attributes:
        card: formula, source and aliases of the term.
        order_lattice: of the L1 error of its Laplacian in dx, with h fixed in dx, on a lattice.
        order_jittered: the same on particles jittered by 0.3 dx, mean of 8 seeds.
        linear_momentum: it is conserved to rounding.
        angular_momentum: it is conserved to rounding.
        dissipative: no velocity gains energy.

    Examples:
        >>> import sphear
        >>> found = sphear.measured_card("violeau")
        >>> round(found.order_jittered), found.angular_momentum, found.dissipative
        (-1, True, True)
    """

    card: Card
    order_lattice: float
    order_jittered: float
    linear_momentum: bool
    angular_momentum: bool
    dissipative: bool

    def as_dict(self) -> dict[str, Any]:
        """The measured numbers by name."""
        return {name: value for name, value in vars(self).items() if name != "card"}

    def text(self) -> str:
        """The card as lines of text."""
        return self.card.with_properties(self.as_dict()).text()

    def __repr__(self) -> str:
        """The card as lines of text."""
        return self.text()


def measured_card(term: str | ViscousTerm, progress: Callable[[str], None] = no_progress) -> MeasuredCard:
    """Measure a viscous term: the order of its Laplacian on a lattice and on disordered particles, what it conserves.

    Orders are of the L1 error of the Laplacian of sin(2 pi x) sin(2 pi y), or for a force along the line of centres of
    the velocity with that stream function: on a lattice from 160 to 320 particles a side, and jittered from 80 to 160.
    Momentum is conserved where it changes by rounding alone over isolated clusters of jittered particles with random
    velocities. All is without a correction, with equal volumes and in two dimensions, as on the cards of the
    package's own terms; it takes a few seconds.

    Args:
        term: a name, an alias or an object.
        progress: is told what is being measured.

    Returns:
        A card that prints as text and has the measured numbers as attributes.

    Raises:
        SphearError: there is no such term, or its sums cannot be computed.

    Examples:
        >>> import sphear
        >>> found = sphear.measured_card(sphear.Morris())
        >>> found.linear_momentum, found.angular_momentum, found.dissipative
        (True, False, True)
    """
    if not isinstance(term, str | ViscousTerm):
        raise SphearError(f"measured_card takes the name of a viscous term or an object, not {quoted(term)}")
    chosen = arguments.read_viscosity(term)
    progress("order on a lattice")
    lattice = _order(chosen, LATTICE, 0.0)
    progress("order on jittered particles")
    jittered = _order(chosen, JITTERED, JITTER)
    progress("conservation")
    return MeasuredCard(card(chosen), lattice, jittered, **conservation(chosen).kept())


def _order(term: ViscousTerm, sizes: tuple[int, int], jitter: float) -> float:
    """The order of the L1 error between two sizes."""
    test = PatchTest(viscosity=(term,), sizes=sizes, field="sine", velocity=term.radial, jitter=jitter, seeds=SEEDS)
    order = test.rows()[-1]["order"]
    return math.nan if order is None else round(float(order), 2)
