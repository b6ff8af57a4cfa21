"""The card of a viscous term: its formula and source, and what was measured of it."""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from sphear.engine.structure import made_of
from sphear.words import in_words

if TYPE_CHECKING:
    from collections.abc import Mapping

    from sphear.viscosity.base import ViscousTerm


_UNSTATED = "not stated"


@lru_cache
def measured() -> dict[str, Any]:
    """Properties that `validation/measure_cards.py` has measured, by the term's name."""
    facts: dict[str, Any] = json.loads((Path(__file__).parent / "measured.json").read_text(encoding="utf-8"))
    return facts


@dataclass(frozen=True)
class Card:
    """The formula, source and properties of a viscous term, without corrections and with equal volumes, in 2-D."""

    name: str
    setting: str
    aliases: tuple[str, ...]
    formula: str
    source: str
    acts_on: str
    where_it_varies: str
    correction: str
    properties: dict[str, Any]
    summary: str = ""

    def as_dict(self) -> dict[str, Any]:
        """The card's facts by name."""
        return {
            "setting": self.setting,
            **({"summary": self.summary} if self.summary else {}),
            "formula": self.formula,
            "source": self.source,
            "acts_on": self.acts_on,
            "where_viscosity_varies": self.where_it_varies,
            "correction": self.correction,
            **self.properties,
        }

    def with_properties(self, properties: Mapping[str, Any]) -> Card:
        """The same card with what was measured, by name."""
        return replace(self, properties=dict(properties))

    def text(self) -> str:
        """The card as lines of text."""
        lines = [
            self.setting,
            *([f"  in words         {self.summary}"] if self.summary else []),
            f"  formula          {'' if self.formula == _UNSTATED else 'du/dt = '}{self.formula}",
            f"  source           {self.source}",
            f"  aliases          {', '.join(self.aliases) or 'none'}",
            f"  acts on          {self.acts_on}",
            f"  where mu varies  {self.where_it_varies}",
            f"  corrections      {self.correction}",
        ]
        if self.properties:
            lines += self._measured_lines()
        return "\n".join(lines)

    def _measured_lines(self) -> list[str]:
        facts = self.properties

        def held(name: str) -> str:
            return "yes" if facts[name] else "no"

        lines = [
            f"  order, lattice   {facts['order_lattice']:+.1f}   (of the L1 error in dx, h fixed in dx)",
            f"  order, jittered  {facts['order_jittered']:+.1f}   (jitter 0.3 dx)",
            f"  conserves        linear momentum: {held('linear_momentum')}, angular momentum:"
            f" {held('angular_momentum')}; only dissipates: {held('dissipative')}",
        ]
        if "cost" in facts:
            lines.append(f"  cost per pair    {facts['cost']:.1f}   (morris = 1)")
        return lines


def _where_it_varies(term: ViscousTerm) -> str:
    """The limit of a term where the viscosity varies."""
    from sphear.viscosity.varying import MeanViscosity, takes_mean

    if term.varies_viscosity:
        return term.where_it_varies or "as its formula says"
    if takes_mean(term):
        return f"{MeanViscosity.where_it_varies}, by (mu_i + mu_j) / 2 for mu_i"
    return "refused"


def _own_words(kind: type) -> str:
    """The first line of the docstring of a user's class; nothing for the package's own, whose formula says it."""
    return "" if kind.__module__.startswith("sphear.") else in_words(kind)


def card(term: ViscousTerm | None, name: str | None = None) -> Card:
    """The card of a term; of the named one where none is given.

    Measured properties are shown for the settings that they were measured with, those that have a name.
    """
    from sphear.viscosity import VISCOSITY

    if term is None:
        assert name is not None
        term = VISCOSITY[name]
    known = next((key for key in VISCOSITY if VISCOSITY[key] == term), None)
    return Card(
        name=known or term.name,
        setting=made_of(term),
        aliases=tuple(VISCOSITY.aliases(known)) if known else (),
        formula=term.formula,
        source=term.source,
        acts_on="velocities" if term.radial else "velocities, and scalar fields as the Laplacian of each component",
        where_it_varies=_where_it_varies(term),
        correction="its own; takes no other" if term.own_correction else "none, shepard, bonet_lok, renormalised",
        properties=measured().get(known, {}) if known else {},
        summary=_own_words(type(term)),
    )
