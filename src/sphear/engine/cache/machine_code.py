"""Numba's compiler, with its machine code kept in the code cache.

Numba keeps an index and code of its own as pickles that it runs unseen, in files that whoever may write the folder can
change, and that raise when they are damaged. Here each compiled signature of a function is one sealed file; whatever is
wrong with it, the function is compiled again.
"""

from __future__ import annotations

import gc
import hashlib
import pickle
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

import numba
from numba.core.caching import NullCache
from numba.core.compiler import CompileResult
from numba.core.registry import CPUDispatcher
from numba.core.serialize import dumps

from sphear.engine.cache.beside import compiling_begins
from sphear.engine.cache.files import read, sealed, unsealed
from sphear.engine.cache.folder import cache_directory, keep
from sphear.engine.cache.stamp import source_stamp, stamp
from sphear.engine.interrupts import deferred_signals
from sphear.engine.notices import notices

# nobody hands these functions to C
_ALWAYS = {"nopython": True, "boundscheck": None, "no_cfunc_wrapper": True}


class MachineCode(NullCache):
    """The machine code of one function, a file for each signature, as Numba asks for it.

    Args:
        function: what is compiled.
    """

    def __init__(self, function: Callable[..., Any]) -> None:
        self._function = function

    @property
    def cache_path(self) -> str | None:
        """The folder."""
        folder = cache_directory()
        return None if folder is None else str(folder)

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """The compiled signature, or None: it will be compiled."""
        target_context.refresh()
        key = self._key(sig, target_context.codegen())
        path = self._path(key)
        if path is not None:
            content = unsealed(key, read(path))
            if content is not None:
                with suppress(Exception):  # whatever it is, compiling anew mends it
                    return CompileResult._rebuild(target_context, *pickle.loads(content))
        compiling_begins()
        notices.compiling(None if path is None else path.parent)
        return None

    def save_overload(self, sig: Any, data: Any) -> None:
        """Keep a compiled signature, if it does not depend on where things are in memory."""
        key = self._key(sig, data.codegen)
        path = self._path(key)
        if path is None or data.library.has_dynamic_globals or not all(lifted.can_cache for lifted in data.lifted):
            return
        keep(path, sealed(key, dumps(data._reduce())))

    def _key(self, sig: Any, codegen: Any) -> str:
        """The key of all that the machine code depends on; empty if that differs from process to process."""
        function, code = self._function, self._function.__code__
        # the name of generated code is that of its text
        source = "" if function.__module__.startswith("sphear_") else source_stamp(code.co_filename)
        key = repr(
            (function.__module__, function.__qualname__, code.co_firstlineno, stamp(), source,
             hashlib.sha256(code.co_code).hexdigest(), sig, codegen.magic_tuple())
        )  # fmt: skip
        return "" if function.__closure__ or " at 0x" in key else key

    def _path(self, key: str) -> Path | None:
        folder = cache_directory()
        if folder is None or not key:
            return None
        name = self._function.__name__[:40].strip("<>")
        return folder / f"{self._function.__module__}.{name}-{hashlib.sha256(key.encode()).hexdigest()[:24]}.code"


class Dispatcher(CPUDispatcher):
    """A compiled function: Numba's, with the cache above, and not disturbed by signals while it is compiled."""

    def enable_caching(self) -> None:
        """Keep the machine code."""
        self._cache = MachineCode(self.py_func)

    def compile(self, sig: Any) -> Any:
        """Load or compile a signature; Ctrl-C is heard when that is done."""
        with deferred_signals(), _uncollected():
            return super().compile(sig)


@contextmanager
def _uncollected() -> Iterator[None]:
    """Let no garbage be looked for: the compiler makes so many objects that it would take a sixth of the time."""
    if not gc.isenabled():
        yield
        return
    gc.disable()
    try:
        yield
    finally:
        gc.enable()


def njit(**options: Any) -> Callable[[Callable[..., Any]], Any]:
    """Decorate a function to be compiled, as `numba.njit` does, its machine code kept in the code cache."""

    def decorate(function: Callable[..., Any]) -> Any:
        if numba.config.DISABLE_JIT:
            return function
        dispatcher = Dispatcher(function, targetoptions={**_ALWAYS, **options})
        dispatcher.enable_caching()
        return dispatcher

    return decorate


def compiled(function: Callable[..., Any]) -> Any:
    """A function of this package, compiled without fast-math; it lets go of the interpreter's lock."""
    return njit(nogil=True)(function)


def inlined(function: Callable[..., Any]) -> Any:
    """A compiled function whose source is put into those that call it and compiled with them.

    It is not compiled by itself as well, unless Python calls it: `sorted_cells` takes 3 s in place of 5.
    """
    return njit(nogil=True, inline="always")(function)
