"""Extensions that the command line names: a Python file or a module, imported here and by worker processes."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from importlib import import_module
from importlib.util import find_spec, module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType

from sphear.errors import SphearError, quoted
from sphear.extensions.failure import reason

_loaded: dict[str, ModuleType] = {}


def load(wanted: Iterable[str]) -> None:
    """Import extensions in turn, each once; their decorators register names.

    Args:
        wanted: paths of Python files, which end with `.py`, or names of modules. The folder of a file is where it
            finds modules beside it.

    Raises:
        SphearError: one cannot be imported, with its file, line and the reason.
    """
    for where in wanted:
        path = Path(where).expanduser().resolve() if where.endswith(".py") else None
        known = where if path is None else str(path)
        if known not in _loaded:
            _loaded[known] = _module(where) if path is None else _file(where, path)


def loaded() -> tuple[str, ...]:
    """The extensions imported so far, as a worker process imports them."""
    return tuple(_loaded)


def modules() -> tuple[ModuleType, ...]:
    """The modules of the extensions imported so far."""
    return tuple(_loaded.values())


def _module(name: str) -> ModuleType:
    try:
        return import_module(name)
    except ModuleNotFoundError as error:
        if error.name and f"{name}.".startswith(f"{error.name}."):
            raise SphearError(
                f"there is no extension {quoted(name)}: an extension is a Python file, such as my_terms.py, or a module"
            ) from None
        raise _failed(name, error, None) from error
    except (Exception, SystemExit) as error:
        raise _failed(name, error, None) from error


def _file(where: str, path: Path) -> ModuleType:
    if not path.is_file():
        raise SphearError(f"the extension {quoted(where)} cannot be imported: there is no such file")
    name = path.stem
    if "." in name or name in sys.modules or find_spec(name) is not None:
        there = getattr(sys.modules.get(name), "__file__", None)
        if there is not None and Path(there).resolve() == path:  # imported by a program
            return sys.modules[name]
        if not (there is None and _beside(name, path)):
            raise SphearError(
                f"the extension {quoted(where)} cannot be imported: {quoted(name)} is no free name of a module, so give"
                " the file another"
            )
    spec = spec_from_file_location(name, path)
    assert spec is not None
    assert spec.loader is not None
    module = module_from_spec(spec)
    sys.modules[name] = module  # what is pickled is found there
    if str(path.parent) not in sys.path:
        sys.path.append(str(path.parent))
    try:
        spec.loader.exec_module(module)
    except (Exception, SystemExit) as error:
        del sys.modules[name]
        raise _failed(where, error, str(path)) from error
    return module


def _beside(name: str, path: Path) -> bool:
    """A file that would be found by its name too, because its folder is on the path."""
    if name in sys.modules or "." in name:
        return False
    spec = find_spec(name)
    return spec is not None and spec.origin is not None and Path(spec.origin).resolve() == path


def _failed(where: str, error: BaseException, file: str | None) -> SphearError:
    return SphearError(f"the extension {quoted(where)} cannot be imported: {reason(error, file)}")
