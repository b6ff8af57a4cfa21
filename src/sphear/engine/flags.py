"""The flags of every compiled function of the engine, and the width of a vector register, in one place."""

from __future__ import annotations

import llvmlite.binding as llvm

# all of fast-math but one thing: results are stored as they are, so an overflow still shows as inf
FASTMATH = ("nnan", "ninf", "nsz", "arcp", "contract", "reassoc", "afn")

OPTIONS = {"fastmath": set(FASTMATH), "error_model": "numpy", "nogil": True}


def options_text() -> str:
    """The options as generated code has them: the same text in every process, for the text's hash is its name."""
    flags = ", ".join(map(repr, sorted(FASTMATH)))
    others = ", ".join(f"{key}={value!r}" for key, value in OPTIONS.items() if key != "fastmath")
    return f"fastmath={{{flags}}}, {others}"


def register_bytes() -> int:
    """Bytes of the widest vector register of this processor: 64 with AVX-512, else 32.

    Lanes wider than a register still compile (into several instructions), so 32 also serves processors with 16.
    """
    return 64 if llvm.get_host_cpu_features().get("avx512f") else 32


def lane_count(dtype: str) -> int:
    """The number of lanes: numbers of the type "float64" or "float32" that are computed on at once."""
    return register_bytes() // (8 if dtype == "float64" else 4)
