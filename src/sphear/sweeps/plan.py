"""The plan of a sweep: runs, each a case with its settings, all checked before the first one starts."""

from __future__ import annotations

import hashlib
import json
import math
import re
from collections.abc import Callable, Mapping, Sequence, Sized
from dataclasses import dataclass
from functools import cache, cached_property
from itertools import product
from typing import TYPE_CHECKING, Any

from sphear.errors import SphearError, quoted
from sphear.progress import no_progress
from sphear.sweeps.cost import Costs
from sphear.sweeps.objects import sent

if TYPE_CHECKING:  # sphear.cases.flow imports Numba, which a worker must not meet before it is set up
    from sphear.schemes.base import Settings

MOST = 100_000  # runs
TOLD_EVERY = 20  # runs
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
        from sphear.schemes.registered_names import named

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
        """The name that the run is stored under: a few settings to read, and a hash of all that changes its result.

        Settings at their general default are left out of it, so that a new setting leaves old results valid.
        """
        general = usual(type(self.settings))
        matter = {
            name: value for name, value in self.given.items() if name not in IMMATERIAL and value != general[name]
        }
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
        return Costs().of(self.case, self.settings)


@cache
def usual(kind: type[Settings]) -> dict[str, Any]:
    """The general defaults of settings, as JSON has them."""
    return kind().model_dump(mode="json")


def plan(
    case: str,
    over: Mapping[str, Sequence[Any]],
    fixed: Mapping[str, Any] | None = None,
    progress: Callable[[int, int], None] = no_progress,
    *,
    preset: str | None = None,
) -> list[Run]:
    """All combinations of values for some settings, on top of fixed ones; a run that comes up again is left out.

    Args:
        case: name of a flow.
        over: values by setting; the last setting changes fastest.
        fixed: settings that differ from the defaults of the case.
        progress: is told how many runs of how many are planned, now and then.
        preset: the settings of a paper, behind all others.

    Raises:
        SphearError: a setting is unknown, wrong, without values, both fixed and gone through, or does not go with
            the others; there is no such preset; or there are more than `MOST` combinations.

    Examples:
        >>> import sphear
        >>> over = {"viscosity": ["morris", "oger"], "reynolds": [100, 400]}
        >>> runs = sphear.plan("cavity", over, {"scheme": "incompressible", "resolution": 20})
        >>> [(run.settings.viscosity, run.settings.reynolds) for run in runs]
        [('morris', 100.0), ('morris', 400.0), ('oger', 100.0), ('oger', 400.0)]
    """
    from sphear.cases.flow import FLOWS
    from sphear.cases.flow.start import flow_settings

    fixed = {} if fixed is None else fixed
    _check(over, fixed)
    chosen = FLOWS[case]
    combinations = math.prod(len(values) for values in over.values())
    if combinations > MOST:
        raise SphearError(
            f"a sweep has at most {MOST} runs, and {' x '.join(str(len(values)) for values in over.values())} values"
            f" are {combinations}: compute it in parts, which may share a folder"
        )
    runs: dict[str, Run] = {}
    costs = Costs()
    for number, values in enumerate(product(*over.values())):
        changes = {**fixed, **dict(zip(over, values, strict=True))}
        run = Run(chosen.name, flow_settings(chosen, changes, preset))
        if run.key not in runs:
            runs[run.key] = run
            run.__dict__["cost"] = costs.of(run.case, run.settings)  # refuses settings that do not go together
        if number % TOLD_EVERY == 0:
            progress(number, combinations)
    return list(runs.values())


def _check(over: Any, fixed: Any) -> None:
    """Refuse values that are not by setting, or no lists, and settings that are both fixed and gone through."""
    for what, settings in (("values to sweep over", over), ("fixed settings", fixed)):
        if not isinstance(settings, Mapping) or not all(isinstance(key, str) for key in settings):
            raise SphearError(f"the {what} are a mapping with names of settings, not {quoted(settings)}")
    for key, values in over.items():
        if key in fixed:
            raise SphearError(f"the setting {key} is both fixed and swept over: choose one")
        if isinstance(values, str | Mapping) or not isinstance(values, Sized) or not len(values):
            raise SphearError(f"the setting {key} needs a list of at least one value to sweep over")
