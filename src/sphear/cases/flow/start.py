"""A flow by its name, with settings by theirs: what the command line, sweeps and Python programs start from."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import Any, Unpack

from sphear.cases.flow.base import Case, Settings
from sphear.cases.flow.options import FlowOptions
from sphear.cases.flow.run import CaseRun
from sphear.checked import checked
from sphear.schemes.base import unknown_setting
from sphear.simulation.observers import Observer


def flow(
    case: str,
    /,
    *,
    preset: str | None = None,
    observers: Sequence[Observer] = (),
    beyond: Collection[str] = (),
    **settings: Unpack[FlowOptions],
) -> CaseRun:
    """A run of a flow, ready to start; velocities in those of the lid, the channel or the vortex, see the case.

        run = sphear.flow("cavity", scheme="incompressible", viscosity="oger", reynolds=400, until=20).run()
        run.flow.positions, run.flow.velocities, run.flow.pressure  # (N, 2), (N, 2), (N,)
        run.history, run.end, run.as_dict()["metrics"]

    Args:
        case: "poiseuille", "couette", "taylor-green", "cavity", "cavity-cylinder" or "dam-break".
        preset: the settings of a paper, "basa2009" of the explicit scheme, "zheng2018" of the incompressible one; those
            given by name go before them. Without one they are the best that were found.
        observers: which look at the run, such as `sphear.Snapshots(every=0.1)`, at times of the flow: `run.unit` times
            those that are printed.
        beyond: ends that the run goes on beyond, such as "steady" of a channel.
        settings: as `--set` of `sphear run` takes them, such as `scheme`, `viscosity`, `reynolds`, `resolution` and
            `until`; `sphear show case NAME` says what each means, what it may be and what it is by default. Viscous
            terms, kernels, corrections, equations of state, wall models, shifting and preconditioners are names or
            objects.

    Raises:
        SphearError: there is no such case, preset, setting or end, or one does not fit the others.

    Examples:
        >>> import sphear
        >>> run = sphear.flow("cavity", scheme="incompressible", resolution=10, until=0.05).run()
        >>> run.end, run.history[-1]["steps"], run.flow.positions.shape
        ('time', 1, (100, 2))
    """
    from sphear.cases.flow import FLOWS

    named = FLOWS[case]
    return CaseRun(named, flow_settings(named, settings, preset), observers=observers, beyond=beyond)


def flow_settings(case: Case, changes: Mapping[str, Any], preset: str | None = None) -> Settings:
    """The settings of a case with some changed, each checked by itself.

    Args:
        case: whose settings.
        changes: values by name.
        preset: the settings of a paper, behind those.

    Raises:
        SphearError: there is no such setting or preset, or a value is wrong.
    """
    scheme = str(changes.get("scheme", next(iter(case.defaults))))
    behind = {} if preset is None else case.preset(preset, scheme)
    kind = case.kind(scheme)
    changes, valid = kind.flattened(changes), kind.model_fields
    for key in changes:
        if key not in valid:
            raise unknown_setting(key, valid, scheme)
    with checked("the setting "):
        result = case.settings(**{**behind, **changes})
    result.unmark(behind.keys() - changes.keys())
    return result
