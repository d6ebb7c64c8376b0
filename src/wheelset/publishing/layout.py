"""Where the book's parts lie: the sources in the clone, and what is made of them."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import wheelset
from wheelset.publishing.errors import InputError

PACKAGE = Path(wheelset.__file__).parent


@dataclass(frozen=True)
class Layout:
    """The folders of one edition of the book.

    Attributes:
        root: the clone, with `notebooks/`, `_config.yml` and `_toc.yml`.
        stage: the folder handed to jupyter-book: the clone itself for the paper's edition.
        executed: where notebooks run, and where their copies, results and records stay.
        package: the package the notebooks compute with, hashed into every record.
    """

    root: Path
    stage: Path
    executed: Path
    package: Path = field(default_factory=lambda: PACKAGE)

    @property
    def sources(self) -> Path:
        """The folder of the notebooks without outputs."""
        return self.root / "notebooks"

    @property
    def lock(self) -> Path:
        """The pinned versions of every package."""
        return self.root / "requirements.lock"

    @property
    def build(self) -> Path:
        """The folder of the built pages and their record."""
        return self.stage / "_build"

    @property
    def site(self) -> Path:
        """The built pages."""
        return self.build / "html"

    def copy_of(self, stem: str) -> Path:
        """Return the path of the executed copy of notebook `stem`."""
        return self.executed / f"{stem}.ipynb"

    def failed_copy_of(self, stem: str) -> Path:
        """Return the path where a copy that stopped is kept for diagnosis."""
        return self.executed / f"{stem}.failed.ipynb"

    def results_of(self, stem: str) -> Path:
        """Return the folder of the tables and figures that notebook `stem` writes."""
        return self.executed / "results" / stem

    def record_of(self, stem: str) -> Path:
        """Return the path of the record beside the executed copy of `stem`."""
        return self.executed / "provenance" / f"{stem}.json"


def paper_edition(root: Path) -> Layout:
    """Return the layout of the book at the paper's resolution, built in the clone."""
    return Layout(root, stage=root, executed=root / "book" / "executed")


def quick_edition(root: Path) -> Layout:
    """Return the layout of the coarse preview, in a folder that shares nothing with the paper's."""
    stage = root / "_build-quick"
    return Layout(root, stage=stage, executed=stage / "book" / "executed")


def reader_edition(root: Path, folder: Path) -> Layout:
    """Return the layout of a reader's own run of one notebook in `folder`."""
    return Layout(root, stage=folder, executed=folder)


def find_root(start: Path) -> Path:
    """Return the clone that holds `start`, or else the one the package was installed from.

    Raises:
        InputError: neither lies in a clone of the book.
    """
    for folder in (start, *start.parents, PACKAGE.parent.parent):
        if (folder / "_toc.yml").is_file() and (folder / "notebooks").is_dir():
            return folder
    raise InputError(
        f"no book here: {start} lies in no folder with _toc.yml and notebooks/. "
        "Clone the project and run the command inside the clone."
    )
