"""What an executed copy was computed from: hashes of everything that can change its numbers."""

from __future__ import annotations

import hashlib
import json
import sys
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from wheelset.publishing.layout import Layout
from wheelset.publishing.notebooks import Source

# These rooms carry numbers to the reader and never make one.
_NOT_COMPUTING = {"publishing", "cli", "__main__.py", "__pycache__"}


def hash_bytes(data: bytes) -> str:
    """Return the SHA-256 of `data` in hexadecimal."""
    return hashlib.sha256(data).hexdigest()


def hash_file(path: Path) -> str:
    """Return the SHA-256 of the file's bytes, or `missing`."""
    return hash_bytes(path.read_bytes()) if path.is_file() else "missing"


def hash_json(value: Any) -> str:
    """Return the SHA-256 of `value` as JSON, whatever the order of its keys."""
    return hash_bytes(json.dumps(value, sort_keys=True).encode())


def hash_files(base: Path, paths: Iterable[Path]) -> str:
    """Return one SHA-256 over the names below `base` and the bytes of many files."""
    return hash_json({path.relative_to(base).as_posix(): hash_file(path) for path in paths})


def hash_package(package: Path) -> str:
    """Return the SHA-256 over all files of the package that can change a number, data included."""
    parts = [part for part in package.iterdir() if part.name not in _NOT_COMPUTING]
    files = [path for part in parts for path in (part.rglob("*") if part.is_dir() else [part])]
    return hash_files(package, (path for path in files if _counts(path)))


def _counts(path: Path) -> bool:
    return path.is_file() and "__pycache__" not in path.parts


def fingerprint(
    source: Source, parameters: Mapping[str, Any], layout: Layout, before: Iterable[str] = ()
) -> dict[str, str]:
    """Return the hashes a copy of `source` depends on, by the name of the thing hashed.

    Args:
        source: the notebook.
        parameters: what is injected into it, checked.
        layout: the folders of the edition.
        before: the notebooks whose results it reads; their records enter by hash.
    """
    return {
        "notebook": hash_file(source.path),
        "parameters": hash_json(dict(parameters)),
        "package": hash_package(layout.package),
        "lock": hash_file(layout.lock),
        "python": f"{sys.version_info.major}.{sys.version_info.minor}",
        **{f"results of {stem}": hash_file(layout.record_of(stem)) for stem in before},
        **{name: hash_file(layout.root / name) for name in source.reads},
    }
