"""A clone in a temporary folder: one toy notebook, its study, a lock and a package to hash."""

from __future__ import annotations

import sys
from pathlib import Path
from types import ModuleType
from typing import Literal

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook
from pydantic import BaseModel, ConfigDict, Field

from wheelset.publishing.book import Edition
from wheelset.publishing.layout import Layout, paper_edition
from wheelset.publishing.notebooks import find_sources


class Parameters(BaseModel):
    """Parameters of the toy study."""

    model_config = ConfigDict(extra="forbid")

    speed: float = Field(default=2.0, gt=0, le=100, description="forward speed in m/s")
    vehicle: str = Field(default="guo2021", description="packaged name or TOML file")
    resolution: Literal["quick", "paper"] = Field(default="paper", description="grid")


PARAMETERS = (
    'speed: float = 2.0  # forward speed in m/s\nvehicle: str = "guo2021"  # name or file\n'
    'resolution: str = "paper"  # grid'
)
WORK = (
    "from pathlib import Path\n"
    'folder = Path("results/1_toy")\n'
    "folder.mkdir(parents=True)\n"
    '(folder / "comparison.csv").write_text(f"{speed},{resolution}\\n")\n'
    'print("twice the speed is", 2 * speed)'
)


def write_notebook(path: Path, cells: list[str], **facts: object) -> Path:
    """Write a notebook: the first code cell is tagged `parameters` if it names a study."""
    notebook = new_notebook()
    notebook.metadata = {"kernelspec": {"name": "python3", "display_name": "Python 3"}}
    notebook.metadata["wheelset"] = facts
    codes = [new_code_cell(code, id=f"c{number}") for number, code in enumerate(cells)]
    if "study" in facts:
        codes[0].metadata["tags"] = ["parameters"]
    notebook.cells = [new_markdown_cell(f"# {path.stem}", id="title"), *codes]
    path.parent.mkdir(parents=True, exist_ok=True)
    nbformat.write(notebook, path)
    return path


@pytest.fixture
def clone(tmp_path, monkeypatch) -> Path:
    """Return the root of a small clone whose one notebook is `1_toy`."""
    study = ModuleType("wheelset.studies.toy")
    study.Parameters = Parameters
    monkeypatch.setitem(sys.modules, "wheelset.studies.toy", study)
    root = tmp_path / "clone"
    write_notebook(
        root / "notebooks" / "1_toy.ipynb",
        [PARAMETERS, WORK],
        study="toy",
        outputs=["results/1_toy/comparison.csv"],
    )
    (root / "requirements.lock").write_text("numpy==2.0\n", "utf-8")
    (root / "_config.yml").write_text("title: Toy\nexecute: {execute_notebooks: 'off'}\n", "utf-8")
    (root / "_toc.yml").write_text("format: jb-book\nroot: book/executed/1_toy\n", "utf-8")
    (root / "book").mkdir()
    package = root / "package"
    monkeypatch.setattr("wheelset.publishing.layout.PACKAGE", package)
    (package / "physics").mkdir(parents=True)
    (package / "physics" / "model.py").write_text("mass = 1.0\n", "utf-8")
    (package / "physics" / "vehicle.toml").write_text("mass = 1.0\n", "utf-8")
    return root


@pytest.fixture
def layout(clone) -> Layout:
    return paper_edition(clone)


@pytest.fixture
def whole(layout) -> Edition:
    sources = find_sources(layout.sources)
    return Edition(layout, sources, {source.stem: {} for source in sources})


class Listener:
    """Remembers what it was told, as `(what, name)` pairs and texts."""

    def __init__(self) -> None:
        self.told: list[tuple[str, str]] = []
        self.texts: list[str] = []

    def started(self, name, reason):
        self.told.append(("started", name))
        self.texts.append(reason)

    def advanced(self, name, done, total):
        self.told.append(("advanced", name))

    def finished(self, name, seconds):
        self.told.append(("finished", name))

    def unchanged(self, name):
        self.told.append(("unchanged", name))

    def failed(self, name, message):
        self.told.append(("failed", name))
        self.texts.append(message)


@pytest.fixture
def listener() -> Listener:
    return Listener()
