"""The manual as a whole: links and pictures lead somewhere, names and settings are all there."""

from __future__ import annotations

import inspect
import re
from functools import cache
from pathlib import Path

import pytest

import sphear
from sphear.cli.settings_page import settings_page

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
PAGES = [ROOT / "README.md", ROOT / "CHANGELOG.md", *sorted(DOCS.rglob("*.md"))]
LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
FENCE = re.compile(r"^```.*?^```$|`[^`\n]*`", re.MULTILINE | re.DOTALL)
CITED = re.compile(r"docs/[\w./-]+\.md")
NO_FIRST_WORDS = {"What", "Whether", "Which", "Those", "How"}


@cache
def prose(page: Path) -> str:
    """A page without its code."""
    return FENCE.sub("", page.read_text(encoding="utf-8"))


@cache
def anchors(page: Path) -> set[str]:
    """The fragments that the headings of a page have, as GitHub makes them."""
    text = re.sub(r"^```.*?^```$", "", page.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)
    headings = re.findall(r"^#+ (.*)$", text, re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading).strip().lower().replace(" ", "-") for heading in headings}


def leads_nowhere(page: Path, link: str) -> bool:
    """True of a relative link without its file, or without its heading there."""
    path, _, anchor = link.partition("#")
    target = (page.parent / path).resolve() if path else page
    return not target.exists() or (bool(anchor) and (target.suffix != ".md" or anchor not in anchors(target)))


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_links_and_pictures_lead_somewhere(page: Path) -> None:
    links = [link for link in LINK.findall(prose(page)) if "://" not in link]
    assert [link for link in links if leads_nowhere(page, link)] == []
    assert [path for path in CITED.findall(page.read_text(encoding="utf-8")) if not (ROOT / path).exists()] == []


def test_links_that_lead_nowhere_are_seen() -> None:
    page = DOCS / "README.md"
    wrong = ("nowhere.md", "tutorial.md#nothing", "images/none.png", "#nothing", "images/dam-break.png#nothing")
    assert all(leads_nowhere(page, link) for link in wrong)
    right = ("tutorial.md#1-install", "images/dam-break.png", "#the-manual", "examples")
    assert not any(leads_nowhere(page, link) for link in right)


def test_every_page_is_in_the_index() -> None:
    index = {(DOCS / link.partition("#")[0]).resolve() for link in LINK.findall(prose(DOCS / "README.md"))}
    pages = {page for page in PAGES if DOCS in page.parents and page.parent != DOCS / "examples"}
    elsewhere = {DOCS / "README.md", DOCS / "package-index.md"}  # the index, and a package index's description
    assert pages - elsewhere - index == set()


def test_pages_that_are_cited_by_programs_are_there() -> None:
    programs = [
        path for folder in ("src", "validation", "benchmarks", "examples") for path in (ROOT / folder).rglob("*.py")
    ]
    cited = {
        (str(path.relative_to(ROOT)), page)
        for path in programs
        for page in CITED.findall(path.read_text(encoding="utf-8"))
    }
    assert len(cited) >= 4
    assert [(path, page) for path, page in sorted(cited) if not (ROOT / page).exists()] == []


@pytest.mark.parametrize("folder", ["how-to", "theory", "measurements"])
def test_every_page_leads_to_the_glossary(folder: str) -> None:
    pages = list((DOCS / folder).glob("*.md"))
    assert len(pages) >= 6
    assert [page.name for page in pages if "(../reference/glossary.md)" not in page.read_text(encoding="utf-8")] == []


def test_every_public_name_is_listed_once_and_no_other() -> None:
    rows = re.findall(r"^\| (`.*?`) \|", (DOCS / "reference" / "names.md").read_text(encoding="utf-8"), re.MULTILINE)
    listed = [name for row in rows for name in re.findall(r"`(\w+)`", row)]
    assert sorted(listed) == sorted(sphear.__all__)


@pytest.mark.parametrize("name", [name for name in sphear.__all__ if name != "__version__"])
def test_every_public_name_says_in_its_docstring_what_it_is(name: str) -> None:
    said = inspect.getdoc(getattr(sphear, name))
    assert said is not None
    assert said.split()[0] not in NO_FIRST_WORDS


def test_the_page_of_settings_is_up_to_date() -> None:
    page = DOCS / "reference" / "settings.md"
    assert page.read_text(encoding="utf-8") == settings_page(), "run python validation/settings_page.py"
