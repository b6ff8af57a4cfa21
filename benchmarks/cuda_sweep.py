"""The sweep of every viscous term on an NVIDIA GPU: equal to the CPU's, and how fast.

Needs the extra `cuda` and a GPU. The pair list is the CPU's and copied over before; a sweep alone is timed, in double
and single precision. One thread a particle, as `sphear.engine.cuda` writes it: a first engine, not a tuned one.
"""

from __future__ import annotations

import time
import warnings
from collections.abc import Callable
from typing import Any

import numpy as np
from _bench import Array, Report, best_of, clocked
from _case import Case

from sphear import WendlandC2
from sphear.corrections import NoCorrection
from sphear.engine.cache import generated_module
from sphear.engine.cuda import cuda_text
from sphear.engine.preparing import PreparationSweep
from sphear.engine.sweep import Sweep
from sphear.viscosity import VISCOSITY

THREADS = 128  # a block
CHECKED, SIDES = 60, (316, 1000)  # particles a side
REPEATS = 20
CLOSE = {"float64": 1e-11, "float32": 2e-3}  # of the largest number, sums being rounded in another order


def joined(sweep: Sweep) -> tuple[Array, Array]:
    """The pair list of all chunks as one."""
    first, neighbour, start = [np.zeros(1, np.int64)], [], 0
    for chunk in sweep.neighbours.chunks:
        rows = chunk.end - chunk.begin
        first.append(start + np.asarray(chunk.first[1 : rows + 1], np.int64))
        neighbour.append(chunk.neighbour[: chunk.pairs])
        start += chunk.pairs
    return np.concatenate(first), np.concatenate(neighbour).astype(np.int32)


def on_gpu(sweep: Sweep, own: Array) -> tuple[Callable[[], None], Any]:
    """A function that makes the sweep, and its result on the GPU."""
    from numba import cuda

    count = sweep.neighbours.count
    module = generated_module(cuda_text(sweep.formula, "sweep", sweep.neighbours.dimension))
    kernel = cuda.jit(fastmath=True)(module.sweep)
    first, neighbour = joined(sweep)
    out = cuda.to_device(np.zeros((count, sweep.outputs), sweep.dtype))
    given = [
        cuda.to_device(np.ascontiguousarray(array)) for array in (sweep.parameters, sweep.records, sweep.private, own)
    ]
    rest = [cuda.to_device(array) for array in (sweep.neighbours.rows, sweep.neighbours.entry, first, neighbour)]

    def run() -> None:
        kernel[-(-count // THREADS), THREADS](*given, out, *rest)

    return run, out


def prepared(term: Any, kernel: Any, case: Case) -> tuple[tuple[Any, ...], Array]:
    """What a term sums up beforehand, in the order of the rows."""
    preparation = term.preparation(kernel, NoCorrection())
    if preparation is None:
        return (), np.empty((1, 1))
    sums = PreparationSweep(preparation, case.neighbours, case.fields)
    return sums.template, np.concatenate([sums.over(chunk) for chunk in case.neighbours.chunks])


def check(report: Report) -> None:
    """The result of each term against the CPU's, where neighbours are on all sides."""
    from numba import cuda

    for name in VISCOSITY:
        term, case = VISCOSITY[name], Case(CHECKED)
        inside = ((case.positions > 2 * case.support) & (case.positions < 1 - 2 * case.support)).all(axis=1)
        kernel = WendlandC2(case.support / 2)
        own, numbers = prepared(term, kernel, case)
        fields = dict(case.fields)
        worst = 0.0
        for stage in term.acceleration_stages(kernel, NoCorrection()):
            sweep = Sweep(stage, case.neighbours, fields, own)
            expected = np.empty((case.count, sweep.outputs))
            for chunk in case.neighbours.chunks:
                rows = case.neighbours.particles(chunk)
                sweep.over(chunk, expected, rows, numbers[chunk.begin : chunk.end] if own else None)
            run, out = on_gpu(sweep, numbers)
            run()
            cuda.synchronize()
            difference = np.abs(out.copy_to_host() - expected)[inside].max()  # at the edge some fits are singular
            worst = max(worst, float(difference / np.abs(expected[inside]).max()))
            fields["before"] = expected
        report.add(
            f"{name}, largest difference from the CPU's over the largest number", worst, at_most=CLOSE["float64"]
        )


def speed(report: Report, side: int) -> None:
    """Pressure and Morris: seconds a sweep on the GPU and on one core."""
    from numba import cuda

    case = Case(side)
    core = best_of(3, clocked("core", case.over))["core"]
    for dtype in ("float64", "float32"):
        sweep = Sweep(case.interaction, case.neighbours, case.fields, dtype=dtype)
        run, out = on_gpu(sweep, np.empty((1, 1), dtype))
        run()
        cuda.synchronize()
        difference = float(np.abs(out.copy_to_host() - sweep.everywhere()).max() / np.abs(out.copy_to_host()).max())
        least = np.inf
        for _ in range(5):
            begin = time.perf_counter()
            for _ in range(REPEATS):
                run()
            cuda.synchronize()
            least = min(least, (time.perf_counter() - begin) / REPEATS)
        report.add(f"{side}x{side}, {dtype}, difference from the CPU's", difference, at_most=CLOSE[dtype])
        report.add(f"{side}x{side}, {dtype}, a sweep", case.count / least / 1e6, "M particles/s")
        report.add(f"{side}x{side}, {dtype}, speed over one core", core / least)


def main() -> None:
    report = Report(__doc__ or "")
    try:
        from numba import cuda

        found = cuda.is_available()
    except ImportError:
        found = False
    if not found:
        report.say("no NVIDIA GPU, or no extra cuda (pip install 'sphear[cuda]'): skipped")
    else:
        from numba.core.errors import NumbaPerformanceWarning

        warnings.simplefilter("ignore", NumbaPerformanceWarning)  # a check needs no full GPU
        name = cuda.get_current_device().name
        report.say(f"on {name if isinstance(name, str) else name.decode()}")
        check(report)
        for side in SIDES:
            speed(report, side)
    report.close()


if __name__ == "__main__":
    main()
