"""Fields that are the same of all particles: numbers of an interaction, in place of columns of every record."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from types import SimpleNamespace
from typing import Any

from sphear.engine.formula import Weights


@dataclass(frozen=True)
class UniformField:
    """A field that is the same of all particles.

    Attributes:
        name: under which interactions know it.
        value: a run-time parameter of the code, as floats of formulas are.
    """

    name: str
    value: float


@dataclass(frozen=True)
class WithUniform:
    """An interaction, given fields that are the same of all particles.

    Neighbours then load fewer columns, and what is computed from such fields alone is computed once.
    """

    interaction: Any
    fields: tuple[UniformField, ...]

    def _know(self, particle: Any) -> Any:
        return SimpleNamespace(**vars(particle), **{field.name: field.value for field in self.fields})

    def pair(self, own: Any, other: Any, d: tuple[Any, ...], r2: Any) -> Any:
        """The interaction's own part of a pair."""
        return self.interaction.pair(self._know(own), self._know(other), d, r2)

    def finish(self, own: Any, total: Any) -> Any:
        """The interaction's own result."""
        return self.interaction.finish(self._know(own), total)


class WeightsWithUniform(WithUniform, Weights):
    """The same of an interaction whose weights are kept."""


@lru_cache(maxsize=512)
def with_uniform(interaction: Any, numbers: tuple[tuple[str, float], ...]) -> Any:
    """The interaction, given fields (name, value) that are the same of all particles."""
    if not numbers:
        return interaction
    kind = WeightsWithUniform if isinstance(interaction, Weights) else WithUniform
    return kind(interaction, tuple(UniformField(name, value) for name, value in numbers))
