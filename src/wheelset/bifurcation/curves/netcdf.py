"""Columns in files of classic netCDF (64-bit offset), written at once or not at all."""

from __future__ import annotations

import os
from collections.abc import Mapping
from io import BytesIO
from pathlib import Path
from typing import Any
from uuid import uuid4

from scipy.io import netcdf_file

from wheelset.bifurcation.curves.columns import Array, Column, encoded

#: Global attributes that scipy's reader would take for its own.
RESERVED = frozenset(
    {
        "close", "createDimension", "createVariable", "dimensions", "filename", "flush", "fp",
        "maskandscale", "mode", "sync", "use_mmap", "variables", "version_byte",
    }
)  # fmt: skip


def write(path: Path, columns: Mapping[str, Column], attributes: Mapping[str, Any]) -> None:
    """Write columns and global attributes; a file that is there is replaced once all is done."""
    part = path.with_name(f".{path.name}.{uuid4().hex}.part")
    try:
        with part.open("xb") as stream:
            file = netcdf_file(stream, "w", version=2)
            _fill(file, columns, attributes)
            file.flush()
            stream.flush()
            os.fsync(stream.fileno())
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)


def _fill(file: Any, columns: Mapping[str, Column], attributes: Mapping[str, Any]) -> None:
    _set(file, attributes)
    for name, column in columns.items():
        for dimension, size in zip(column.dimensions, column.data.shape, strict=True):
            if dimension not in file.dimensions:
                file.createDimension(dimension, size)
        variable = file.createVariable(name, column.data.dtype, column.dimensions)
        variable[:] = column.data
        _set(variable, column.attributes)


def _set(place: Any, attributes: Mapping[str, Any]) -> None:
    for name, value in attributes.items():
        setattr(place, name, encoded(value) if isinstance(value, str) else value)


def read(path: Path) -> tuple[dict[str, Array], dict[str, Any]]:
    """Variables and global attributes, texts as bytes.

    Raises one of Python's errors where the file is not of this format or damaged.
    """
    file = netcdf_file(BytesIO(path.read_bytes()), "r", mmap=False)
    variables = {name: variable.data for name, variable in file.variables.items()}
    return variables, dict(vars(file))
