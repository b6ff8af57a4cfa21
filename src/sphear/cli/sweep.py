"""`sphear sweep`: many runs of a flow, one for each combination of settings."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import typer

from sphear.cli.extension import EXTENSIONS
from sphear.cli.output import folder, print_files, print_json, print_sentence, print_tables, progress, write
from sphear.cli.settings import changes, choices
from sphear.errors import Interrupted, SphearError
from sphear.versions import versions

if TYPE_CHECKING:
    from sphear.results import Table
    from sphear.sweeps import Run, SweepProgress, SweepResult

LOST = 1  # exit status
FOUND = ("error", "mean_deviation", "front_deviation")  # ends of the names of what a table has of a run


def sweep(
    case: str = typer.Argument(..., metavar="CASE", help="A flow: sphear list cases."),
    over: list[str] = typer.Option((), "--over", metavar="KEY=V1,V2,...", help="Values of a setting; may be repeated."),
    texts: list[str] = typer.Option((), "--set", metavar="KEY=VALUE", help="A setting of all runs; may be repeated."),
    preset: str | None = typer.Option(None, help="A paper's settings: basa2009 or zheng2018; options go before them."),
    workers: int | None = typer.Option(None, help="Processes; 1 if not given."),
    scheduler: str | None = typer.Option(None, metavar="ADDRESS", help="Use the workers of this Dask scheduler."),
    as_json: bool = typer.Option(False, "--json", help="Print JSON instead of a table."),
    extensions: list[str] = EXTENSIONS,
    out: str = typer.Option(..., metavar="DIR", help="Where the runs are stored, and the table and JSON written."),
) -> None:
    """Compute a flow with all combinations of settings; the same command again goes on where it was interrupted."""
    from sphear.sweeps import Store, plan, run_sweep

    values, fixed = choices(over), changes(texts)
    if not values:
        raise SphearError("sweep needs something to sweep over, such as --over resolution=10,20,40")
    if both := next((key for key in values if key in fixed), None):
        raise SphearError(f"the setting {both} is given by --over and by --set: choose one")
    if workers is not None and scheduler is not None:
        raise SphearError("--workers are processes of this machine and --scheduler uses those of a cluster: choose one")
    if workers is not None and workers < 1:
        raise SphearError(f"workers must be at least 1, not {workers}")
    if scheduler is not None and not scheduler.strip():
        raise SphearError("--scheduler needs an address, such as tcp://host:8786")
    files = folder(out)
    assert files is not None
    store = Store(files.path / "runs")
    with progress(f"sweep of {case}") as tell:
        runs = plan(case, values, fixed, lambda planned, of: tell(f"{planned} of {of} runs planned"), preset=preset)

        def show(state: SweepProgress) -> None:
            tell(str(state))

        try:
            results = run_sweep(
                runs, store, workers=workers or 1, scheduler=scheduler, progress=show, say=print_sentence
            )
        except KeyboardInterrupt:
            done = sum(store.get(run) is not None for run in runs)  # some may not have been counted yet
            raise Interrupted(
                f"interrupted; {done} of {len(runs)} runs are stored in {store.folder.path}, and the same command goes"
                " on from there"
            ) from None
    table = _table(runs, results, list(values))
    summary = _summary(runs, results, values, fixed)
    write(files, "sweep", summary, [_whole(table, runs, results)], {})
    if as_json:
        print_json(summary)
    else:
        print_tables([table])
        print_files(files)
    _report_lost(results)


def _summary(
    runs: Sequence[Run], results: Sequence[SweepResult], over: dict[str, list[str]], fixed: dict[str, str]
) -> dict[str, Any]:
    """All but the histories, which are in the files of the runs."""
    rows = []
    for run, result in zip(runs, results, strict=True):
        row = {
            key: value
            for key, value in result.as_dict().items()
            if key not in ("case", "history", "profiles", "versions")
        }
        rows.append({"end": row.pop("end"), **row, "file": _file(run, result)})
    return {
        "case": runs[0].case,
        "over": {key: _values(runs, key) for key in over},
        "fixed": list(fixed),
        "versions": versions(),
        "runs": rows,
    }


def _values(runs: Sequence[Run], key: str) -> list[Any]:
    return list(dict.fromkeys(run.given[key] for run in runs))


def _table(runs: Sequence[Run], results: Sequence[SweepResult], keys: Sequence[str]) -> Table:
    """The settings that change, how each run ended, and how far it is from what is known."""
    from sphear.cases.flow import FLOWS
    from sphear.results import Column, Table

    case = FLOWS[runs[0].case]
    metrics = dict.fromkeys(name for result in results for name in result.metrics)
    found = [name for name in metrics if name == case.headline or name.endswith(FOUND)]
    columns = [
        *(Column(key, key.replace("_", " "), "g" if _all_numbers(_values(runs, key)) else "") for key in keys),
        Column("end", "end"),
        Column("time", case.time_name, ".4g"),
        *(Column(name, name.replace("_", " "), ".4g") for name in found),
    ]
    rows = [
        {**{key: run.given[key] for key in keys}, **result.metrics, "end": result.end}
        for run, result in zip(runs, results, strict=True)
    ]
    return Table(f"Sweep of {case.name}, {len(runs)} runs", tuple(columns), rows)


def _whole(table: Table, runs: Sequence[Run], results: Sequence[SweepResult]) -> Table:
    """The table with what is not shown for want of room: when a flow failed, the seconds it took, where the run is."""
    from sphear.results import Column, Table

    rows = [
        {**row, "seconds": result.performance.get("seconds"), "file": _file(run, result)}
        for row, run, result in zip(table.rows, runs, results, strict=True)
    ]
    more = (Column("failure_time", "failure time"), Column("seconds", "seconds"), Column("file", "file"))
    return Table(table.title, (*table.columns, *more), rows)


def _file(run: Run, result: SweepResult) -> str | None:
    return None if result.lost else f"runs/{run.key}.json"


def _all_numbers(values: Sequence[Any]) -> bool:
    return all(isinstance(value, int | float) and not isinstance(value, bool) for value in values)


def _report_lost(results: Sequence[SweepResult]) -> None:
    """Say what is missing; the exit status does too.

    Raises:
        typer.Exit: a run was lost.
    """
    lost = [result for result in results if result.lost]
    if lost:
        from sphear.sweeps.sweep import ATTEMPTS

        what = "1 run was" if len(lost) == 1 else f"{len(lost)} runs were"
        first = lost[0].end.removeprefix("lost: ")
        again = any(result.attempts < ATTEMPTS for result in lost)
        then = ": the same command runs what is missing again" if again else ", and not for the first time"
        print_sentence(f"{what} lost ({first}){then}")
        raise typer.Exit(LOST)
