"""A stamp of all that compiled code depends on besides its own text."""

from __future__ import annotations

import hashlib
import re
import sys
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import llvmlite
import numba

PACKAGE = Path(__file__).parents[2]

# functions that are compiled, and those that say how something is
_COMPILED = re.compile(
    rb"^[ \t]*@(compiled|inlined|njit|intrinsic|infer_global|lower_builtin|register_model)\b", re.MULTILINE
)
# of modules of the package, by whoever imports the module: not for types alone, nor within functions
_IMPORT = re.compile(rf"^from {PACKAGE.name}(?:\.([\w.]+))? import (\([^)]*\)|[^\n#]*)".encode(), re.MULTILINE)


@cache
def stamp() -> str:
    """A hash of the sources that machine code depends on, and of the versions below them."""
    digest = hashlib.sha256(f"{numba.__version__} {llvmlite.__version__} {sys.version}".encode())
    for name, source in sorted(sources(PACKAGE).items()):
        digest.update(f"{name} {len(source)} ".encode() + source)
    return digest.hexdigest()[:16]


def sources(package: Path) -> dict[str, bytes]:
    """The modules with functions that are compiled, and those that they import: constants of these are compiled in.

    Args:
        package: its folder.

    Returns:
        the content of each file, by its path in the package.
    """
    contents = {path: path.read_bytes() for path in package.rglob("*.py")}
    found: dict[str, bytes] = {}
    open_ends = [path for path, content in contents.items() if _COMPILED.search(content)]
    while open_ends:
        path = open_ends.pop()
        name = path.relative_to(package).as_posix()
        if name not in found:
            found[name] = contents[path]
            open_ends += [imported for imported in _imported(package, contents[path]) if imported in contents]
    return found


def _imported(package: Path, content: bytes) -> Iterator[Path]:
    """The files that imports at the beginning of lines could mean: a name is a module, or something in one."""
    for module, names in _IMPORT.findall(content):
        folder = package.joinpath(*module.decode().split("."))
        yield folder.with_suffix(".py")
        yield folder / "__init__.py"
        for name in re.findall(r"\w+", names.decode()):
            yield folder / f"{name}.py"


@cache
def source_stamp(path: str) -> str:
    """A hash of a source file; empty where it cannot be read."""
    try:
        return hashlib.sha256(Path(path).read_bytes()).hexdigest()
    except OSError:
        return ""
