"""Branches in files: classic netCDF that any reader opens, from which a branch comes back whole.

Over the dimension ``point`` stand ``arclength``, ``step``, ``parameter_v``, ``test_fold``, the
vectors ``u`` and ``tangent``, and ``solution_period`` and whatever else the solutions hold; over
``special`` and ``artefact`` likewise, with the letters and words of each. Global attributes say
what the branch consists of and how it began and ended, and hold the metadata. The attribute
``layout`` says how the variables make up the records; see ``records``.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np

from wheelset.bifurcation.curves import netcdf
from wheelset.bifurcation.curves.branch import Branch, BranchPoint, Ending, SpecialPoint
from wheelset.bifurcation.curves.columns import Array, Column, Sheet, decoded, plain, unique
from wheelset.bifurcation.curves.records import Layout, Reader, Writer, pack, unpack
from wheelset.bifurcation.cycles.cycle import Cycle
from wheelset.bifurcation.equilibria.equilibrium_problem import EquilibriumPoint
from wheelset.bifurcation.equilibria.hopf_points import HopfCurvePoint

Record = dict[str, Any]
Texts = Mapping[str, str]
Groups = Mapping[str, tuple[BranchPoint | SpecialPoint, ...]]

#: What a file says it is, and the version of the layout that is written and read.
FORMAT, VERSION = "wheelset branch", 1

#: What problems keep of a point, by name: the records that a file can hold.
SOLUTIONS: dict[str, type] = {
    kind.__name__: kind for kind in (Cycle, EquilibriumPoint, HopfCurvePoint)
}

#: Units of what always has the same, by the last two words of its path.
UNITS: dict[tuple[str, ...], str] = {
    ("solution", "period"): "s",
    ("solution", "eigenvalues"): "s-1",
    ("solution", "others"): "s-1",
    ("solution", "k"): "s-2",
    ("coefficient", "frequency"): "rad s-1",
    ("coefficient", "second frequency"): "rad s-1",
    ("coefficient", "angle"): "rad",
}

#: Fields whose columns have names of their own: ``test_fold`` for ``tests["fold"]``.
_STORED = {"values": "parameter", "tests": "test", "coefficients": "coefficient"}
_BY_PARAMETER = ("parameter", "parameters")
_FIELDS = {stored: name for name, stored in _STORED.items()}

#: What reading a damaged file raises.
_DAMAGE = (ArithmeticError, AttributeError, LookupError, MemoryError, TypeError, ValueError)


class BranchFileError(ValueError):
    """A file that holds no branch: which one, what was found in it, what was expected."""


# --- writing -------------------------------------------------------------------------------------


def save(
    branch: Branch, path: str | Path, metadata: Texts | None = None, units: Texts | None = None
) -> None:
    """Write a branch, at once or not at all; a file that is there is replaced.

    metadata: global attributes such as vehicle or command. units: of parameters, by name. Not
    stored is ``state``, the live solver: for going on there are ``checkpoint`` and ``resume``.
    Raises ValueError for what no file can hold, such as solutions of a class that has no line in
    ``SOLUTIONS``.
    """
    columns: dict[str, Column] = {}
    known = dict(UNITS)
    known.update({(k, n): unit for n, unit in (units or {}).items() for k in _BY_PARAMETER})
    groups: Groups = {
        "point": branch.points, "special": branch.special, "artefact": branch.artefacts,
    }  # fmt: skip
    layout = {}
    for name, points in groups.items():
        rows = [_record(branch, point) for point in points]
        layout[name] = _packed(Sheet(name, len(rows), known, columns), rows)
    netcdf.write(Path(path), columns, _attributes(branch, layout, metadata or {}))


def _packed(sheet: Sheet, rows: list[Record]) -> Layout:
    """Put rows into columns, whose names begin with the dimension's unless that is ``point``."""
    path = () if sheet.dimension == "point" else (sheet.dimension,)
    values = pack(Writer(sheet, SOLUTIONS), path, range(len(rows)), rows)
    return {"rows": len(rows), "values": values}


def _record(branch: Branch, point: BranchPoint | SpecialPoint) -> Record:
    """A point's fields, the values of the parameters by name."""
    record = {_STORED.get(f.name, f.name): getattr(point, f.name) for f in fields(point)}
    return record | {"parameter": _by_name(branch, point.values)}


