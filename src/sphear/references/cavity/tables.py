"""The files in `data/`: CSV with sources, meshes and corrections in the first lines."""

from __future__ import annotations

import csv
from collections.abc import Collection
from functools import cache
from importlib.resources import files

import numpy as np

from sphear.errors import SphearError
from sphear.references.cavity.curve import Curve


def available(reynolds: float, numbers: Collection[int], where: str) -> int:
    """The Reynolds number as an integer, if it is available."""
    if reynolds not in numbers:
        choice = ", ".join(map(str, numbers))
        raise SphearError(f"{where} have no Reynolds number {reynolds:g}, only {choice}")
    return int(reynolds)


def read_curve(file: str, station: str, value: str, gap: tuple[float, float] | None = None) -> Curve:
    """Two columns of a file, by increasing station, without negative zeros."""
    pairs = sorted((float(row[station]), float(row[value]) + 0.0) for row in read_rows(file))
    stations, values = zip(*pairs, strict=True)
    return Curve(np.array(stations), np.array(values), gap)


@cache
def read_rows(file: str) -> tuple[dict[str, str], ...]:
    """The rows of a file in `data/`, by the names of its columns."""
    text = files("sphear.references").joinpath("data", file).read_text(encoding="utf-8")
    return tuple(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))
