"""Published extrema of the steady profiles."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from sphear.references.cavity.tables import available, read_rows


@dataclass(frozen=True)
class Extrema:
    """The largest and least velocities on the centrelines and the least stream function; None where not given.

    source, reynolds: who says so, of which flow.
    u_min, y_u_min: the least u on x = 1/2, and its y; likewise the others on y = 1/2.
    psi_min: the least stream function.
    note: what else the table says of it, as that the numbers are not interpolated.
    """

    source: str
    reynolds: int
    u_min: float | None
    y_u_min: float | None
    v_max: float | None
    x_v_max: float | None
    v_min: float | None
    x_v_min: float | None
    psi_min: float | None
    note: str


def extrema(reynolds: float) -> tuple[Extrema, ...]:
    """The published extrema of the steady profiles, one entry a source.

    Raises:
        SphearError: there are none of this Reynolds number.
    """
    found = read_rows("published_extrema.csv")
    number = available(reynolds, sorted({int(row["re"]) for row in found}), "the published extrema")
    return tuple(_extrema(row) for row in found if int(row["re"]) == number)


def _extrema(row: Mapping[str, str]) -> Extrema:
    def value(name: str) -> float | None:
        return float(row[name]) if row[name] else None

    return Extrema(
        source=row["source"].replace("_", " "),
        reynolds=int(row["re"]),
        u_min=value("u_min"),
        y_u_min=value("y_u_min"),
        v_max=value("v_max"),
        x_v_max=value("x_v_max"),
        v_min=value("v_min"),
        x_v_min=value("x_v_min"),
        psi_min=value("psi_min"),
        note=row["note"],
    )
