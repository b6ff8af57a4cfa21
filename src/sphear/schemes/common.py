"""Choices that all schemes have, and those of a run."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any, ClassVar, Literal

from pydantic import BaseModel, ConfigDict, Field, field_validator

from sphear.checked import checked
from sphear.errors import SphearError
from sphear.names import unknown
from sphear.schemes.flat_settings import FlatSetting, flattened
from sphear.schemes.objects import text

LEAST_REYNOLDS, LARGEST_REYNOLDS = 1e-100, 1e100  # beyond, squares vanish or overflow
OPEN = "no walls"
RENAMED = {  # since 0.1
    "neumann": "called walls",
    "wall_velocity": "called continuation",
    "slip": "called wall_divergence, slipping for true and continued for false",
}


def missing(key: str, valid: Iterable[str]) -> SphearError:
    """The error for a setting that there is none of: it has another name since 0.1, or nobody has it."""
    if key in RENAMED:
        return SphearError(f"the setting {key} of 0.1 is {RENAMED[key]}")
    return unknown("setting", key, valid)


class Choices(BaseModel):
    """Named choices, each checked: an unknown or wrong one is told in one sentence.

    Raises:
        SphearError: a choice is unknown or wrong.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    flat: ClassVar[Mapping[str, FlatSetting]] = {}  # choices that may be objects, with the flat ones

    def __init__(self, **choices: Any) -> None:
        choices = self.flattened(choices)
        valid = type(self).model_fields
        for key in choices:
            if key not in valid:
                raise missing(key, valid)
        with checked("the setting "):
            super().__init__(**choices)

    @classmethod
    def flattened(cls, given: Mapping[str, Any]) -> dict[str, Any]:
        """Choices with the objects among them said by flat settings, where they can be.

        Raises:
            SphearError: an object and a flat setting contradict each other.
        """
        return flattened(given, cls.flat)


class Scheme(Choices):
    """The numerics that all schemes have.

    Attributes:
        time_step: None takes the least of the limits.
        force: take a time step beyond its limit all the same.
        threads: that a run computes on; None takes all processors for large flows, one for small.
        seed: of all that is random: disorder of the start, unevenness on lines that are stretched.

    Raises:
        SphearError: a choice is unknown or wrong.
    """

    time_step: float | None = Field(default=None, gt=0, allow_inf_nan=False)
    force: bool = False
    threads: int | None = Field(default=None, ge=1)
    seed: int = Field(default=0, ge=0)

    def __str__(self) -> str:
        """The scheme with what differs from its defaults, as it is written in a program."""
        usual = self._usual()
        changed = {name: value for name, value in self if value != usual[name]}
        written = [
            f"{name}={value!r}" if isinstance(value, str) else f"{name}={text(value)}"
            for name, value in changed.items()
        ]
        return f"{type(self).__name__}({', '.join(written)})"

    def _usual(self) -> dict[str, Any]:
        """The defaults, as they are beside these choices."""
        return {name: field.default for name, field in type(self).model_fields.items()} | self._beside()

    def without_effect(self, walled: bool) -> list[str]:
        """A sentence for each choice, not as usual, that changes nothing beside the other settings.

        Args:
            walled: whether the flow has walls.
        """
        usual = self._usual()
        unusual = {name for name in self.model_fields_set if getattr(self, name) != usual[name]}
        return [
            f"{name} has no effect with {beside}"
            for name, (beside, without) in self._idle(walled).items()
            if without and name in unusual
        ]

    def accurate_step(self, duration: float) -> float:
        """The longest time step that resolves a run of a duration, where stability does not limit it."""
        return math.inf

    def unmark(self, names: Iterable[str]) -> None:
        """Settings that came along with others: nobody is told that one of them has no effect."""
        self.__pydantic_fields_set__ -= set(names)

    def _object(self, key: str) -> Any:
        """The object that a setting and its flat ones choose."""
        setting = self.flat[key]
        flat = {name: getattr(self, name) for name in setting.fields.values()}
        return setting.with_flat(getattr(self, key), flat)

    def _settle(self) -> None:
        """Give what nobody named the value that goes with the others."""
        for name in self._beside():
            if name not in self.model_fields_set:
                object.__setattr__(self, name, self._beside()[name])  # beside those that are settled

    def _beside(self) -> dict[str, Any]:
        """The defaults that depend on other settings, as they are beside these; each on what comes before it."""
        return {}

    def _idle(self, walled: bool) -> dict[str, tuple[str, bool]]:
        """The setting beside which another has no effect, and whether it is so."""
        return {}


class RunSettings(Choices):
    """The start of a case and the end of its run.

    Attributes:
        initial: "lattice", "staggered" (every other row by half a spacing) or "relaxed" (disordered, then settled).
        reynolds: as the case defines it.
        resolution: particles across the flow.
        until: when to stop, in the time unit of the case; None where the case says.
        max_steps: stop after so many steps.
        solid: walls of your own: "none", or a shape in the fluid that is no fluid, as in "Circle((0.3, 0.5), 0.1)", see
            `sphear.boundaries.shapes.written`. A case around one is compared with no reference.

    Raises:
        SphearError: a setting is unknown or wrong.
    """

    initial: Literal["lattice", "staggered", "relaxed"] = "lattice"
    reynolds: float = Field(default=1.0, gt=0, allow_inf_nan=False)
    resolution: int = Field(default=20, ge=1)
    until: float | None = Field(default=None, gt=0, allow_inf_nan=False)
    max_steps: int = Field(default=500_000, ge=1)
    solid: str = "none"

    @field_validator("reynolds", mode="after")
    @classmethod
    def _within_range(cls, reynolds: float) -> float:
        if not LEAST_REYNOLDS <= reynolds <= LARGEST_REYNOLDS:
            raise SphearError(
                f"the setting reynolds should be from {LEAST_REYNOLDS:g} to {LARGEST_REYNOLDS:g}, not {reynolds:g}"
            )
        return reynolds

    @field_validator("solid", mode="after")
    @classmethod
    def _is_a_shape(cls, solid: str) -> str:
        if solid != "none":
            from sphear.boundaries.shapes import written

            written(solid)
        return solid
