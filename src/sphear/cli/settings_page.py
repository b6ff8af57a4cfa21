"""The settings of schemes and cases as a page of the documentation."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from sphear.cases.flow import FLOWS
from sphear.cases.flow.cavity_cylinder import Cylinder
from sphear.cases.flow.dam_break import DamBreakSettings
from sphear.cases.patch_test import PatchTest
from sphear.cli.explained import of_settings, short
from sphear.schemes.common import RunSettings, Scheme
from sphear.schemes.incompressible.settings import Incompressible, IncompressibleSettings
from sphear.schemes.presets import BY_SCHEME
from sphear.schemes.weakly_compressible.settings import WeaklyCompressible

if TYPE_CHECKING:
    from pydantic import BaseModel

_INTRODUCTION = """# Settings

Drawn up from the docstrings of the settings by `python validation/settings_page.py`; a test compares it.
`sphear show cases NAME` says the same of one case. In Python settings are arguments of the schemes or of
`sphear.flow`, on the command line `--set KEY=VALUE`. Names of terms, kernels and corrections may be objects in Python.
Equation numbers are those of Basa, Quinlan & Lastiwka (2009) for the weakly compressible scheme and of Zheng,
Ma & Shao (2018) for the incompressible one; U is the largest speed, L the length, h the smoothing length and dx the
spacing ([glossary](glossary.md)). How to choose: [settings](../how-to/choose-settings.md).
"""

_SECTIONS: tuple[tuple[str, type[BaseModel], type[BaseModel] | None], ...] = (
    ("Of every scheme", Scheme, None),
    ("Weakly compressible", WeaklyCompressible, Scheme),
    ("Incompressible", Incompressible, Scheme),
    ("Of every case", RunSettings, None),
    ("Of every incompressible case", IncompressibleSettings, Incompressible),
    ("Of `cavity-cylinder`", Cylinder, None),
    ("Of `dam-break`", DamBreakSettings, IncompressibleSettings),
    ("Of the patch test", PatchTest, None),
)


def settings_page() -> str:
    """The text of docs/reference/settings.md."""
    sections = []
    for title, kind, base in _SECTIONS:
        besides = {"scheme", *(() if base is None else base.model_fields)}
        if kind is IncompressibleSettings:
            besides |= set(RunSettings.model_fields)
        names = [name for name in kind.model_fields if name not in besides]
        sections += [f"## {title}", "", *_table(kind, names), ""]
    return "\n".join((_INTRODUCTION, *sections, *_cases(), "", *_presets(), ""))


def _table(kind: type[BaseModel], names: Iterable[str]) -> list[str]:
    about = of_settings(kind)
    rows = ["| setting | default | values | meaning |", "|---|---|---|---|"]
    for name in names:
        one, default = about[name], short(kind.model_fields[name].default)
        rows.append(f"| `{name}` | {default} | {_cell(one['values'])} | {_cell(one['meaning'])} |")
    return rows


def _cell(text: str) -> str:
    """A text that does not end its cell, nor is taken for markup."""
    return text.replace("|", r"\|").replace("*", r"\*")


def _cases() -> list[str]:
    """The defaults in which cases differ from the tables above."""
    rows = ["## Defaults of the cases", "", "| case | scheme | defaults |", "|---|---|---|"]
    for name in FLOWS:
        for scheme, own in FLOWS[name].defaults.items():
            chosen = ", ".join(f"{key}={short(value)}" for key, value in own.items())
            rows.append(f"| `{name}` | {scheme} | {chosen} |")
    return rows


def _presets() -> list[str]:
    """The settings of papers, and in which cases they differ."""
    rows = ["## Presets", "", "| preset | case | settings |", "|---|---|---|"]
    for scheme, presets in BY_SCHEME.items():
        for name in presets:
            rows.append(f"| `{name}` ({scheme}) | all | {_written(presets[name])} |")
            for case in FLOWS:
                if scheme in FLOWS[case].defaults and (own := FLOWS[case].presets.get(name)):
                    rows.append(f"| | `{case}` | {_written(own)} |")
    return rows


def _written(settings: object) -> str:
    assert isinstance(settings, dict)
    return ", ".join(f"{key}={short(value)}" for key, value in settings.items())
