"""The pages: jupyter-book over copies whose records hold, warnings being errors.

The site is always built whole, in a folder aside, because Sphinx warns only about pages it
reads: a second, incremental build would pass over the warning that failed the first.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import yaml

from wheelset.publishing.child import listen
from wheelset.publishing.errors import BookError, StaleError
from wheelset.publishing.fingerprint import hash_file, hash_files, hash_json
from wheelset.publishing.layout import Layout

_PAGES = re.compile(r"(?:reading sources|writing output)\.\.\. \[ *(\d+)%\]")
_COLOUR = re.compile(r"\x1b\[[0-9;]*m")  # jupyter-book colours its words even into a pipe
_START = "from jupyter_book.cli.main import main; main()"  # the package has no __main__
_STRICT = ("-W", "-n", "--keep-going")
# What a page needs of MathJax: the engine, its fonts, macros loaded on demand, its menu's helpers.
_MATHJAX = ("tex-chtml.js", "output/", "input/tex/extensions/", "a11y/", "sre/mathmaps/en.json")


def pages(layout: Layout) -> tuple[str, ...]:
    """Return the files of the table of contents, in reading order, without their suffix."""
    return tuple(_files(yaml.safe_load((layout.stage / "_toc.yml").read_text("utf-8"))))


def _files(entry: Any) -> Iterator[str]:
    if isinstance(entry, list):
        for part in entry:
            yield from _files(part)
    elif isinstance(entry, dict):
        yield from (entry[key] for key in ("root", "file") if key in entry)
        for key in ("parts", "chapters", "sections"):
            yield from _files(entry.get(key, []))


def check_pages(layout: Layout, why_stale: Callable[[str], str | None]) -> None:
    """Raise StaleError unless every page of the table of contents may be published.

    Args:
        layout: the folders of the edition.
        why_stale: says in words why the copy of a notebook may not be published.
    """
    complaints = [_complaint(layout, page, why_stale) for page in pages(layout)]
    if any(complaints):
        raise StaleError("not published:\n" + "\n".join(filter(None, complaints)))


def _complaint(layout: Layout, page: str, why_stale: Callable[[str], str | None]) -> str | None:
    path = layout.stage / page
    if path.parent == layout.executed:
        reason = why_stale(path.name)
        return f"  {page}: {reason}" if reason else None
    found = any(path.with_name(path.name + suffix).is_file() for suffix in (".md", ".ipynb"))
    return None if found else f"  {page}: _toc.yml names it, but there is no such page"


def site_fingerprint(layout: Layout) -> str:
    """Return one hash over everything the pages are made of: settings, prose, records, tool."""
    prose = [path for path in (layout.stage / "book").rglob("*") if path.is_file()]
    made = [path for path in prose if layout.executed in path.parents]
    records = sorted((layout.executed / "provenance").glob("*.json"))
    settings = [layout.stage / "_config.yml", layout.stage / "_toc.yml"]
    own = sorted(set(prose) - set(made))
    return hash_json(
        [hash_files(layout.stage, [*settings, *own, *records]), hash_file(layout.lock)]
    )


def why_site_stale(layout: Layout) -> str | None:
    """Return in words why the pages must be built again, or None if they need not."""
    note = layout.build / "site.json"
    if not (layout.site / "index.html").is_file() or not note.is_file():
        return "never built"
    known = json.loads(note.read_text("utf-8")).get("fingerprint")
    return None if known == site_fingerprint(layout) else "a page or a setting changed"


def build_site(
    layout: Layout, advanced: Callable[[int, int], None], *, strict: bool = True
) -> Path:
    """Build the pages aside, then put them in place; return the path of `index.html`.

    Args:
        layout: the folders of the edition.
        advanced: called with the per cent of pages done, and 100.
        strict: let a warning fail the build.

    Raises:
        BookError: jupyter-book failed or, if strict, warned.
    """
    aside = layout.build / "next"
    shutil.rmtree(aside, ignore_errors=True)
    before = site_fingerprint(layout)
    _jupyter_book(layout, aside, advanced, strict)
    trim_mathjax(aside / "_build" / "html" / "_static" / "mathjax")
    shutil.rmtree(layout.site, ignore_errors=True)
    (aside / "_build" / "html").replace(layout.site)
    shutil.rmtree(aside)
    (layout.build / "site.json").write_text(json.dumps({"fingerprint": before}), "utf-8")
    return layout.site / "index.html"


def _jupyter_book(
    layout: Layout, aside: Path, advanced: Callable[[int, int], None], strict: bool
) -> None:
    command = [sys.executable, "-c", _START, "build", str(layout.stage)]
    options = ["--path-output", str(aside), *(_STRICT if strict else ())]
    said: list[str] = []

    def heard(line: str) -> None:
        said.append(_COLOUR.sub("", line))
        if match := _PAGES.search(line):
            advanced(int(match[1]), 100)

    env = dict(os.environ)
    code = listen(
        [*command, *options], heard, cwd=str(layout.stage), env=env, stderr=subprocess.STDOUT
    )
    if code != 0:
        raise BookError("the pages could not be built:\n" + "\n".join(_reasons(said)))


def _reasons(said: list[str]) -> list[str]:
    """Return the lines that say what is wrong, or the last ones where none does."""
    telling = [line for line in said if re.search(r"WARNING|ERROR|[Ee]xception", line)]
    return telling or said[-20:]


def trim_mathjax(folder: Path) -> None:
    """Delete the files of the bundled MathJax that no page can ask for (22 of its 24 MB)."""
    for path in sorted(folder.rglob("*"), reverse=True):
        name = path.relative_to(folder).as_posix()
        if path.is_file() and not name.startswith(_MATHJAX):
            path.unlink()
        elif path.is_dir() and not any(path.iterdir()):
            path.rmdir()
