"""A process that computes runs: how it is set up, and what it calls. Nothing here imports Numba before that."""

from __future__ import annotations

import multiprocessing
import os
import signal
import sys
import warnings
from importlib import import_module
from threading import Thread
from typing import Any

COMPUTE = "sphear.sweeps.worker:compute"
"""The import path of what computes a run."""

_THREADS = ("NUMBA_NUM_THREADS", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


def prepare(extensions: tuple[str, ...] = ()) -> None:
    """Set up a worker process: one thread, deaf to Ctrl-C (its parent ends it), gone when its parent is.

    Args:
        extensions: that its parent has imported, and this process imports too.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    one_thread()
    Thread(target=_end_with_parent, daemon=True).start()
    _extend(extensions)


def _extend(extensions: tuple[str, ...]) -> None:
    """Import extensions, and those that packages declare; the parent has said which of these fail."""
    from sphear.errors import SphearWarning
    from sphear.extensions.discovery import discover
    from sphear.extensions.loading import load

    load(extensions)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SphearWarning)
        discover()


def one_thread() -> None:
    """Libraries that are not imported yet use one thread: the runs share the processors among them."""
    if "numba" not in sys.modules:
        os.environ.update(dict.fromkeys(_THREADS, "1"))


def _end_with_parent() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


def call(path: str, case: str, payload: bytes) -> dict[str, Any]:
    """Call the function at an import path, `module:name`, with a case and its settings; the record it gives back."""
    one_thread()
    from sphear.sweeps.objects import received

    module, _, name = path.partition(":")
    result: dict[str, Any] = getattr(import_module(module), name)(case, received(payload))
    return result


def compute(case: str, settings: dict[str, Any]) -> dict[str, Any]:
    """Compute a run to its end, or to its failure, on one thread where the settings do not say how many."""
    from sphear.cases.flow import FLOWS, CaseRun
    from sphear.sweeps.result import record

    if settings.get("threads", 1) is None:
        settings = {**settings, "threads": 1}
    return record(CaseRun(FLOWS[case], FLOWS[case].settings(**settings)).run())
