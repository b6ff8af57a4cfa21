"""Modules import only what stands before them in the layout of docs/architecture.md, and none in a circle."""

import ast
import re
from collections.abc import Iterator
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
SOURCE = ROOT / "src" / "sphear"
FRONT = {"sphear", "sphear.__main__"}  # the package's own face: everything under short names


def module_name(path: Path) -> str:
    parts = path.relative_to(SOURCE.parent).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


MODULES = {module_name(path): path for path in sorted(SOURCE.rglob("*.py"))}


def statements(body: list[ast.stmt]) -> Iterator[ast.stmt]:
    """The statements that run when a module is imported: no function's, and none for types alone."""
    for node in body:
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            continue
        if isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test):
            yield from statements(node.orelse)
            continue
        yield node
        for part in ("body", "orelse", "finalbody"):
            yield from statements(getattr(node, part, []))
        for handler in getattr(node, "handlers", []):
            yield from statements(handler.body)


def imports(text: str) -> set[str]:
    """The modules of the package that a text imports, those of the folders that they are in among them."""
    found = set()
    for node in statements(ast.parse(text).body):
        if isinstance(node, ast.ImportFrom):
            assert node.level == 0, "imports name the whole module"
            found |= {node.module or ""} | {f"{node.module}.{name.name}" for name in node.names}
        elif isinstance(node, ast.Import):
            found |= {name.name for name in node.names}
    parts = [name.split(".") for name in found]
    return {".".join(each[:n]) for each in parts for n in range(1, len(each) + 1)} & set(MODULES)


def circle(graph: dict[str, set[str]]) -> list[str]:
    """The names of one circle in a graph; none if it has no circle."""
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        return list(error.args[1])
    return []


def layers() -> list[str]:
    """The modules and folders of the layout, `engine/backends` for example, in their order."""
    layout = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8").split("```")[1]
    assert layout.splitlines()[1] == "src/sphear/"
    found: list[str] = []
    for line in layout.splitlines()[2:]:
        if not line.startswith("  "):
            break
        names = re.split(r"\s{2,}", line.strip())[0]
        found += [name.removesuffix(".py").rstrip("/").replace("/", ".") for name in names.split()]
    return found


def layer_of(module: str, known: list[str]) -> str:
    """The longest of the known names that a module is under."""
    under = [name for name in known if f"{module}.".startswith(f"sphear.{name}.")]
    assert under, f"{module} is not in the layout of docs/architecture.md"
    return max(under, key=len)


GRAPH = {
    module: {
        name for name in imports(path.read_text(encoding="utf-8")) - FRONT if not f"{module}.".startswith(f"{name}.")
    }
    for module, path in MODULES.items()
    if module not in FRONT
}


def test_no_module_imports_itself_through_others() -> None:
    assert len(GRAPH) > 350
    assert circle(GRAPH) == []


def test_modules_import_what_stands_before_them() -> None:
    known = layers()
    assert len(known) == len(set(known)) > 30
    place = {module: known.index(layer_of(module, known)) for module in GRAPH}
    wrong = [f"{a} imports {b}" for a, found in GRAPH.items() for b in sorted(found) if place[a] < place[b]]
    assert wrong == []


@pytest.mark.parametrize(
    ("text", "seen"),
    [
        ("import sphear.names", True),
        ("from sphear import names", True),
        ("try:\n    pass\nexcept ImportError:\n    from sphear.names import plain", True),
        ("class A:\n    from sphear.names import plain", True),
        ("from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from sphear.names import plain", False),
        ("def late():\n    from sphear.names import plain", False),
    ],
)
def test_imports_are_those_that_run_at_once(text: str, seen: bool) -> None:
    assert ("sphear.names" in imports(text)) is seen


def test_a_circle_is_found() -> None:
    assert set(circle({"a": {"b"}, "b": {"c"}, "c": {"a"}})) == {"a", "b", "c"}
