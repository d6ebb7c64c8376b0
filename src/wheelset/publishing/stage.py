"""Folders for editions other than the paper's: the same prose and settings, marked as a preview."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import yaml

from wheelset.publishing.layout import Layout
from wheelset.publishing.notebooks import Source

QUICK = "Quick preview at coarse resolution: these are not the numbers of the book."


def stage_quick(layout: Layout) -> None:
    """Copy prose and settings of the clone into the stage, with a banner on every page."""
    made = layout.stage / "book"
    for old in made.glob("*") if made.exists() else ():
        if old != layout.executed:
            _remove(old)
    ignore = shutil.ignore_patterns("executed*", "_build*", ".*")
    shutil.copytree(layout.root / "book", made, ignore=ignore, dirs_exist_ok=True)
    data = layout.root / "src" / "wheelset" / "data"
    if data.is_dir():  # the prose shows vehicle files by including them
        shutil.copytree(data, layout.stage / "src" / "wheelset" / "data", dirs_exist_ok=True)
    shutil.copy2(layout.root / "_toc.yml", layout.stage / "_toc.yml")
    _write_settings(layout, _settings(layout.root), QUICK)


def stage_reader(layout: Layout, source: Source) -> None:
    """Make a book of the one notebook a reader has run with parameters of his own."""
    layout.stage.mkdir(parents=True, exist_ok=True)
    for name in ("_static", "references.bib"):
        origin = layout.root / "book" / name
        if origin.is_dir():
            shutil.copytree(origin, layout.stage / "book" / name, dirs_exist_ok=True)
        elif origin.is_file():
            (layout.stage / "book").mkdir(exist_ok=True)
            shutil.copy2(origin, layout.stage / "book" / name)
    toc = {"format": "jb-book", "root": source.stem}
    (layout.stage / "_toc.yml").write_text(yaml.safe_dump(toc), "utf-8")
    _write_settings(layout, _settings(layout.root), f"A run of {source.stem} by a reader.")


def _settings(root: Path) -> dict[str, Any]:
    settings: dict[str, Any] = yaml.safe_load((root / "_config.yml").read_text("utf-8"))
    return settings


def _write_settings(layout: Layout, settings: dict[str, Any], banner: str) -> None:
    config = settings.setdefault("sphinx", {}).setdefault("config", {})
    config.setdefault("html_theme_options", {})["announcement"] = banner
    text = yaml.safe_dump(settings, sort_keys=False, allow_unicode=True)
    (layout.stage / "_config.yml").write_text(text, "utf-8")


def _remove(path: Path) -> None:
    if path.is_dir():
        shutil.rmtree(path)
    else:
        path.unlink()
