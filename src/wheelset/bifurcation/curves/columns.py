"""Columns of a table over one dimension: named arrays in the types of classic netCDF."""

from __future__ import annotations

import re
from collections.abc import Container, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]
Path = tuple[str, ...]

#: How numbers are stored: classic netCDF knows neither complex numbers nor 64-bit integers.
STORED = {"float64": "f8", "complex128": "f8", "int64": "i4", "int32": "i4", "bool": "i1"}

#: An axis that means the same in every column: real and imaginary part.
COMPLEX = "complex"


@dataclass(frozen=True, eq=False)
class Column:
    """An array with the names of its axes and what is known of it."""

    dimensions: tuple[str, ...]
    data: Array
    attributes: dict[str, Any]


@dataclass(frozen=True, eq=False)
class Sheet:
    """Columns over a dimension of so many rows. units: by the last two words of a path."""

    dimension: str
    rows: int
    units: Mapping[Path, str] = field(default_factory=dict)
    columns: dict[str, Column] = field(default_factory=dict)

    def add(
        self, path: Path, data: Array, axes: Sequence[str] = (), over_rows: bool = True, **more: Any
    ) -> str:
        """Keep an array under a name of its own. axes: without that of the rows. An array without
        values is not kept, since a dimension of length zero means another thing in netCDF.
        """
        if not data.size:
            return ""
        name = unique(plain("_".join(path)), self.columns)
        own = [axis if axis == COMPLEX else f"{name}_{axis}" for axis in axes]
        dimensions = (self.dimension, *own) if over_rows else tuple(own)
        unit = {"units": self.units[path[-2:]]} if path[-2:] in self.units else {}
        attributes = {"long_name": path[-1], **unit, **more}
        self.columns[name] = Column(dimensions, data, attributes)
        return name

    def add_numbers(
        self, path: Path, data: Array, axes: Sequence[str] = (), over_rows: bool = True, **more: Any
    ) -> str:
        """Keep an array of numbers, in a type that can be stored; see ``numbers``."""
        stored = data.astype(STORED[data.dtype.name]) if data.dtype.kind in "ib" else data
        if data.dtype.kind == "i" and not np.array_equal(stored, data):
            raise ValueError(f"{'.'.join(path)} = {data}: integers have to fit into 32 bits")
        if data.dtype.kind == "c":
            stored, axes = data[..., np.newaxis].view(np.float64), [*axes, COMPLEX]
            more["comment"] = "last axis: real and imaginary part"
        return self.add(path, stored, axes, over_rows, **more)


def numbers(stored: Array, dtype: str) -> Array:
    """The numbers of ``Sheet.add_numbers`` in their own type and this machine's byte order."""
    native = np.ascontiguousarray(stored, stored.dtype.newbyteorder("="))
    if dtype == "complex128":
        return native.view(np.complex128)[..., 0]
    return native.astype(dtype, copy=False)


def characters(texts: Sequence[str], rows: Sequence[int], count: int) -> Array:
    """Texts at some of so many rows, as single bytes (count, length), padded with zeros."""
    coded = [encoded(text) for text in texts]
    data = np.full(count, b"", f"S{max(map(len, coded), default=0) or 1}")
    data[list(rows)] = coded
    return data[:, np.newaxis].view("S1")


def texts(data: Array) -> list[str]:
    """The texts of ``characters``."""
    joined = np.ascontiguousarray(data).view(f"S{data.shape[1]}")
    return [decoded(text) for text in joined[:, 0].tolist()]


def encoded(text: str) -> bytes:
    """Any text without a byte zero, which pads: Java's modified UTF-8."""
    return text.encode("utf-8", "surrogatepass").replace(b"\0", b"\xc0\x80")


def decoded(text: bytes) -> str:
    """The text of ``encoded``."""
    return text.replace(b"\xc0\x80", b"\0").decode("utf-8", "surrogatepass")


def plain(text: str) -> str:
    """A name for any reader: letters, digits and underscores."""
    name = re.sub(r"[^A-Za-z0-9_]", "_", text)
    return name if name[:1].isalpha() else f"x{name}"


def unique(name: str, taken: Container[str]) -> str:
    """The name, numbered if it is taken."""
    number, free = 1, name
    while free in taken:
        number += 1
        free = f"{name}_{number}"
    return free
