"""Settings as they are written on the command line: KEY=VALUE."""

from __future__ import annotations

from collections.abc import Iterable

from sphear.errors import SphearError, quoted, shortened


def key_and_value(option: str, text: str, example: str) -> tuple[str, str]:
    """The two sides of KEY=VALUE; hyphens in the key are underscores.

    Raises:
        SphearError: there is no equals sign.
    """
    key, equals, value = text.partition("=")
    if not equals:
        form = "KEY=V1,V2,..." if "," in example else "KEY=VALUE"
        raise SphearError(f"{option} takes {form}, such as {option} {example}, not {quoted(text)}")
    return key.strip().replace("-", "_"), value.strip()


def changes(texts: Iterable[str]) -> dict[str, str]:
    """The settings that `--set` changes.

    Raises:
        SphearError: a key without a value, or given twice.
    """
    found: dict[str, str] = {}
    for text in texts:
        key, value = key_and_value("--set", text, "kernel=wendland_c2")
        if key in found:
            both = f"as {shortened(found[key])} and as {shortened(value)}"
            raise SphearError(f"--set {shortened(key)} is given twice, {both}: choose one")
        found[key] = value
    return found


def choices(texts: Iterable[str]) -> dict[str, list[str]]:
    """The values that `--over` goes through.

    Raises:
        SphearError: a key without values, with an empty one, or given twice.
    """
    over: dict[str, list[str]] = {}
    for text in texts:
        key, values = key_and_value("--over", text, "resolution=10,20,40")
        said = shortened(key)
        if key in over:
            raise SphearError(f"--over {said} is given twice: write all its values into one, separated by commas")
        over[key] = [value.strip() for value in _split(values)]
        if not all(over[key]):
            example = f"such as {said}=V1,V2, not {quoted(values)}"
            raise SphearError(f"--over {said} needs values separated by commas, {example}")
    return over


def _split(text: str) -> list[str]:
    """The parts between commas, but for those in brackets."""
    parts, depth = [""], 0
    for letter in text:
        depth += (letter in "([{") - (letter in ")]}")
        if letter == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += letter
    return parts
