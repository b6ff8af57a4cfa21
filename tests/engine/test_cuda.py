"""Every formula and interaction compiles for a GPU, and the generated kernel computes what the CPU does."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from sphear.corrections import CORRECTIONS, NoCorrection
from sphear.interactions import (
    Divergence,
    Gradient,
    Interpolation,
    Laplacian,
    NumberDensity,
    PressureForce,
    Rates,
    ViscousForce,
)
from sphear.kernels import KERNELS, CubicSpline
from sphear.viscosity import VISCOSITY, Morris

pytest.importorskip("numba.cuda", reason="the extra cuda is not installed")
cuda = pytest.importorskip("sphear.engine.cuda")

PARTICLE = (
    ("volume", 0.0),
    ("density", 0.0),
    ("dynamic_viscosity", 0.0),
    ("mass", 0.0),
    ("pressure_over_density2", 0.0),
)
ACCEPTED = [
    (term, correction)
    for term in VISCOSITY
    for correction in CORRECTIONS
    if correction == "none" or (not VISCOSITY[term].own_correction and "_4." not in term)
]


def fields(dimension):
    zeros = (0.0,) * dimension
    return (*PARTICLE, ("velocity", zeros), ("values", (0.0,)), ("before", (0.0,) * dimension**2))


def prepared(preparation, dimension):
    """The form of what a preparation gives, as the field that the sweep proper knows."""
    if preparation is None:
        return ()
    if hasattr(preparation, "template"):
        return (("prepared", preparation.template(dimension)),)
    from sphear.engine.formula import traced

    return (("prepared", traced(preparation, dimension, fields(dimension)).result),)


def assert_compiles(interaction, dimension, own=()):
    code = cuda.ptx(interaction, dimension, fields(dimension), own)
    assert ".visible .entry" in code
    assert "call" not in code.replace("callseq", "").split(".entry", 1)[1] or "exp" in code


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("name", list(KERNELS))
def test_every_kernel(name, dimension):
    kernel, none = KERNELS[name](0.1), NoCorrection()
    forces = ViscousForce(Morris(), kernel, none), PressureForce(kernel, none, "squares", reduced=False)
    assert_compiles(Rates(forces), dimension)


@pytest.mark.parametrize(("term", "correction"), ACCEPTED)
def test_every_viscous_term(term, correction):
    term, correction, kernel = VISCOSITY[term], CORRECTIONS[correction], CubicSpline(0.1)
    own = prepared(term.preparation(kernel, correction), 2)
    for stage in term.acceleration_stages(kernel, correction):
        assert_compiles(stage, 2, own)
    if hasattr(term, "laplacian_stages"):
        for stage in term.laplacian_stages(kernel, correction):
            assert_compiles(stage, 2, own)


@pytest.mark.parametrize("name", [name for name in VISCOSITY if VISCOSITY[name].own_correction])
def test_every_preparation_of_a_term(name):
    assert_compiles(VISCOSITY[name].preparation(CubicSpline(0.1), NoCorrection()), 2)


@pytest.mark.parametrize("second_derivatives", [False, True])
@pytest.mark.parametrize("name", [name for name in CORRECTIONS if name != "none"])
def test_every_preparation_of_a_correction(name, second_derivatives):
    assert_compiles(CORRECTIONS[name].preparation(CubicSpline(0.1), second_derivatives), 2)


@pytest.mark.parametrize("name", list(VISCOSITY))
def test_every_viscous_term_in_three_dimensions(name):
    term, kernel = VISCOSITY[name], CubicSpline(0.1)
    own = prepared(term.preparation(kernel, NoCorrection()), 3)
    assert_compiles(term.acceleration_stages(kernel, NoCorrection())[-1], 3, own)


@pytest.mark.parametrize(
    "interaction",
    [
        Gradient(CubicSpline(0.1), NoCorrection(), True),
        Divergence(CubicSpline(0.1), NoCorrection()),
        Interpolation(CubicSpline(0.1)),
        NumberDensity(CubicSpline(0.1)),
        Laplacian(Morris(), CubicSpline(0.1), NoCorrection()),
    ],
    ids=lambda interaction: type(interaction).__name__,
)
def test_every_other_interaction(interaction):
    assert_compiles(interaction, 2)


SIMULATED = """
import numpy as np
from numba import cuda
from sphear import CubicSpline, Monaghan, Neighbours, NoCorrection
from sphear.engine.cache import generated_module
from sphear.engine.cuda import cuda_text
from sphear.engine.sweep import Sweep
from sphear.interactions import ViscousAcceleration

random = np.random.default_rng(0)
positions = random.random((60, 2))
neighbours = Neighbours(positions, 0.4, threads=1)
values = {name: random.random(60) + 0.5 for name in ("volume", "density", "dynamic_viscosity")}
values["velocity"] = random.standard_normal((60, 2))
on_cpu = Sweep(ViscousAcceleration(Monaghan(), CubicSpline(0.2), NoCorrection()), neighbours, values)
module = generated_module(cuda_text(on_cpu.formula, "simulated", 2))
out, (chunk,) = np.zeros((60, 2)), neighbours.chunks
cuda.jit(module.sweep)[2, 32](
    on_cpu.parameters, on_cpu.records, on_cpu.private, np.empty((0, 0)), out, neighbours.rows, neighbours.entry,
    chunk.first,
    chunk.neighbour,
)
expected = on_cpu.everywhere()
assert np.abs(out - expected).max() < 1e-12 * np.abs(expected).max()
print("equal")
"""


def test_the_kernel_computes_what_the_cpu_does():
    """On the simulator of numba-cuda, which runs the kernel's source thread by thread."""
    run = subprocess.run(
        [sys.executable, "-c", SIMULATED],
        env={**os.environ, "NUMBA_ENABLE_CUDASIM": "1"},
        capture_output=True,
        text=True,
    )
    assert run.stdout.strip() == "equal", run.stderr[-2000:]
