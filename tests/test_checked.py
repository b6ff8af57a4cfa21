"""Wrong settings in one sentence."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from pydantic import BaseModel, Field, model_validator

import sphear
from sphear.checked import checked
from sphear.errors import SphearError


class Settings(BaseModel):
    """One that may be wrong, and one that may contradict it."""

    step_size: float = Field(default=1.0, gt=0)
    steps: int = 1

    @model_validator(mode="after")
    def _consistent(self) -> Settings:
        if self.steps * self.step_size > 10:
            raise SphearError("steps and step_size go too far: take fewer")
        return self


def test_the_first_wrong_setting() -> None:
    with pytest.raises(SphearError, match=r"^step-size should be greater than 0, not -1$"), checked():
        Settings(step_size=-1)
    with pytest.raises(SphearError, match=r"^the setting step_size should be"), checked("the setting "):
        Settings(step_size=-1)


def test_settings_that_contradict_each_other_are_told_in_the_words_of_the_model() -> None:
    with pytest.raises(SphearError, match=r"^steps and step_size go too far: take fewer$"), checked():
        Settings(steps=100)


def test_what_is_right_passes() -> None:
    with checked():
        assert Settings(steps=2).steps == 2


@pytest.mark.parametrize("wrong", ["a", b"1", True, float("nan"), float("inf"), 10**400, -1.0, [1.0, 2.0]], ids=str)
@pytest.mark.parametrize(
    "made",
    [
        lambda x: sphear.Morris(eta=x),
        lambda x: sphear.Cleary(xi=x),
        lambda x: sphear.Monaghan(alpha=x),
        lambda x: sphear.Linear(x, 1.0),
        lambda x: sphear.IdealGas(gamma=x),
        lambda x: sphear.WendlandC2(x),
    ],
    ids=["eta", "xi", "alpha", "rho0", "gamma", "h"],
)
def test_numbers_of_formulas_are_checked_whatever_is_given(made: Callable[[Any], object], wrong: object) -> None:
    with pytest.raises(sphear.SphearError, match="must be"):
        made(wrong)
