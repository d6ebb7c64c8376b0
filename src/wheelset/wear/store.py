"""Accepted states of a simulation in a folder, so that an interrupted one goes on where it was.

``settings.json`` says what was simulated; ``run/`` and ``asked/`` hold a file a state. A file
is written beside and moved, so that none is ever half there; numbers are kept to the bit, so
that a resumed simulation gives those of an uninterrupted one.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any, Literal

import numpy as np

from wheelset.wear.stepping import State

Stage = Literal["run", "asked"]


@dataclass(frozen=True)
class Store:
    """A folder of states, or none: then nothing is kept."""

    folder: Path | None = None

    @classmethod
    def open(cls, folder: Path, settings: dict[str, Any]) -> Store:
        """For these settings; ValueError naming what differs if the folder holds others."""
        path = folder / "settings.json"
        text = json.dumps(settings, indent=2, ensure_ascii=False) + "\n"
        if path.is_file():
            _compare(path, json.loads(text))
        else:
            folder.mkdir(parents=True, exist_ok=True)
            write_whole(path, text.encode())
        return cls(folder)

    def keep(self, stage: Stage, state: State) -> None:
        """Write a state."""
        if self.folder is None:
            return
        path = self.folder / stage / f"{state.number:06d}.npz"
        path.parent.mkdir(exist_ok=True)
        part = path.with_name(path.name + ".part")
        with part.open("wb") as file:
            arrays: dict[str, Any] = {f.name: getattr(state, f.name) for f in fields(State)}
            np.savez(file, **arrays)
        part.replace(path)

    def kept(self, stage: Stage) -> list[State]:
        """The states of a stage, in order; ValueError naming a file that cannot be read."""
        if self.folder is None:
            return []
        paths = sorted((self.folder / stage).glob("[0-9]*.npz"))
        states = [_read(path) for path in paths]
        if [state.number for state in states] != list(range(len(states))):
            raise ValueError(f"{self.folder / stage}: states are missing; start in a new folder")
        return states


#: Keeps nothing.
NOWHERE = Store()


def write_whole(path: Path, content: bytes) -> None:
    """A file that is there as a whole or not at all."""
    part = path.with_name(path.name + ".part")
    part.write_bytes(content)
    part.replace(path)


def _read(path: Path) -> State:
    try:
        with np.load(path) as kept:
            values = {f.name: kept[f.name] for f in fields(State)}
    except (OSError, ValueError, KeyError, EOFError) as error:
        raise ValueError(f"{path} is no state: {error}; delete it and those after it") from error
    return State(
        float(values["distance"]),
        values["depth"],
        values["rate"],
        float(values["step"]),
        float(values["error"]),
        int(values["number"]),
    )


def _compare(path: Path, wanted: dict[str, Any]) -> None:
    try:
        found = json.loads(path.read_text("utf-8"))
    except ValueError as error:
        raise ValueError(f"{path} cannot be read: {error}; choose another folder") from error
    differences = list(_differences("", found, wanted))
    if differences:
        raise ValueError(
            f"{path.parent} holds another simulation: {'; '.join(differences[:4])}; choose another "
            "folder or the same settings"
        )


def _differences(name: str, found: Any, wanted: Any) -> Iterator[str]:
    """What differs, in words, by the names on the way to it."""
    if isinstance(found, dict) and isinstance(wanted, dict):
        for key in {**found, **wanted}:
            inner = f"{name}.{key}" if name else key
            yield from _differences(inner, found.get(key), wanted.get(key))
    elif found != wanted:
        yield f"{name} is {found} there and {wanted} here"
