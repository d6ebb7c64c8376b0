"""The record beside each executed copy: what it was computed from, with what, when, how long.

A copy is published only while its record holds: every hash in the fingerprint is still what it
was, and every file the run produced is still there, unchanged.
"""

from __future__ import annotations

import importlib.metadata
import json
import os
import platform
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ConfigDict, ValidationError

from wheelset.publishing.fingerprint import hash_file
from wheelset.publishing.layout import Layout

_SHOWN = ("numpy", "scipy", "sympy", "numba", "pandas", "matplotlib", "papermill", "jupyter-book")


class Record(BaseModel):
    """What one execution of a notebook depended on and produced.

    Attributes:
        notebook: its name.
        parameters: every parameter it ran with.
        fingerprint: hash of each thing it was computed from.
        products: hash of the executed copy and of each file below `results/<notebook>/`.
        started: start time, UTC, ISO 8601.
        seconds: run time in s.
        python: version of the interpreter.
        platform: operating system and processor, without the name of the machine.
        packages: versions of the packages that make the numbers and the pages.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    notebook: str
    parameters: dict[str, Any]
    fingerprint: dict[str, str]
    products: dict[str, str]
    started: str
    seconds: float
    python: str
    platform: str
    packages: dict[str, str]


def environment() -> dict[str, Any]:
    """Return the fields of a record that describe the interpreter and the machine."""
    return {
        "python": platform.python_version(),
        "platform": f"{platform.system()} {platform.machine()}, {os.cpu_count()} cores",
        "packages": {name: _version(name) for name in ("wheelset", *_SHOWN)},
    }


def _version(name: str) -> str:
    try:
        return importlib.metadata.version(name)
    except importlib.metadata.PackageNotFoundError:
        return "not installed"


def products(layout: Layout, stem: str) -> dict[str, str]:
    """Return the hash of the executed copy and of every result file, by path from `executed`."""
    files = [layout.copy_of(stem), *sorted(layout.results_of(stem).rglob("*"))]
    return {
        path.relative_to(layout.executed).as_posix(): hash_file(path)
        for path in files
        if path.is_file()
    }


def write_record(layout: Layout, record: Record) -> None:
    """Write `record` beside its copy, in one step."""
    path = layout.record_of(record.notebook)
    path.parent.mkdir(parents=True, exist_ok=True)
    new = path.with_suffix(".new")
    new.write_text(record.model_dump_json(indent=1) + "\n", encoding="utf-8")
    new.replace(path)


def read_record(path: Path) -> Record | None:
    """Return the record at `path`, or None where there is none that can be read."""
    try:
        return Record.model_validate(json.loads(path.read_text(encoding="utf-8")))
    except (FileNotFoundError, json.JSONDecodeError, ValidationError):
        return None


def why_stale(layout: Layout, stem: str, now: Mapping[str, str]) -> str | None:
    """Return in words why the copy of `stem` may not be published, or None if it may.

    Args:
        layout: the folders of the edition.
        stem: the notebook's name.
        now: its fingerprint as of now.
    """
    record = read_record(layout.record_of(stem))
    if record is None:
        return "never executed"
    changed = [name for name in now if record.fingerprint.get(name) != now[name]]
    if changed or record.fingerprint.keys() != now.keys():
        return f"changed: {', '.join(changed) or 'what it depends on'}"
    lost = [name for name, known in record.products.items() if _differs(layout, name, known)]
    return f"missing or altered: {', '.join(lost)}" if lost else None


def _differs(layout: Layout, name: str, known: str) -> bool:
    return hash_file(layout.executed / name) != known
