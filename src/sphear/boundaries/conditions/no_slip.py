"""Fluid that sticks to a wall."""

from __future__ import annotations

from dataclasses import dataclass

from sphear.checked import number, numbers
from sphear.errors import SphearError, quoted


@dataclass(frozen=True)
class NoSlip:
    """The fluid has the velocity of the wall: u = u_wall.

    A wall moves only along itself, so that fluid never goes through it: straight walls slide, circles turn.

    Args:
        velocity: of the wall, (d,), in lengths a time; () is at rest.
        spin: angular velocity of a circle about its centre, anticlockwise, in radians a time.

    Raises:
        SphearError: velocity or spin is no number, or both are given.

    Examples:
        >>> import sphear
        >>> sphear.NoSlip(velocity=(1.0, 0.0))
        NoSlip(velocity=(1.0, 0.0))
    """

    velocity: tuple[float, ...] = ()
    spin: float = 0.0

    def __post_init__(self) -> None:
        given: object = self.velocity
        found = () if given is None else numbers(self.velocity)
        if not found and (not hasattr(given, "__len__") or len(self.velocity)) and given is not None:
            raise SphearError(f"the velocity of a wall has one finite number an axis, not {quoted(given)}")
        spin = number(self.spin)
        if spin != spin:
            raise SphearError(f"the spin of a wall is a finite number of radians a time, not {quoted(self.spin)}")
        if spin and any(found):
            raise SphearError("a wall slides with a velocity or turns with a spin, not both")
        object.__setattr__(self, "velocity", found)
        object.__setattr__(self, "spin", spin)

    @property
    def moving(self) -> bool:
        """True if the wall has a velocity or a spin."""
        return bool(self.spin) or any(self.velocity)

    def __repr__(self) -> str:
        """The condition as it is written, without what is zero."""
        if self.spin:
            return f"NoSlip(spin={self.spin:g})"
        return f"NoSlip(velocity={self.velocity})" if any(self.velocity) else "NoSlip()"
