"""Jittered particles and sphear's sweep over them, as several benchmarks time it: pressure and Morris viscosity."""

from __future__ import annotations

from pathlib import Path

import _roofline
import numpy as np
from _bench import jittered_square

from sphear import Kernel, Morris, Neighbours, NoCorrection, WendlandC2
from sphear.engine.sweep import Sweep
from sphear.interactions import PressureForce, Rates, ViscousForce

SUPPORT_OVER_DX = 3.09  # 29 neighbours
ETA = 0.1  # smoothing lengths
VISCOSITY = 0.01


class Case:
    """Particles on a jittered lattice in open space, and sphear's sweep over them."""

    def __init__(
        self, side: int, kernel: type[Kernel] = WendlandC2, threads: int = 1, each_pair_once: bool = False
    ) -> None:
        random = np.random.default_rng(1)
        self.positions, self.support = jittered_square(side), SUPPORT_OVER_DX / side
        self.count, self.mass, self.threads, self.once = side**2, 1 / side**2, threads, each_pair_once
        density = 1 + 0.01 * random.random(self.count)
        self.fields = {
            "velocity": random.standard_normal((self.count, 2)),
            "pressure_over_density2": random.random(self.count),
            "density": density,
            "volume": self.mass / density,
            "mass": np.full(self.count, self.mass),
            "dynamic_viscosity": np.full(self.count, VISCOSITY),
        }
        kind, none = kernel(self.support / 2), NoCorrection()
        self.interaction = Rates(
            (ViscousForce(Morris(eta=ETA), kind, none), PressureForce(kind, none, "squares", reduced=False))
        )
        self.neighbours = self.search()
        self.sweep = self.packed()
        self.out = np.empty((self.count, 2))

    def search(self) -> Neighbours:
        return Neighbours(self.positions, self.support, threads=self.threads, each_pair_once=self.once)

    def packed(self) -> Sweep:
        return Sweep(self.interaction, self.neighbours, self.fields, each_pair_once=self.once)

    def over(self) -> None:
        for chunk in self.neighbours.chunks:
            self.sweep.over(chunk, self.out, self.neighbours.particles(chunk))

    def write(self, file: Path) -> None:
        names = ("velocity", "pressure_over_density2", "density")
        fields = {name: self.fields[name] for name in names}
        _roofline.write_particles(
            file, self.support, ETA * self.support / 2, VISCOSITY, self.mass, self.positions, **fields
        )
