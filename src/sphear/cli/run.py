"""`sphear run`: compute a flow and compare it with its reference."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import typer

from sphear.cli.output import folder, print_files, print_json, print_tables, print_text, progress, write
from sphear.cli.settings import changes

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from sphear.cases.flow import FlowRun


def run(
    case: str = typer.Argument(..., metavar="CASE", help="poiseuille, couette or taylor-green."),
    texts: list[str] = typer.Option((), "--set", metavar="KEY=VALUE", help="Any setting; may be repeated."),
    viscosity: str | None = typer.Option(None, "--viscosity", "-v", help="A viscous term."),
    correction: str | None = typer.Option(None, help="A consistency correction."),
    reynolds: float | None = typer.Option(None, help="The Reynolds number, as the case defines it."),
    resolution: int | None = typer.Option(None, help="Particles across the flow."),
    until: float | None = typer.Option(None, help="When to stop, in the time unit of the case."),
    force: bool = typer.Option(False, "--force", help="Take a time step beyond its limit all the same."),
    as_json: bool = typer.Option(False, "--json", help="Print JSON instead of a table."),
    out: str | None = typer.Option(None, metavar="DIR", help="Write figure, history and JSON to this folder."),
) -> None:
    """Compute a flow from its start to its end, or to its failure."""
    from sphear.cases.flow import FLOWS, FlowRun
    from sphear.sweeps import flow_settings

    files = folder(out)
    chosen = FLOWS[case.replace("_", "-")]
    given = {
        "viscosity": viscosity, "correction": correction, "reynolds": reynolds, "resolution": resolution,
        "until": until, "force": force or None,
    }  # fmt: skip
    settings = flow_settings(chosen, changes(texts) | {key: value for key, value in given.items() if value is not None})
    flow = FlowRun(chosen, settings)
    if not as_json:
        print_text(_start(flow))
    with progress(f"{chosen.name}") as tell:
        flow.run(tell)
    table = _table(flow)
    result = flow.as_dict()
    if files is not None:
        write(files, chosen.name, {**result, "history": flow.history}, [table], {chosen.name: lambda: _figure(flow)})
    if as_json:
        print_json(result)
        return
    print_tables([table])
    print_text(f"  End: {flow.end}.\n  {_speed(result['performance'])}")
    if files is not None:
        print_files(files)


def _start(run: FlowRun) -> str:
    """What is printed before the first step."""
    flow, settings = run.flow, run.settings
    limit, longest = min(flow.limits.items(), key=lambda item: item[1])
    neighbours = math.pi * (flow.kernel.radius / flow.problem.spacing) ** 2 - 1
    lines = [
        f"{run.case.name}: {len(flow.positions)} particles, Re = {settings.reynolds:g},"
        f" nu = {flow.problem.kinematic_viscosity:g}, {settings.viscosity}, correction {settings.correction}",
        f"  sound speed {flow.sound_speed:g}, about {neighbours:.0f} neighbours, time step {flow.time_step:.4g}"
        f" ({limit.replace('_', '-')} limit {longest:.4g})",
    ]
    if settings.force and flow.time_step > longest:
        lines.append("  warning: the time step is beyond its limit")
    if settings.until is not None:
        steps = settings.until * run.unit / flow.time_step
        lines.append(f"  until {run.case.time_name} = {settings.until:g}: about {steps:.0f} steps")
    return "\n".join(lines)


def _table(run: FlowRun) -> Any:
    from sphear.results.table import Column, Table

    rows = run.history[:: max(1, len(run.history) // 10)]
    rows = rows if rows[-1] is run.history[-1] else [*rows, run.history[-1]]
    names = [name for name in run.history[0] if name not in ("time", "steps")]
    columns = (
        Column("time", run.case.time_name, ".4g"),
        Column("steps", "steps", ".0f"),
        *(Column(name, name.replace("_", " "), ".4g") for name in names),
    )
    return Table(f"{run.case.name}, {run.settings.viscosity}", columns, rows)


def _figure(run: FlowRun) -> Figure:
    from sphear.results.figure import flow_panels

    exact = run.case.exact(run.settings, run.flow.positions, run.flow.time)
    times = [row["time"] for row in run.history]
    error = next(name for name in run.history[0] if name.endswith("error"))
    return flow_panels(
        run.flow.positions[:, 1], run.flow.velocities[:, 0], exact[:, 0], times, [row[error] for row in run.history],
        (run.case.time_name, error.replace("_", " ")), f"{run.case.name}: {run.settings.viscosity},"
        f" Re = {run.settings.reynolds:g}, {run.case.time_name} = {times[-1]:.3g}",
    )  # fmt: skip


def _speed(performance: dict[str, Any]) -> str:
    return (
        f"{performance['steps']} steps of {performance['particles']} particles in {performance['seconds']:.3g} s:"
        f" {performance['particle_steps_per_second'] / 1e6:.3g} million particle-steps a second"
    )
