"""Vehicle files: finding them, reading their TOML, following ``extends``.

title = "My vehicle"
extends = "guo2021"            # a packaged vehicle, or a path relative to this file

[suspension]
Kpx = "1.2 MN/m"               # or 1.2e6, or {value = 1.2, unit = "MN/m", source = "data sheet"}

[model]
flange_law = "exponential"
"""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any

from wheelset.vehicle.options import option_names
from wheelset.vehicle.parameters import BY_NAME, PARAMETERS, TABLES
from wheelset.vehicle.problems import Problems, VehicleError, did_you_mean
from wheelset.vehicle.statements import Statement, Statements

MODEL_TABLE = "model"
HEADINGS = ("title", "description", "extends")


@dataclass(frozen=True)
class Document:
    """The content of one vehicle file; ``folder`` is None for a packaged one."""

    name: str
    label: str
    folder: Path | None
    content: dict[str, Any]

    @property
    def tables(self) -> dict[str, dict[str, Any]]:
        """The known tables of the file."""
        known = (*TABLES, MODEL_TABLE)
        return {k: t for k, t in self.content.items() if k in known and isinstance(t, dict)}


@cache
def vehicle_names() -> tuple[str, ...]:
    """Names of the packaged vehicles, in alphabetical order."""
    names = (entry.name for entry in _packaged().iterdir())
    return tuple(sorted(name.removesuffix(".toml") for name in names if name.endswith(".toml")))


def document_chain(name_or_path: str | Path) -> tuple[Document, ...]:
    """The named document and those it extends, the most basic first.

    Raises VehicleError if one is not found, is no TOML, or extends itself.
    """
    chain = [_open(str(name_or_path), folder=None)]
    while "extends" in chain[0].content:
        base = _base(chain[0])
        if any((base.folder, base.label) == (seen.folder, seen.label) for seen in chain):
            circle = " -> ".join(d.label for d in (*reversed(chain), base))
            raise VehicleError([f"extends goes in a circle: {circle}"], chain[-1].label)
        chain.insert(0, base)
    return tuple(chain)


def check_fields(document: Document, problems: Problems) -> None:
    """Note every table and field that the model does not know."""
    known = (*HEADINGS, *TABLES, MODEL_TABLE)
    for key, value in document.content.items():
        if key not in known:
            problems.add(_unknown_table(key))
        elif key in HEADINGS and not isinstance(value, str):
            problems.add(f"{key} must be a text in quotes, not {value!r}")
        elif key not in HEADINGS and not isinstance(value, dict):
            problems.add(f"[{key}] must be a table, not {value!r}")
    for table, fields in document.tables.items():
        problems.add(*(_unknown_field(table, f) for f in fields if f not in _fields_of(table)))


def statements_of(chain: tuple[Document, ...]) -> Statements:
    """What the documents say together; a later one wins over those it extends."""
    statements = Statements({}, {})
    for document in chain:
        for table, fields in document.tables.items():
            known = {key: fields[key] for key in fields if key in _fields_of(table)}
            if table == MODEL_TABLE:
                statements.options.update(known)
            else:
                origin = document.label
                statements.parameters.update(
                    {key: Statement(entry, origin) for key, entry in known.items()}
                )
    return statements


def _fields_of(table: str) -> tuple[str, ...]:
    if table == MODEL_TABLE:
        return option_names()
    return tuple(parameter.name for parameter in PARAMETERS if parameter.table == table)


def _unknown_table(key: str) -> str:
    if key in BY_NAME:
        return f"{key} stands outside its table; write it under [{BY_NAME[key].table}]"
    tables = (*TABLES, MODEL_TABLE)
    return (
        f'unknown table or key "{key}"{did_you_mean(key, (*HEADINGS, *tables))}; '
        f"tables: {', '.join(tables)}; keys: {', '.join(HEADINGS)}"
    )


def _unknown_field(table: str, field: str) -> str:
    if field in BY_NAME:
        return f"{table}.{field}: {field} belongs to [{BY_NAME[field].table}]"
    fields = _fields_of(table)
    hint = did_you_mean(field, fields) or did_you_mean(field, BY_NAME)
    return f"{table}.{field}: unknown field{hint}; [{table}] holds {', '.join(fields)}"


def _packaged() -> Any:
    return files("wheelset.data").joinpath("vehicles")


def _base(document: Document) -> Document:
    extends = document.content["extends"]
    if not isinstance(extends, str):
        raise VehicleError([f"extends must be a text in quotes, not {extends!r}"], document.label)
    return _open(extends, document.folder)


def _open(name: str, folder: Path | None) -> Document:
    if name in vehicle_names():
        text = _packaged().joinpath(f"{name}.toml").read_text(encoding="utf-8")
        return Document(name, f"{name}.toml", None, _parsed(text, f"{name}.toml"))
    path = (folder or Path()) / name
    if not path.is_file():
        raise VehicleError([_not_found(name)])
    return Document(path.stem, path.name, path.parent.resolve(), _read(path))


def _not_found(name: str) -> str:
    if name.endswith(".toml") or "/" in name or "\\" in name:
        return f'vehicle file "{name}" does not exist'
    names = vehicle_names()
    return (
        f'unknown vehicle "{name}"{did_you_mean(name, names)}; packaged vehicles: '
        f"{', '.join(names)}; a file of your own is named by its path, such as my_vehicle.toml"
    )


def _read(path: Path) -> dict[str, Any]:
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise VehicleError([f"cannot be read as text: {error}"], path.name) from error
    return _parsed(text, path.name)


def _parsed(text: str, label: str) -> dict[str, Any]:
    try:
        return tomllib.loads(text)
    except (ValueError, RecursionError) as error:
        raise VehicleError([f"no valid TOML: {error}"], label) from error