def _by_name(branch: Branch, values: Array) -> dict[str, float]:
    if values.dtype != np.float64 or values.shape != (len(branch.parameters),):
        raise ValueError(
            f"values = {values!r}: have to be float64, one for each of {branch.parameters}"
        )
    return dict(zip(branch.parameters, values.tolist(), strict=True))


def _attributes(branch: Branch, layout: Layout, metadata: Texts) -> dict[str, Any]:
    """Global attributes; ``layout`` knows the metadata's names, which a file may not allow."""
    texts = {
        "kind": branch.kind,
        "began_kind": branch.began.kind,
        "began": branch.began.words,
        "ended_kind": branch.ended.kind,
        "ended": branch.ended.words,
        "statistics": json.dumps(dict(branch.statistics), default=_number),
    }
    names: dict[str, str] = {}
    for name, text in metadata.items():
        names[name] = unique(plain(name), {*texts, *_OWN, *netcdf.RESERVED})
        texts[names[name]] = _checked(name, text)
    whole = {"parameters": branch.parameters, "metadata": names, **layout}
    own = dict(zip(_OWN, (FORMAT, np.int32(VERSION), json.dumps(whole)), strict=True))
    return own | texts


_OWN = ("format", "format_version", "layout")


def _checked(name: str, text: Any) -> str:
    if not isinstance(text, str):
        raise ValueError(f"metadata {name} = {text!r}: has to be a text; write it out")
    return text


def _number(value: Any) -> Any:
    """A numpy scalar as a plain number."""
    return value.item()


# --- reading -------------------------------------------------------------------------------------


def load(path: str | Path) -> Branch:
    """The branch in a file, bit by bit, but for ``state``, which is None.

    It can be looked at and drawn, but not extended: see ``save``. Raises BranchFileError for a
    file that is not ours, of another version, damaged, or with solutions of an unknown class.
    """
    arrays, attributes, layout = _opened(Path(path))
    with _expected(path, "a branch as save writes it"):
        return _branch(Reader(arrays, SOLUTIONS), attributes, layout)


def metadata(path: str | Path) -> dict[str, str]:
    """The metadata that a branch was saved with; errors as for ``load``."""
    _, attributes, layout = _opened(Path(path))
    with _expected(path, "the metadata named in the layout"):
        return {name: decoded(attributes[place]) for name, place in layout["metadata"].items()}


def _opened(path: Path) -> tuple[dict[str, Array], dict[str, Any], Layout]:
    """Arrays, attributes and layout of a file of this format and version."""
    with _expected(path, "a whole file of classic netCDF"):
        arrays, attributes = netcdf.read(path)
    format_, version = attributes.get("format"), attributes.get("format_version")
    if format_ != FORMAT.encode():
        raise BranchFileError(f"{path}: found format = {format_!r}, expected {FORMAT!r}")
    if version != VERSION:
        raise BranchFileError(f"{path}: found version {version!s}, expected version {VERSION}")
    with _expected(path, "a layout in JSON"):
        return arrays, attributes, json.loads(decoded(attributes["layout"]))


@contextmanager
def _expected(path: str | Path, what: str) -> Iterator[None]:
    """Name the file, and what it should have held, where reading it goes wrong."""
    try:
        yield
    except _DAMAGE as error:
        found = f"{type(error).__name__}: {error}"
        raise BranchFileError(f"{path}: expected {what}, found {found}") from error


def _branch(reader: Reader, attributes: Mapping[str, Any], layout: Layout) -> Branch:
    text = {name: decoded(attributes[name]) for name in _TEXTS}
    return Branch(
        text["kind"],
        tuple(layout["parameters"]),
        tuple(BranchPoint(**fields_) for fields_ in _points(reader, layout["point"])),
        tuple(SpecialPoint(**fields_) for fields_ in _points(reader, layout["special"])),
        tuple(SpecialPoint(**fields_) for fields_ in _points(reader, layout["artefact"])),
        Ending(text["began_kind"], text["began"]),
        Ending(text["ended_kind"], text["ended"]),
        json.loads(text["statistics"]),
    )


_TEXTS = ("kind", "began_kind", "began", "ended_kind", "ended", "statistics")


def _points(reader: Reader, layout: Layout) -> Iterator[Record]:
    """The fields of points."""
    for record in unpack(reader, layout["values"], range(layout["rows"])):
        values = np.array(list(record.pop("parameter").values()), dtype=np.float64)
        yield {_FIELDS.get(name, name): value for name, value in record.items()} | {
            "values": values
        }
