"""Programs that compute the lid-driven cavity from rest to an end, each on one core, in a process of its own."""

from __future__ import annotations

import json
import math
import os
import subprocess
import sys
import tempfile
from abc import ABC, abstractmethod
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import _icofoam
import numpy as np

import sphear
from sphear.cases.flow.cavity import STATIONS, deviations
from sphear.references import cavity as references
from sphear.simulation.interpolation import interpolated

UNTIL = {100: 20, 1000: 40}
"""The Reynolds numbers, each with the time of the flow that profiles are compared at, in sides over lid speeds."""
FIRST = {100: 20, 1000: 40}
"""The resolutions that searches begin with: no program is within 0.005 there."""
ONE_CORE = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS"), "1")
HERE = Path(__file__).parent
Found = tuple[int, float, float]  # steps, processor seconds, deviation


class Program(ABC):
    """A program that computes the cavity.

    Attributes:
        name: as it is printed.
        colour: of its points in the figure.
        missing: a sentence on how to have it, for where it is not installed.
    """

    name: str
    colour: str
    missing: str = ""

    @abstractmethod
    def version(self) -> str | None:
        """The version that is installed; None where none is."""

    @abstractmethod
    def compute(self, reynolds: int, side: int, until: float) -> Found:
        """Steps, processor seconds and mean deviation of both profiles; infinite for a flow that failed."""


class Sphear(Program):
    name, colour = "sphear", "#0072b2"

    def version(self) -> str:
        return f"sphear {sphear.__version__}"

    def compute(self, reynolds: int, side: int, until: float) -> Found:
        script = str(HERE / "_sphear_cavity.py")
        said = _said([sys.executable, script, str(reynolds), str(side), str(until)])
        return int(said["steps"]), float(said["seconds"]), float(said["deviation"])


class IcoFoam(Program):
    name, colour = "icoFoam", "#d55e00"
    missing = "icoFoam is not installed: skipped. Debian has it in the package openfoam."

    def version(self) -> str | None:
        return _icofoam.version() if _icofoam.installed() else None

    def compute(self, reynolds: int, side: int, until: float) -> Found:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            steps = _icofoam.write_case(folder, side, reynolds, until)
            seconds = _icofoam.run(folder)
            return steps, seconds, deviation(reynolds, until, _icofoam.profiles(folder, side, until, STATIONS))


@dataclass(frozen=True, eq=False)
class PySPH(Program):
    """The cavity of PySPH's own examples, by one of its schemes; its ISPH knows no walls.

    Args:
        scheme: as the example calls it.
        colour: of its points.
    """

    scheme: str
    colour: str
    missing = "PySPH is not installed: skipped. PYSPH_PYTHON may name an interpreter that has it."

    @property
    def name(self) -> str:  # type: ignore[override]
        return f"PySPH, {self.scheme}"

    @property
    def interpreter(self) -> str:
        return os.environ.get("PYSPH_PYTHON", sys.executable)

    def version(self) -> str | None:
        ask = "import pysph; print(pysph.__version__)"
        done = subprocess.run([self.interpreter, "-c", ask], capture_output=True, text=True, check=False)
        return None if done.returncode else f"PySPH {done.stdout.strip()}"

    def compute(self, reynolds: int, side: int, until: float) -> Found:
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "particles.npz"
            script = str(HERE / "_pysph_whole_cavity.py")
            arguments = [self.scheme, str(reynolds), str(side), str(until), str(file)]
            said = _said([self.interpreter, script, *arguments])
            with np.load(file) as kept:
                lines = read_off(kept["positions"], kept["velocities"], 1.0 / side)
        return int(said["steps"]), float(said["seconds"]), deviation(reynolds, until, lines)


PROGRAMS: tuple[Program, ...] = (Sphear(), IcoFoam(), PySPH("tvf", "#009e73"), PySPH("edac", "#aa4499"))
"""All programs, sphear first."""


def _said(command: list[str]) -> dict[str, Any]:
    """The JSON in the last line that a program prints, on one core."""
    done = subprocess.run(command, env={**os.environ, **ONE_CORE}, capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit(f"{' '.join(command)} failed: {done.stderr.strip()[-1000:]}")
    said: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    return said


def read_off(positions: Any, velocities: Any, spacing: float) -> _icofoam.Lines:
    """Both centre-line profiles of particles, read off as those of sphear's flows are."""
    flow: Any = SimpleNamespace(
        positions=positions, velocities=velocities, count=len(positions), problem=SimpleNamespace(spacing=spacing)
    )
    lines = {}
    for component, name in enumerate("uv"):
        points = np.full((len(STATIONS), 2), 0.5)
        points[:, 1 - component] = STATIONS
        lines[name] = STATIONS, interpolated(flow, points)[:, component]
    return lines


def deviation(reynolds: int, until: float, lines: _icofoam.Lines) -> float:
    """The mean deviation of both profiles that `sphear run cavity` reports; infinite where they are not numbers."""
    if not all(np.isfinite(values).all() for _, values in lines.values()):
        return math.inf
    found = deviations(references.mac(reynolds, until), lines)
    return 0.5 * (found["u_mean_deviation"] + found["v_mean_deviation"])
