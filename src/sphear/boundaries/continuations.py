"""The names of the ways to continue the velocity to mirror particles, those of functions of `boundaries.continuation`.

They stand apart from the functions, so that a wall model can be made and listed without the compiler.
"""

from __future__ import annotations

from sphear.names import Registry

CONTINUATIONS: Registry[str] = Registry("continuation")
for _name, _aliases in (
    ("mirror", ("mirroring",)), ("linear", ()), ("quadratic", ()), ("global_quadratic", ("global",)),
):  # fmt: skip
    CONTINUATIONS.add(_name, _name, _aliases)
