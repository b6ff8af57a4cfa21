"""`sphear run`: compute a flow and compare it with its reference."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import typer

from sphear.cli.extension import EXTENSIONS
from sphear.cli.kept import compute, finish, kept_in
from sphear.cli.output import folder, print_files, print_json, print_tables, print_text, write
from sphear.cli.settings import changes
from sphear.cli.signals import Signals
from sphear.errors import SphearError

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from sphear.cases.flow import CaseRun
    from sphear.results.table import Table

FAILED = 3  # exit status of a flow that broke down


def run(
    case: str = typer.Argument(..., metavar="CASE", help="A flow: sphear list cases."),
    texts: list[str] = typer.Option((), "--set", metavar="KEY=VALUE", help="Any setting; may be repeated."),
    viscosity: str | None = typer.Option(None, "--viscosity", "-v", help="A viscous term."),
    correction: str | None = typer.Option(None, help="A consistency correction."),
    reynolds: float | None = typer.Option(None, help="The Reynolds number, as the case defines it."),
    resolution: int | None = typer.Option(None, help="Particles across the flow."),
    scheme: str | None = typer.Option(None, help="explicit (weakly compressible, compressible) or incompressible."),
    until: float | None = typer.Option(None, help="When to stop, in the time unit of the case."),
    preset: str | None = typer.Option(None, help="A paper's settings: basa2009 or zheng2018; options go before them."),
    force: bool = typer.Option(False, "--force", help="Take a time step beyond its limit all the same."),
    as_json: bool = typer.Option(False, "--json", help="Print JSON instead of a table."),
    extensions: list[str] = EXTENSIONS,
    out: str | None = typer.Option(None, metavar="DIR", help="Write figure, history, particles, JSON to this folder."),
    resume: bool = typer.Option(
        False, "--resume", help="Go on with the run in --out DIR: interrupted, or ended and now --until later."
    ),
    overwrite: bool = typer.Option(False, "--overwrite", help="Replace the run of this case in --out DIR."),
) -> None:
    """Compute a flow from its start to its end, or to its failure.

    Exit status: 0, the flow ended; 3, it failed (what was found is printed and written all the same); 2, the command
    is wrong; 1, results cannot be written or memory is short; 130, 143, 129: interrupted by Ctrl-C, SIGTERM or SIGHUP,
    with its state kept in --out DIR.
    """
    from sphear.cases.flow import FLOWS, CaseRun
    from sphear.cases.flow.start import flow_settings

    files = folder(out)
    chosen = FLOWS[case]
    given = {
        "viscosity": viscosity, "correction": correction, "reynolds": reynolds, "resolution": resolution,
        "until": until, "scheme": scheme, "force": force or None,
    }  # fmt: skip
    named = {key: value for key, value in given.items() if value is not None}
    wanted: dict[str, Any] = dict(changes(texts))
    if both := next((key for key in named if key in wanted), None):
        raise SphearError(f"the setting {both} is given by --{both} and by --set: choose one")
    wanted |= named
    flow = CaseRun(chosen, flow_settings(chosen, wanted, preset))
    with Signals() as signals, kept_in(files, flow, resume=resume, overwrite=overwrite):
        if not as_json:
            print_text(_start(flow))
        compute(flow, files, signals)
        result: dict[str, Any] = {}
        steps = [lambda: result.update(flow.as_dict())]
        if files is not None:
            name, found = chosen.name, files
            steps += [
                lambda: write(found, name, {**result, "history": flow.history}, [_table(flow)], {}),
                lambda: found.write_table(f"{name}-particles", _particles(flow)),
                lambda: found.write_figure(name, _figure(flow)),
            ]
        finish(flow, files, steps, signals)
    table = _table(flow)
    if as_json:
        print_json(result)
    else:
        print_tables([table])
        print_text(f"  End: {flow.end}.\n{_summary(result['metrics'], table)}  {_speed(result['performance'])}")
        for said in flow.warnings[len(flow.unresolved) :]:
            print_text(f"  Warning: {said}.")
        if files is not None:
            print_files(files)
    if flow.end.startswith("failed"):
        raise typer.Exit(FAILED)


def _start(run: CaseRun) -> str:
    """Text before the first step."""
    flow, settings = run.flow, run.settings
    limit, longest = min(flow.limits.items(), key=lambda item: item[1])
    neighbours = math.pi * (flow.kernel.radius / flow.problem.spacing) ** 2 - 1
    lines = [
        f"{run.case.name}: {len(flow.positions)} particles, Re = {settings.reynolds:g},"
        f" nu = {flow.problem.kinematic_viscosity:g}, {settings.viscosity}, {settings.scheme} scheme",
        f"  {flow.introduction()}, about {neighbours:.0f} neighbours, time step {flow.time_step:.4g}"
        f" ({limit.replace('_', '-')} limit {longest:.4g})",
    ]
    if settings.force and flow.time_step > longest:
        lines.append("  warning: the time step is beyond its limit")
    lines += [f"  warning: {said}" for said in (*settings.without_effect(flow.problem.walled), *run.unresolved)]
    needed = math.ceil(run.planned * run.unit / flow.time_step) if math.isfinite(run.planned) else math.inf
    steps = min(needed, settings.max_steps)
    if needed > settings.max_steps and settings.until is not None and "max_steps" not in settings.model_fields_set:
        lines.append(
            f"  warning: it takes {needed:.3g} steps until {settings.until:g}, and max_steps is {settings.max_steps}"
        )
    end = f"{run.case.time_name} = {steps * flow.time_step / run.unit:.4g}"
    lines.append(f"  from step {flow.steps} to about step {steps:.0f}, {end}; Ctrl-C ends it before")
    return "\n".join(lines)


def _table(run: CaseRun) -> Table:
    from sphear.results.table import Column, Table

    rows = run.history[:: max(1, len(run.history) // 10)]
    rows = rows if rows[-1] is run.history[-1] else [*rows, run.history[-1]]
    names = [name for name in run.history[-1] if name not in ("time", "steps")]
    columns = (
        Column("time", run.case.time_name, ".4g"),
        Column("steps", "steps", ".0f"),
        *(Column(name, name.replace("_", " "), ".4g") for name in names),
    )
    return Table(f"{run.case.name}, {run.settings.viscosity}", columns, rows)


def _particles(run: CaseRun) -> Table:
    """The particles at the end, for other programs."""
    from sphear.results.table import Column, Table

    flow = run.flow
    named = {
        **{f"x{k}": flow.positions[:, k] for k in range(flow.positions.shape[1])},
        **{f"u{k}": flow.velocities[:, k] for k in range(flow.positions.shape[1])},
        "density": flow.density,
        "pressure": flow.pressure,
    }
    rows = [dict(zip(named, values, strict=True)) for values in zip(*(x.tolist() for x in named.values()), strict=True)]
    return Table(f"{run.case.name}, particles", tuple(Column(name, name, ".6g") for name in named), rows)


def _summary(metrics: dict[str, Any], table: Table) -> str:
    """Results at the end, beside the columns of the table."""
    shown = {column.key for column in table.columns} | {"time", "steps", "end", "failure_time"}
    found = [
        "reference steady"
        if name == "reference_time" and math.isinf(value)
        else value
        if isinstance(value, str)
        else f"{name.replace('_', ' ')} {value:.4g}"
        for name, value in metrics.items()
        if name not in shown
    ]
    return f"  {', '.join(found)}.\n" if found else ""


def _figure(run: CaseRun) -> Figure:
    import numpy as np

    from sphear.boundaries.shapes import repeated
    from sphear.results.figure import flow_panels

    problem = run.flow.problem
    times = [row["time"] for row in run.history]
    name = run.case.headline
    places, velocities = run.flow.positions, run.flow.velocities
    plane = places.shape[1] == 2 and bool(np.isfinite(places + velocities).all())
    return flow_panels(
        run.case.comparisons(run.settings, run.flow),
        (times, [row[name] for row in run.history]),
        (run.case.time_name, name.replace("_", " ")),
        f"{run.case.name}: {run.settings.viscosity}, Re = {run.settings.reynolds:g},"
        f" {run.case.time_name} = {times[-1]:.3g}{', failed' if run.end.startswith('failed') else ''}",
        (places, velocities, problem.spacing) if plane else None,
        run.case.reference_history(run.settings),
        None if problem.shape is None else repeated(problem.shape, problem.window).distance,
    )


def _speed(performance: dict[str, Any]) -> str:
    return (
        f"{performance['steps']} steps of {performance['particles']} particles in {performance['seconds']:.3g} s:"
        f" {performance['particle_steps_per_second'] / 1e6:.3g} million particle-steps a second"
    )
