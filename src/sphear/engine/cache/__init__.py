"""The code cache: generated code and machine code on disk, and compiled anew whatever happens to them there."""

from sphear.engine.cache.beside import compiled_beside
from sphear.engine.cache.folder import cache_directory
from sphear.engine.cache.generated import generated_module
from sphear.engine.cache.machine_code import compiled, inlined, njit

__all__ = ["cache_directory", "compiled", "compiled_beside", "generated_module", "inlined", "njit"]
