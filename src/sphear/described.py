"""Settings explained: what each means, which values it takes, and its default."""

from __future__ import annotations

import inspect
import re
import types
from typing import Any, Literal, NamedTuple, Union, get_args, get_origin

from annotated_types import Ge, Gt, Interval, Le, Lt
from pydantic import BaseModel
from pydantic.fields import FieldInfo

_ENTRY = re.compile(r"^ {4}(\w[\w, ]*): (.*)$")
_MORE = re.compile(r"^ {8,}(.*)$")
_KINDS = {int: "a whole number", float: "a number", bool: "true or false", str: "a text"}
_SIGNS = {Gt: ("gt", ">"), Ge: ("ge", ">="), Lt: ("lt", "<"), Le: ("le", "<=")}


class Explained(NamedTuple):
    """A setting: its meaning, the values it takes, and its default."""

    meaning: str
    values: str
    default: Any


def explained(settings: type[BaseModel], registries: dict[str, str] | None = None) -> dict[str, Explained]:
    """The settings of a class by name, in its order, with the meanings that docstrings of it and its bases give.

    Args:
        settings: the class.
        registries: what a setting is named from, where it is the name of something that is listed.
    """
    said = {name: text for kind in reversed(settings.__mro__) for name, text in _meanings(kind).items()}
    registries = registries or {}
    return {
        name: Explained(
            said.get(name, ""), (not _lists_choices(field) and registries.get(name)) or _values(field), field.default
        )
        for name, field in settings.model_fields.items()
    }


def _meanings(kind: type) -> dict[str, str]:
    """Meanings from the section `Attributes` of a class's own docstring."""
    lines = inspect.cleandoc(vars(kind).get("__doc__") or "").splitlines()
    found: dict[str, str] = {}
    names: list[str] = []
    inside = False
    for line in lines:
        if line and not line.startswith(" "):
            inside = line.startswith("Attributes")
        elif inside and (entry := _ENTRY.match(line)):
            names = entry[1].split(", ")
            found |= dict.fromkeys(names, entry[2])
        elif inside and (more := _MORE.match(line)):
            found |= {name: f"{found[name]} {more[1]}" for name in names}
    return found


def _lists_choices(field: FieldInfo) -> bool:
    """True of a setting that says its own choices, whatever else of its name is listed."""
    return get_origin(field.annotation) is Literal


def _values(field: FieldInfo) -> str:
    """The choices of a setting, or its kind and bounds."""
    annotation: Any = field.annotation
    optional = False
    if get_origin(annotation) in (Union, types.UnionType):
        options = [kind for kind in get_args(annotation) if kind is not type(None)]
        optional, annotation = type(None) in get_args(annotation), options[0]
    if get_origin(annotation) is Literal:
        text = ", ".join(str(choice) for choice in get_args(annotation))
    elif get_origin(annotation) is tuple:
        text = "several of a kind"
    else:
        text = f"{_KINDS.get(annotation, 'an object')}{_bounds(field)}"
    return f"{text}, or none" if optional else text


def _bounds(field: FieldInfo) -> str:
    bounds = []
    for part in field.metadata:
        each = (part.gt, part.ge, part.lt, part.le) if isinstance(part, Interval) else ()
        known = dict(zip((Gt, Ge, Lt, Le), each, strict=True)) if each else {}
        for kind, (name, sign) in _SIGNS.items():
            limit = known.get(kind) if each else getattr(part, name, None)
            if limit is not None:
                bounds.append(f"{sign} {limit:g}")
    return f" {' and '.join(bounds)}" if bounds else ""
