"""The error of a pressure equation that no method and no preconditioner solves."""

from __future__ import annotations

from sphear.errors import SphearError


class PressureFailure(SphearError):
    """A pressure equation that could not be solved.

    Args:
        iterations: of all attempts together.
        residual: ||b - A p|| / ||b|| that the last attempt was left with.
        tolerance: what was asked of it.
        reason: why, or what was tried; the end of the sentence.
    """

    def __init__(self, iterations: int, residual: float, tolerance: float, reason: str) -> None:
        super().__init__(
            f"the pressure equation was not solved: after {iterations} iterations its relative residual is "
            f"{residual:.2g} where {tolerance:g} is asked for ({reason})"
        )
        self.iterations = iterations
        self.residual = residual
        self.tolerance = tolerance
        self.reason = reason
