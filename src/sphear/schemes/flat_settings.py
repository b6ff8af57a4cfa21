"""Settings that may be objects, and the flat settings that say the fields of these one by one.

`shifting=Lind(strength=1.0)` and `shifting="lind", shifting_strength=1.0` are one choice. An object that has a name is
written down flat, so that files, stored results and saved states know names and numbers; an object whose class says
more than the flat settings do stays what it is beside them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, is_dataclass, replace
from typing import Any, NamedTuple

from sphear.errors import SphearError
from sphear.names import Registry
from sphear.schemes.objects import text


class FlatSetting(NamedTuple):
    """A setting that may be an object, and its fields that are settings too.

    kind: the class of the objects.
    named: the objects that have names, by name.
    fields: the flat settings by the fields of the objects; None in a field leaves its setting open.
    without: the name of an attribute of objects that lists fields which say nothing here; "" for none.
    """

    kind: type
    named: Mapping[str, Any] | Registry[Any]
    fields: Mapping[str, str]
    without: str = ""

    def own(self, item: Any) -> set[str]:
        """The fields of an object that say something here."""
        return {field.name for field in fields(item)} - set(getattr(item, self.without, ()) if self.without else ())

    def said_by(self, item: Any) -> dict[str, Any]:
        """The values of the flat settings that an object says."""
        own = self.own(item)
        said = {flat: getattr(item, field) for field, flat in self.fields.items() if field in own}
        return {flat: value for flat, value in said.items() if value is not None}

    def with_flat(self, value: Any, flat: Mapping[str, Any]) -> Any:
        """The object of a setting: itself, or the named one with the values of the flat settings."""
        if not isinstance(value, str):
            return value
        item = self.named[value]
        own = self.own(item)
        return replace(item, **{field: flat[key] for field, key in self.fields.items() if field in own and key in flat})

    def name_of(self, item: Any) -> str | None:
        """The name by which, with the flat settings, an object can be written down; None where there is none."""
        for name in self.named:
            if type(self.named[name]) is type(item) and self.with_flat(name, self.said_by(item)) == item:
                return name
        return None


def flattened(given: Mapping[str, Any], flat: Mapping[str, FlatSetting]) -> dict[str, Any]:
    """Settings with the objects among them said flat.

    Args:
        given: values by setting.
        flat: the settings that may be objects.

    Raises:
        SphearError: an object and a flat setting contradict each other.
    """
    result = dict(given)
    for key, setting in flat.items():
        item = given.get(key)
        if not isinstance(item, setting.kind) or not is_dataclass(item):
            continue
        for name, value in setting.said_by(item).items():
            if name in given and given[name] != value:
                raise SphearError(
                    f"{key}={text(item)} and {name}={text(given[name])} contradict each other: leave {name} to the"
                    " object"
                )
            result[name] = value
        if (its_name := setting.name_of(item)) is not None:
            result[key] = its_name
    return result
