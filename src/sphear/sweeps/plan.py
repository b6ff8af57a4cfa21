"""What a sweep computes: runs, each a case with its settings, all checked before the first one starts."""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from typing import TYPE_CHECKING, Any

from sphear.errors import SphearError
from sphear.sweeps.objects import sent

if TYPE_CHECKING:  # sphear.cases.flow imports Numba, which a worker must not meet before it is set up
    from sphear.schemes.base import Settings

UNTIL_STEADY = 20.0  # time units, the guess where the case says when a run is over
LONGEST = 160  # letters of a file's name beside its hash
IMMATERIAL = ("force", "threads")  # settings that do not change what a run finds


@dataclass(frozen=True)
class Run:
    """A case and all its settings; names are the registered ones, whatever alias was given.

    Attributes:
        case: name of a flow.
        settings: of the flow, resolved.
    """

    case: str
    settings: Settings

    def __post_init__(self) -> None:
        from sphear.cases.flow import FLOWS
        from sphear.schemes.named import named

        object.__setattr__(self, "case", FLOWS.name(self.case))
        object.__setattr__(self, "settings", named(self.settings))

    @cached_property
    def given(self) -> dict[str, Any]:
        """The settings as JSON has them."""
        return self.settings.model_dump(mode="json")

    @cached_property
    def sent(self) -> dict[str, Any]:
        """The settings as a worker gets them, objects included."""
        return sent(dict(self.settings))

    @cached_property
    def key(self) -> str:
        """What the run is stored under: a few settings to read, and a hash of all that changes its result.

        Settings at their general default are left out of it, so that a new setting leaves old results valid.
        """
        usual = type(self.settings)().model_dump(mode="json")
        matter = {name: value for name, value in self.given.items() if name not in IMMATERIAL and value != usual[name]}
        digest = hashlib.sha256(json.dumps([self.case, matter], sort_keys=True).encode()).hexdigest()[:16]
        chosen = self.settings
        viscosity, correction = self.given["viscosity"], self.given["correction"]
        scheme = "" if chosen.scheme == "explicit" else f"{chosen.scheme}-"
        readable = f"{self.case}-{scheme}{viscosity}-{correction}-re{chosen.reynolds:g}-n{chosen.resolution}"
        return f"{re.sub(r'[^A-Za-z0-9.+_-]', '_', readable)[:LONGEST]}-{digest}"

    @cached_property
    def cost(self) -> float:
        """Particles times steps, to be compared with that of other runs; a run that ends by itself is a guess.

        Raises:
            SphearError: the settings do not go together.
        """
        from sphear.cases.flow import FLOWS, FlowRun

        # relaxed particles take long to make, and are as many as those of a lattice
        quick = {"initial": "lattice"} if self.given.get("initial") == "relaxed" else {}
        run = FlowRun(FLOWS[self.case], self.settings.model_copy(update=quick))
        until = self.settings.until or UNTIL_STEADY
        return len(run.flow.positions) * min(until * run.unit / run.flow.time_step, self.settings.max_steps)


def plan(case: str, over: Mapping[str, Sequence[Any]], fixed: Mapping[str, Any] | None = None) -> list[Run]:
    """All combinations of values for some settings, on top of fixed ones; a run that comes up again is left out.

    Args:
        case: name of a flow.
        over: values by setting; the last setting changes fastest.
        fixed: settings that differ from the defaults of the case.

    Raises:
        SphearError: a setting is unknown, wrong, without values, both fixed and gone through, or does not go with
            the others.
    """
    from sphear.cases.flow import FLOWS
    from sphear.cases.flow.chosen import flow_settings

    fixed = fixed or {}
    for key, values in over.items():
        if key in fixed:
            raise SphearError(f"the setting {key} is both fixed and swept over: choose one")
        if isinstance(values, str) or not len(values):
            raise SphearError(f"the setting {key} needs a list of at least one value to sweep over")
    chosen = FLOWS[case]
    runs: dict[str, Run] = {}
    for values in product(*over.values()):
        run = Run(chosen.name, flow_settings(chosen, {**fixed, **dict(zip(over, values, strict=True))}))
        if run.key not in runs:
            runs[run.key] = run
            _ = run.cost  # refuses settings that do not go together
    return list(runs.values())
