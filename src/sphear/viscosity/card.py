"""The card of a viscous term: its formula and source, and what was measured of it."""

from __future__ import annotations

import dataclasses
import json
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from sphear.viscosity.base import ViscousTerm


@lru_cache
def measured() -> dict[str, Any]:
    """What `validation/measure_cards.py` has measured, by the term's name."""
    facts: dict[str, Any] = json.loads((Path(__file__).parent / "measured.json").read_text(encoding="utf-8"))
    return facts


@dataclass(frozen=True)
class Card:
    """What is known of a viscous term. Properties without corrections and with equal volumes, in 2-D."""

    name: str
    setting: str
    aliases: tuple[str, ...]
    formula: str
    source: str
    acts_on: str
    correction: str
    properties: dict[str, Any]

    def as_dict(self) -> dict[str, Any]:
        """The card's facts by name."""
        return {
            "setting": self.setting,
            "formula": self.formula,
            "source": self.source,
            "acts_on": self.acts_on,
            "correction": self.correction,
            **self.properties,
        }

    def text(self) -> str:
        """The card as lines of text."""
        lines = [
            self.setting,
            f"  formula          du/dt = {self.formula}",
            f"  source           {self.source}",
            f"  aliases          {', '.join(self.aliases) or 'none'}",
            f"  acts on          {self.acts_on}",
            f"  corrections      {self.correction}",
        ]
        if self.properties:
            lines += self._measured_lines()
        return "\n".join(lines)

    def _measured_lines(self) -> list[str]:
        facts = self.properties

        def held(name: str) -> str:
            return "yes" if facts[name] else "no"

        return [
            f"  order, lattice   {facts['order_lattice']:+.1f}   (of the L1 error in dx, h fixed in dx)",
            f"  order, jittered  {facts['order_jittered']:+.1f}   (jitter 0.3 dx)",
            f"  conserves        linear momentum: {held('linear_momentum')}, angular momentum:"
            f" {held('angular_momentum')}; only dissipates: {held('dissipative')}",
            f"  cost per pair    {facts['cost']:.1f}   (morris = 1)",
        ]


def card(term: ViscousTerm | None, name: str | None = None) -> Card:
    """The card of a term; of the named one where none is given.

    Measured properties are shown for the settings that they were measured with, those that have a name.
    """
    from sphear.viscosity import VISCOSITY

    if term is None:
        assert name is not None
        term = VISCOSITY[name]
    known = next((key for key in VISCOSITY if VISCOSITY[key] == term), None)
    fields = ", ".join(f"{field.name}={getattr(term, field.name)!r}" for field in dataclasses.fields(term))
    return Card(
        name=known or term.name,
        setting=f"{type(term).__name__}({fields})",
        aliases=tuple(VISCOSITY.aliases(known or term.name)),
        formula=term.formula,
        source=term.source,
        acts_on="velocities" if term.radial else "velocities, and scalar fields as the Laplacian of each component",
        correction="its own; takes no other" if term.own_correction else "none, shepard, bonet_lok, renormalised",
        properties=measured().get(known, {}) if known else {},
    )


def page() -> str:
    """The cards of all terms as a page of the documentation, docs/viscosity.md."""
    from sphear.viscosity import VISCOSITY

    facts = measured()
    table = ["| term | order, lattice | order, jittered | linear momentum | angular momentum | only dissipates | cost |"]
    table.append("|---|---|---|---|---|---|---|")
    for name in VISCOSITY:
        one = facts[name]
        held = ["yes" if one[key] else "no" for key in ("linear_momentum", "angular_momentum", "dissipative")]
        orders = [f"{one[key]:+.1f}" for key in ("order_lattice", "order_jittered")]
        table.append(f"| `{name}` | {' | '.join((*orders, *held))} | {one['cost']:.1f} |")
    cards = [f"## {name}\n\n```\n{card(None, name).text()}\n```\n" for name in VISCOSITY]
    return "\n".join((_INTRODUCTION, *table, "", *cards))


_INTRODUCTION = """# Viscous terms

What every term computes, where it comes from, and what was measured of it (`python validation/measure_cards.py` writes
this page; a test compares it). All without a correction and with equal volumes, in two dimensions:

- **order**: of the L1 error of the Laplacian of sin(2 pi x) sin(2 pi y) in dx, with h fixed in dx (cubic spline, support
  3.14 dx), on a lattice from 160 to 320 particles a side, and on particles jittered by 0.3 dx from 80 to 160, mean of 8
  seeds. Radial terms act on the velocity whose stream function the field is. An order about 0 is an error that stays
  however many particles are taken; about -1, one that doubles when dx is halved. On a lattice, errors that stay are
  small for some terms (0.1 to 2 %).
- **linear and angular momentum**: zero change to rounding over isolated clusters of jittered particles.
- **only dissipates**: no velocity gains energy, the eigenvector that would gain most included.
- **cost**: of one viscous acceleration, preparation included, relative to `morris`.
"""
