"""Notebook sources: what they are called, what they need and what they promise to write.

A source tells the publisher about itself in its notebook metadata::

    "wheelset": {"study": "flange_models",                          # wheelset.studies.<study>
                 "after": ["2_model"],                              # or ["*"]: every plain notebook
                 "outputs": ["results/3_flange_models/comparison.csv"]}

All three are optional.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import nbformat

from wheelset.publishing.errors import InputError, did_you_mean

ALL = "*"
_KEYS = {"study", "after", "outputs", "reads"}


@dataclass(frozen=True)
class Source:
    """One notebook without outputs.

    Attributes:
        path: the `.ipynb` file.
        study: the module of `wheelset.studies` whose `Parameters` the notebook takes, if any.
        after: notebooks whose results it reads; `*` stands for all that name no `*` themselves.
        outputs: files it must have written, relative to the folder it runs in.
        reads: further files it reads, relative to the project's folder.
        cells: how many cells it has.
    """

    path: Path
    study: str | None = None
    after: tuple[str, ...] = ()
    outputs: tuple[str, ...] = ()
    reads: tuple[str, ...] = ()
    cells: int = 0

    @property
    def stem(self) -> str:
        """The notebook's name, as in `3_flange_models`."""
        return self.path.stem


def read_source(path: Path) -> Source:
    """Return what the notebook at `path` says about itself.

    Raises:
        InputError: an unknown key in its `wheelset` metadata.
    """
    notebook = nbformat.read(path, as_version=4)
    facts: dict[str, Any] = dict(notebook.metadata.get("wheelset", {}))
    for key in facts.keys() - _KEYS:
        raise InputError(
            f"{path.name}: metadata `wheelset.{key}` is unknown{did_you_mean(key, _KEYS)} "
            f"Allowed: {', '.join(sorted(_KEYS))}."
        )
    return Source(
        path=path,
        study=facts.get("study"),
        after=tuple(facts.get("after", ())),
        outputs=tuple(facts.get("outputs", ())),
        reads=tuple(facts.get("reads", ())),
        cells=len(notebook.cells),
    )


def find_sources(folder: Path) -> tuple[Source, ...]:
    """Return all notebooks of `folder` in the order of their names."""
    return tuple(read_source(path) for path in sorted(folder.glob("*.ipynb")))


def find_source(folder: Path, name: str) -> Source:
    """Return the one notebook called `name`, with or without suffix, or by its unique start.

    Raises:
        InputError: none or several are meant.
    """
    stems = sorted(path.stem for path in folder.glob("*.ipynb"))
    stem = Path(name).name.removesuffix(".ipynb")
    meant = [stem] if stem in stems else [known for known in stems if known.startswith(stem)]
    if len(meant) != 1:
        raise InputError(
            f"no single notebook is called `{name}`{did_you_mean(stem, stems)}; "
            f"there are: {', '.join(stems)}."
        )
    return read_source(folder / f"{meant[0]}.ipynb")


def upstream(source: Source, sources: Sequence[Source]) -> tuple[str, ...]:
    """Return the names of the notebooks that must run before `source`.

    Raises:
        InputError: it waits for a notebook that does not exist.
    """
    stems = {other.stem for other in sources}
    plain = [other.stem for other in sources if ALL not in other.after]
    named = [stem for stem in source.after if stem != ALL]
    for stem in named:
        if stem not in stems:
            raise InputError(
                f"{source.stem} runs after `{stem}`, which is no notebook"
                f"{did_you_mean(stem, stems)}"
            )
    return tuple(dict.fromkeys([*(plain if ALL in source.after else []), *named]))
