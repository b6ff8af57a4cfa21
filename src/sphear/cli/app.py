"""The commands as one Typer application."""

from __future__ import annotations

import sys
from typing import Any

import typer

from sphear.cli.extension import say_warnings
from sphear.cli.listing import list_names
from sphear.cli.notices import say_notices
from sphear.cli.patch_test import patch_test
from sphear.cli.reproduce import reproduce
from sphear.cli.run import run as run_case
from sphear.cli.show import show
from sphear.cli.sweep import sweep
from sphear.errors import SphearError

# what Typer raises for wrong options; it is not under a public name of its own
_UsageError: Any = next(kind for kind in typer.BadParameter.__mro__ if kind.__name__ == "ClickException")
LONGEST = 200  # letters of what is said of wrong options
_INTERRUPTED = 130  # what Typer makes of Ctrl-C

app = typer.Typer(
    name="sphear",
    help="Viscous flow with smoothed particle hydrodynamics: the best-known viscous terms, exchangeable.",
    invoke_without_command=True,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)
app.command("list")(list_names)
app.command("show")(show)
app.command("patch-test")(patch_test)
app.command("reproduce")(reproduce)
app.command("run")(run_case)
app.command("sweep")(sweep)


def _version(wanted: bool) -> None:
    if wanted:
        from sphear import __version__

        typer.echo(__version__)
        raise typer.Exit


@app.callback()
def _options(
    context: typer.Context,
    version: bool = typer.Option(False, "--version", callback=_version, is_eager=True, help="The version."),
) -> None:
    if context.invoked_subcommand is None:
        typer.echo(context.get_help())


def run() -> int:
    """Run the command that the arguments ask for; its exit status.

    Raises:
        SphearError: a user's mistake, wrong options included.
        KeyboardInterrupt: Ctrl-C.
        EOFError: something ended too early.
    """
    say_notices(as_json="--json" in sys.argv)
    say_warnings()
    try:
        status = app(standalone_mode=False, prog_name="sphear")
    except _UsageError as error:
        text = " ".join(error.format_message().split()).rstrip(".")
        text = text if len(text) <= LONGEST else f"{text[:LONGEST]}..."  # it repeats what it refuses
        where = f" (see {error.ctx.command_path} --help)" if getattr(error, "ctx", None) else ""
        raise SphearError(f"{text[:1].lower()}{text[1:]}{where}") from None
    except typer.Abort as abort:
        if isinstance(abort.__cause__, EOFError):  # of a file, say: nobody has interrupted anything
            raise abort.__cause__ from None
        raise KeyboardInterrupt from None
    if status == _INTERRUPTED:
        raise KeyboardInterrupt
    return status if isinstance(status, int) else 0
