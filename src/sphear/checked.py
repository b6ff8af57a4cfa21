"""Settings that a user gives, checked: the first that is wrong in one sentence."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from sphear.errors import SphearError


@contextmanager
def checked(what: str = "") -> Iterator[None]:
    """Turn what Pydantic says of the first wrong setting into a SphearError, with `what` before the setting's name.

    What a model itself says of settings that contradict each other stays as it is.
    """
    from pydantic import ValidationError

    try:
        yield
    except ValidationError as error:
        first = error.errors()[0]
        if isinstance(own := first.get("ctx", {}).get("error"), SphearError):
            raise own from None
        name = str(first["loc"][0]) if what else str(first["loc"][0]).replace("_", "-")
        if first["type"] == "extra_forbidden":
            raise SphearError(f"there is no setting named {name!r}") from None
        raise SphearError(f"{what}{name} {first['msg'].removeprefix('Input ')}, not {first['input']!r}") from None
