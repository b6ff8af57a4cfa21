"""Seconds a step of a lid-driven cavity with JAX-SPH; run by an interpreter that has it.

    python _jax_sph_cavity.py SIDE STEPS

Density by summation, transport velocity, its quintic spline, walls after Adami et al. (2012), the settings of its own
cavity; float64, on one core of the CPU. Prints the least mean over a tenth of the steps.
"""

from __future__ import annotations

import contextlib
import io
import os
import sys
import time
from typing import Any

os.environ["JAX_PLATFORMS"] = "cpu"
os.environ["JAX_ENABLE_X64"] = "1"
os.environ["XLA_FLAGS"] = "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1"
if hasattr(os, "sched_setaffinity"):
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})

import jax
import jax.numpy as jnp
import numpy as np
from jax_sph import partition
from jax_sph.case_setup import SimulationSetup
from jax_sph.defaults import set_defaults
from jax_sph.integrator import si_euler
from jax_sph.jax_md.partition import Sparse
from jax_sph.solver import WCSPH
from jax_sph.utils import Tag, pos_init_cartesian_2d
from omegaconf import OmegaConf

LAYERS = 3


class Cavity(SimulationSetup):
    """A unit square of fluid inside three layers of wall particles, the upper ones moving."""

    def _box_size2D(self, n_walls: int) -> Any:
        return np.ones(2) + 2 * n_walls * self.case.dx

    def _init_pos2D(self, box_size: Any, dx: float, n_walls: int) -> Any:
        r = pos_init_cartesian_2d(box_size, dx)
        inside = ((r > n_walls * dx) & (r < 1 + n_walls * dx)).all(axis=1)
        wall = jnp.where(r[:, 1] > 1 + n_walls * dx, int(Tag.MOVING_WALL), int(Tag.SOLID_WALL))
        return r, jnp.where(inside, int(Tag.FLUID), wall)

    def _init_velocity2D(self, r: Any) -> Any:
        return jnp.zeros_like(r)

    def _external_acceleration_fn(self, r: Any) -> Any:
        return jnp.zeros_like(r)

    def _boundary_conditions_fn(self, state: dict[str, Any]) -> dict[str, Any]:
        fluid = (state["tag"] == Tag.FLUID)[:, None]
        lid = jnp.where((state["tag"] == Tag.MOVING_WALL)[:, None], jnp.array([1.0, 0.0]), 0.0)
        for name in ("u", "v"):
            state[name] = jnp.where(fluid, state[name], lid)
        for name in ("dudt", "dvdt"):
            state[name] = jnp.where(fluid, state[name], 0.0)
        return state

    def _init_walls_2d(self) -> None: ...

    _box_size3D = _init_pos3D = _init_walls_3d = _init_velocity3D = _init_walls_2d


def main() -> None:
    side, steps = int(sys.argv[1]), int(sys.argv[2])
    cfg = set_defaults(OmegaConf.create({}))
    cfg.config = "cavity.yaml"
    cfg.case.dim, cfg.case.dx = 2, 1 / side
    cfg.solver.tvf, cfg.solver.is_bc_trick, cfg.solver.n_walls = 1.0, True, LAYERS
    cfg.eos.p_bg_factor = 0.01
    with contextlib.redirect_stdout(io.StringIO()):
        cfg, box, state, force, walls, normals, eos, _, displacement, shift = Cavity(cfg).initialize()
        solver = WCSPH(
            displacement, eos, force, cfg.case.dx, 2, cfg.solver.dt, cfg.case.c_ref, cfg.solver.eta_limiter,
            cfg.solver.name, cfg.kernel.name, cfg.solver.is_bc_trick, cfg.solver.density_evolution,
            cfg.solver.artificial_alpha, cfg.solver.free_slip, cfg.solver.density_renormalize,
            cfg.solver.heat_conduction,
        )  # fmt: skip
        search = partition.neighbor_list(
            displacement, box, r_cutoff=solver._kernel_fn.cutoff, backend=cfg.nl.backend, capacity_multiplier=1.25,
            mask_self=False, format=Sparse, num_particles_max=len(state["r"]), num_partitions=1,
            pbc=np.array(cfg.case.pbc),
        )  # fmt: skip
    neighbours = search.allocate(state["r"], num_particles=len(state["r"]))
    advance = jax.jit(si_euler(cfg.solver.tvf, solver.forward_wrapper(), shift, walls, normals))
    chunk, best = max(1, steps // 10), float("inf")
    state, neighbours = advance(0.0, state, neighbours)
    for _ in range(10):
        begin = time.perf_counter()
        for _ in range(chunk):
            state, neighbours = advance(cfg.solver.dt, state, neighbours)
        state["r"].block_until_ready()
        best = min(best, (time.perf_counter() - begin) / chunk)
    if neighbours.did_buffer_overflow or not bool(jnp.isfinite(state["r"]).all()):
        raise SystemExit("the list of neighbours overflowed, or the flow broke down")
    speed = jnp.abs(state["v"][state["tag"] == Tag.FLUID]).max()
    assert 0.01 < float(speed) < 1.5, speed  # the lid drags the fluid
    print(best)


if __name__ == "__main__":
    main()
