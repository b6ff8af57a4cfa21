"""`--extension`: files and modules whose terms, kernels and corrections a command takes by name."""

from __future__ import annotations

import warnings
from typing import Any

import typer

from sphear.cli.output import print_sentence
from sphear.errors import SphearWarning


def _load(wanted: list[str]) -> list[str]:
    """Import what is named, before any other option is read."""
    if wanted:
        from sphear.extensions.loading import load

        load(wanted)
    return wanted


EXTENSIONS: list[str] = typer.Option(
    (),
    "--extension",
    metavar="FILE",
    callback=_load,
    is_eager=True,
    help="A Python file or module that names terms, kernels or corrections; may be repeated.",
)


def say_warnings() -> None:
    """Have what sphear warns of said as the command line says things."""
    usual = warnings.showwarning

    def show(message: Warning | str, category: type[Warning], *where: Any, **more: Any) -> None:
        if issubclass(category, SphearWarning):
            print_sentence(f"warning: {message}")
        else:
            usual(message, category, *where, **more)

    warnings.showwarning = show
