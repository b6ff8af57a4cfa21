"""`sphear patch-test`: the accuracy of viscous terms on particles of one's own choice."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import typer

from sphear.cli.extension import EXTENSIONS
from sphear.cli.output import folder, print_files, print_json, print_tables, progress, write
from sphear.errors import SphearError, quoted
from sphear.versions import versions

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from sphear.cases.patch_test import PatchTest


def patch_test(
    viscosity: list[str] = typer.Option(("morris",), "--viscosity", "-v", help="A viscous term; may be repeated."),
    kernel: str = typer.Option("cubic_spline", help="A kernel."),
    h_over_dx: float | None = typer.Option(None, help="Smoothing length over spacing; default: a support of 3.14 dx."),
    correction: str = typer.Option("none", help="A consistency correction: none, shepard, bonet_lok, renormalised."),
    jitter: float = typer.Option(0.0, help="Random displacement of the particles in spacings, 0 to 1."),
    sizes: str = typer.Option("20,40,60,80,100", help="Particles a side, separated by commas."),
    field: str = typer.Option("quartic", help="A field's name or an expression of x, y and z."),
    dim: int = typer.Option(2, "--dim", help="Dimension, 2 or 3."),
    velocity: bool = typer.Option(
        False, help="Act on the divergence-free velocity whose stream function is the field."
    ),
    seed: int = typer.Option(0, help="Of the random displacements."),
    seeds: int = typer.Option(1, help="How many sets of displacements to average over."),
    edges: str = typer.Option("continued", help="continued: particles beyond the edges too; truncated: none."),
    samples: str = typer.Option("interior", help="interior: particles whose support is in the square; all."),
    fallback: str | None = typer.Option(None, help="Where neighbours are too few: uncorrected or nan."),
    precision: str = typer.Option("float64", help="float64 or float32."),
    threads: int | None = typer.Option(None, help="Default: all processors for many particles."),
    as_json: bool = typer.Option(False, "--json", help="Print JSON instead of a table."),
    extensions: list[str] = EXTENSIONS,
    out: str | None = typer.Option(None, metavar="DIR", help="Write figure, table and JSON to this folder."),
) -> None:
    """Measure errors and orders of viscous terms against the exact Laplacian of a field."""
    files = folder(out)
    test = _settings(
        viscosity=tuple(viscosity), kernel=kernel, h_over_dx=h_over_dx, correction=correction, jitter=jitter,
        sizes=_sizes(sizes), field=field, dimension=dim, velocity=velocity, seed=seed, seeds=seeds, edges=edges,
        samples=samples, fallback=fallback, precision=precision, threads=threads,
    )  # fmt: skip
    with progress("patch test") as tell:
        rows = test.rows(tell)
    table = _table(test, rows)
    result = {"case": "patch-test", "settings": test.model_dump(mode="json"), "versions": versions(), "rows": rows}
    if files is not None:
        write(files, "patch-test", result, [table], {"patch-test": lambda: _figure(test, rows)})
    if as_json:
        print_json(result)
        return
    print_tables([table])
    if files is not None:
        print_files(files)


def _sizes(text: str) -> tuple[int, ...]:
    try:
        sizes = tuple(int(part) for part in text.split(","))
    except ValueError:
        raise SphearError(
            f"sizes must be whole numbers separated by commas, such as 20,40, not {quoted(text)}"
        ) from None
    if min(sizes) < 1:
        raise SphearError(f"sizes must be positive, not {min(sizes)}")
    return sizes


def _settings(**values: Any) -> PatchTest:
    """The settings; a wrong one is called as the option is."""
    from sphear.cases.patch_test import PatchTest

    try:
        return PatchTest(**values)
    except SphearError as error:
        said = str(error).removeprefix("the setting ")
        raise SphearError(said.replace("h_over_dx should", "h-over-dx should")) from None


def _title(test: PatchTest) -> tuple[str, str]:
    """The field that is differentiated, and the particles that carry it."""
    acted = f"velocity of stream function {test.field}" if test.velocity else test.field
    particles = f"jitter {test.jitter:g} dx" if test.jitter else "lattice"
    return f"Patch test, {acted}", f"{test.dimension}-D, {test.kernel}, {particles}, edges {test.edges}"


def _table(test: PatchTest, rows: list[dict[str, Any]]) -> Any:
    from sphear.results.table import Column, Table

    columns = (
        Column("viscosity", "viscosity"),
        Column("particles", "particles a side", "d"),
        Column("l1", "L1", ".2e"),
        Column("l2", "L2", ".2e"),
        Column("max", "max", ".2e"),
        Column("order", "order of L1", "+.2f"),
        Column("paper", "L1 / M", ".2e"),
    )
    return Table(", ".join(_title(test)), columns, rows)


def _figure(test: PatchTest, rows: list[dict[str, Any]]) -> Figure:
    from sphear.results.figure import loglog_convergence

    series = {
        name: ([row["particles"] for row in rows if row["viscosity"] == name],
               [row["l1"] for row in rows if row["viscosity"] == name])
        for name in dict.fromkeys(row["viscosity"] for row in rows)
    }  # fmt: skip
    acted, particles = _title(test)
    title = f"{acted if len(acted) < 50 else acted[:47] + '...'}\n{particles}"
    return loglog_convergence(series, "particles a side", "L1-relative error", title, (-2,))
