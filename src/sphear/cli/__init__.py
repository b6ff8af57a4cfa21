"""The command line, `sphear` or `python -m sphear`."""

from __future__ import annotations

import os
import sys
from typing import Any

import typer

from sphear.cli.listing import list_names
from sphear.cli.patch_test import patch_test
from sphear.cli.reproduce import reproduce
from sphear.cli.show import show
from sphear.errors import SphearError

# what Typer raises for wrong options; it is not under a public name of its own
_UsageError: Any = next(kind for kind in typer.BadParameter.__mro__ if kind.__name__ == "ClickException")

app = typer.Typer(
    name="sphear",
    help="Viscous flow with smoothed particle hydrodynamics: every published viscous term, exchangeable.",
    no_args_is_help=True,
    add_completion=False,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)
app.command("list")(list_names)
app.command("show")(show)
app.command("patch-test")(patch_test)
app.command("reproduce")(reproduce)


def _version(wanted: bool) -> None:
    if wanted:
        from sphear import __version__

        typer.echo(__version__)
        raise typer.Exit


@app.callback()
def _options(
    version: bool = typer.Option(False, "--version", callback=_version, is_eager=True, help="The version."),
) -> None:
    pass


def main() -> None:
    """Run the command line: a user's mistake is one sentence on stderr and exit status 2."""
    try:
        status = app(standalone_mode=False, prog_name="sphear")
    except SphearError as error:
        _fail(str(error), 2)
    except _UsageError as error:
        text = error.format_message()
        _fail(text[:1].lower() + text[1:].rstrip("."), 2) if text else sys.exit(2)
    except (KeyboardInterrupt, typer.Abort):
        _fail("interrupted; nothing half-written is left", 130)
    except BrokenPipeError:  # the reader, such as `head`, has seen enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(1)
    else:
        sys.exit(status if isinstance(status, int) else 0)


def _fail(sentence: str, status: int) -> None:
    print(f"sphear: {' '.join(sentence.split())}", file=sys.stderr)
    sys.exit(status)
