"""An executed copy made fit to be read by others: no path of this machine, no tool's cell shown."""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Iterator
from pathlib import Path

import nbformat
from nbformat import NotebookNode

from wheelset.publishing.errors import NotebookError

INJECTED = "injected-parameters"


def clean_copy(path: Path, root: Path) -> None:
    """Strip papermill's paths from the copy at `path` and hide the cell it injected.

    Raises:
        NotebookError: a cell shows a path of this machine.
    """
    notebook = nbformat.read(path, as_version=4)
    for name in ("input_path", "output_path", "environment_variables"):
        notebook.metadata.get("papermill", {}).pop(name, None)
    for cell in notebook.cells:
        if INJECTED in cell.metadata.get("tags", []):
            cell.metadata.tags = [*cell.metadata.tags, "hide-input"]
    refuse_machine_paths(notebook, path.stem.strip("."), private_folders(root))
    nbformat.write(notebook, path)


def private_folders(root: Path) -> tuple[Path, ...]:
    """Return the folders no page may name: the clone, the environment and the reader's home."""
    folders = (root.resolve(), Path(sys.prefix).resolve(), Path.home().resolve())
    return tuple(folder for folder in folders if folder != folder.parent)


def refuse_machine_paths(notebook: NotebookNode, name: str, folders: tuple[Path, ...]) -> None:
    """Raise NotebookError if any output of `notebook` names one of `folders`."""
    if not folders:
        return
    seen = re.compile("|".join(rf"(?<![\w./-]){re.escape(str(folder))}/" for folder in folders))
    for number, text in _output_texts(notebook):
        if match := seen.search(text):
            raise NotebookError(
                f"{name}: cell {number} shows a path of this machine, "
                f"...{text[match.start() : match.end() + 60]}... "
                "Print names relative to the folder the notebook runs in."
            )


def _output_texts(notebook: NotebookNode) -> Iterator[tuple[int, str]]:
    for number, cell in enumerate(notebook.cells, start=1):
        for output in cell.get("outputs", []):
            yield number, json.dumps(output, ensure_ascii=False)
