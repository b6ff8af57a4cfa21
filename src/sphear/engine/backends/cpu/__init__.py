"""The processor: each stage is compiled by itself, and a compiled loop calls one after the other."""

from sphear.engine.backends.cpu.program import Ended, Program, Space

__all__ = ["Ended", "Program", "Space"]
