"""Records as columns: values of any form, one a row, become arrays with a layout, and back again.

A column holds one quantity over the rows: numbers as an array (of different shapes: joined end to
end, the shapes beside them), texts as characters; a record has one for each field, a mapping one
for each key. The layout, plain JSON, says how columns make up values. What comes back is the same
bit by bit; mappings come back as dicts, numpy's scalars as Python's.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields, is_dataclass
from typing import Any, NamedTuple

import numpy as np

from wheelset.bifurcation.curves.columns import (
    STORED,
    Array,
    Path,
    Sheet,
    characters,
    numbers,
    texts,
)

Rows = Sequence[int]
Layout = dict[str, Any]
Classes = Mapping[str, type]

#: Stands for a key that a mapping does not have.
_ABSENT = object()


@dataclass(frozen=True, eq=False)
class Writer:
    """Where columns go, and the classes of records by name."""

    sheet: Sheet
    classes: Classes


@dataclass(frozen=True, eq=False)
class Reader:
    """Stored arrays by name, and the classes of records by name."""

    arrays: Mapping[str, Array]
    classes: Classes


def pack(to: Writer, path: Path, rows: Rows, values: Sequence[Any]) -> Layout:
    """Put values, one for each of the rows, which increase, into columns; returns their layout.

    Raises ValueError for a value that no column can hold.
    """
    forms = dict.fromkeys(_form(to, path, value) for value in values)
    name = "nothing" if not forms else "either" if len(forms) > 1 else next(iter(forms))[0]
    return {"form": name, **_FORMS[name].pack(to, path, rows, values)}


def unpack(source: Reader, layout: Layout, rows: Rows) -> list[Any]:
    """The values at some rows."""
    return _FORMS[layout["form"]].unpack(source, layout, rows)


def _form(to: Writer, path: Path, value: Any) -> tuple[Any, ...]:
    """The form that holds a value, and what values of one column have to have in common."""
    kind = type(value)
    if isinstance(value, np.ndarray | np.generic) and value.dtype.name in STORED:
        return "array" if kind is np.ndarray else "number", value.dtype.name, value.ndim
    if kind in (bool, int, float, complex) and (dtype := np.asarray(value).dtype.name) in STORED:
        return "number", dtype, 0
    if kind is tuple:
        return _form_of_tuple(value)
    if is_dataclass(kind) and to.classes.get(kind.__name__) is kind:
        return "record", kind.__name__
    if isinstance(value, Mapping) and all(type(key) is str for key in value):
        return ("mapping",)
    if kind is str or value is None or value is _ABSENT:
        return ("text" if kind is str else "nothing" if value is None else "absent",)
    raise ValueError(
        f"{'.'.join(path)} = {value!r:.60} of type {kind.__name__}: cannot be stored; it has to be "
        f"None, a number, a text, a tuple, a mapping by texts, an array of {', '.join(STORED)} or "
        f"a registered record: {', '.join(to.classes)}"
    )


def _form_of_tuple(value: tuple[Any, ...]) -> tuple[Any, ...]:
    kinds = set(map(type, value))
    if kinds == {float}:
        return ("numbers",)
    return ("texts", *value) if kinds == {str} else ("tuple", len(value))


# --- numbers, arrays of numbers, and tuples of floats --------------------------------------------


def _pack_numbers(to: Writer, path: Path, rows: Rows, values: Sequence[Any]) -> Layout:
    arrays = [np.asarray(value) for value in values]
    shapes = [array.shape for array in arrays]
    if len(set(shapes)) > 1:
        return _pack_ragged(to, path, rows, arrays)
    dtype, shape = arrays[0].dtype, shapes[0]
    gaps = len(rows) < to.sheet.rows and dtype.kind in "fc"
    data = np.full((to.sheet.rows, *shape), math.nan if gaps else 0, dtype)
    data[list(rows)] = arrays
    axes = [f"axis_{k + 1}" for k in range(len(shape))]
    more: dict[str, Any] = {"_FillValue": np.float64(math.nan)} if gaps else {}
    name = to.sheet.add_numbers(path, data, axes, **more)
    return {"variable": name, "dtype": dtype.name, "shape": list(shape)}


def _pack_ragged(to: Writer, path: Path, rows: Rows, arrays: Sequence[Array]) -> Layout:
    shapes = np.zeros((to.sheet.rows, arrays[0].ndim), np.int32)
    shapes[list(rows)] = [array.shape for array in arrays]
    data = np.concatenate([array.ravel() for array in arrays])
    name = to.sheet.add_numbers(path, data, ["values"], over_rows=False)
    words = f"shape of the part of {name} that belongs to a row"
    beside = to.sheet.add((*path, "shape"), shapes, ["axes"], comment=words)
    return {"variable": name, "dtype": data.dtype.name, "shapes": beside}


def _unpack_arrays(source: Reader, layout: Layout, rows: Rows) -> list[Array]:
    name, dtype = layout["variable"], layout["dtype"]
    if "shapes" in layout:
        return _unpack_ragged(source, layout, rows)
    if not name:
        return [np.empty(layout["shape"], dtype) for _ in rows]
    data = numbers(source.arrays[name], dtype)
    return [data[row, ...].reshape(layout["shape"]) for row in rows]


def _unpack_ragged(source: Reader, layout: Layout, rows: Rows) -> list[Array]:
    data = numbers(source.arrays[layout["variable"]], layout["dtype"])
    shapes = source.arrays[layout["shapes"]].astype(np.int64)
    sizes = shapes.prod(axis=1)
    ends = np.cumsum(sizes)
    return [data[ends[row] - sizes[row] : ends[row]].reshape(shapes[row]) for row in rows]


def _unpack_number(source: Reader, layout: Layout, rows: Rows) -> list[Any]:
    return [array.item() for array in _unpack_arrays(source, layout, rows)]


def _unpack_floats(source: Reader, layout: Layout, rows: Rows) -> list[Any]:
    return [tuple(array.tolist()) for array in _unpack_arrays(source, layout, rows)]


# --- texts ---------------------------------------------------------------------------------------


def _pack_text(to: Writer, path: Path, rows: Rows, values: Sequence[Any]) -> Layout:
    data = characters(values, rows, to.sheet.rows)
    return {"variable": to.sheet.add(path, data, ["length"], _Encoding="utf-8")}


def _unpack_text(source: Reader, layout: Layout, rows: Rows) -> list[Any]:
    found = texts(source.arrays[layout["variable"]])
    return [found[row] for row in rows]


def _pack_texts(to: Writer, path: Path, rows: Rows, values: Sequence[Any]) -> Layout:
    """Tuples of texts are the same in every row here, and kept once."""
    data = characters(values[0], range(len(values[0])), len(values[0]))
    name = to.sheet.add(path, data, ["count", "length"], over_rows=False, _Encoding="utf-8")
    return {"variable": name}


def _unpack_texts(source: Reader, layout: Layout, rows: Rows) -> list[Any]:
    return [tuple(texts(source.arrays[layout["variable"]]))] * len(rows)


# --- values made of others -----------------------------------------------------------------------


def _pack_tuple(to: Writer, path: Path, rows: Rows, values: Sequence[Any]) -> Layout:
    parts = zip(*values, strict=True)
    return {"items": [pack(to, (*path, str(k)), rows, part) for k, part in enumerate(parts)]}


def _unpack_tuple(source: Reader, layout: Layout, rows: Rows) -> list[Any]:
    parts = [unpack(source, item, rows) for item in layout["items"]]
    return list(zip(*parts, strict=True)) if parts else [()] * len(rows)


def _pack_mapping(to: Writer, path: Path, rows: Rows, values: Sequence[Any]) -> Layout:
    keys = dict.fromkeys(key for value in values for key in value)
    items = []
    for key in keys:
        part = [value.get(key, _ABSENT) for value in values]
        items.append([key, pack(to, (*path, key), rows, part)])
    return {"items": items}


def _unpack_mapping(source: Reader, layout: Layout, rows: Rows) -> list[Any]:
    found: list[dict[str, Any]] = [{} for _ in rows]
    for key, item in layout["items"]:
        for mapping, value in zip(found, unpack(source, item, rows), strict=True):
            if value is not _ABSENT:
                mapping[key] = value
    return found


def _pack_record(to: Writer, path: Path, rows: Rows, values: Sequence[Any]) -> Layout:
    kind = type(values[0])
    as_mappings = [{f.name: getattr(v, f.name) for f in fields(kind)} for v in values]
    return {"class": kind.__name__, **_pack_mapping(to, path, rows, as_mappings)}


def _unpack_record(source: Reader, layout: Layout, rows: Rows) -> list[Any]:
    name, known = layout["class"], source.classes
    if name not in known:
        raise ValueError(f"found a record of class {name!r}, expected one of {', '.join(known)}")
    has, wants = [key for key, _ in layout["items"]], [f.name for f in fields(known[name])]
    if has != wants:
        raise ValueError(f"found {name} with fields {has}, expected {wants}")
    return [known[name](**mapping) for mapping in _unpack_mapping(source, layout, rows)]


def _pack_either(to: Writer, path: Path, rows: Rows, values: Sequence[Any]) -> Layout:
    """Values of several forms: which one a row has, -1 for none, and the columns of each."""
    groups: dict[tuple[Any, ...], dict[int, Any]] = {}
    for row, value in zip(rows, values, strict=True):
        groups.setdefault(_form(to, path, value), {})[row] = value
    choice = np.full(to.sheet.rows, -1, np.int32)
    for number, group in enumerate(groups.values()):
        choice[list(group)] = number
    words = "number of the form that the value of a row has; see the layout"
    name = to.sheet.add((*path, "form"), choice, comment=words)
    choices = [pack(to, path, list(g), list(g.values())) for g in groups.values()]
    return {"variable": name, "choices": choices}


def _unpack_either(source: Reader, layout: Layout, rows: Rows) -> list[Any]:
    choice, found = source.arrays[layout["variable"]], dict.fromkeys(rows)
    for number, item in enumerate(layout["choices"]):
        own = [row for row in rows if choice[row] == number]
        found.update(zip(own, unpack(source, item, own), strict=True))
    return list(found.values())


class _Form(NamedTuple):
    pack: Callable[[Writer, Path, Rows, Sequence[Any]], Layout]
    unpack: Callable[[Reader, Layout, Rows], list[Any]]


def _pack_nothing(to: Writer, path: Path, rows: Rows, values: Sequence[Any]) -> Layout:
    return {}


_FORMS = {
    "nothing": _Form(_pack_nothing, lambda source, layout, rows: [None] * len(rows)),
    "absent": _Form(_pack_nothing, lambda source, layout, rows: [_ABSENT] * len(rows)),
    "number": _Form(_pack_numbers, _unpack_number),
    "array": _Form(_pack_numbers, _unpack_arrays),
    "numbers": _Form(_pack_numbers, _unpack_floats),
    "text": _Form(_pack_text, _unpack_text),
    "texts": _Form(_pack_texts, _unpack_texts),
    "tuple": _Form(_pack_tuple, _unpack_tuple),
    "mapping": _Form(_pack_mapping, _unpack_mapping),
    "record": _Form(_pack_record, _unpack_record),
    "either": _Form(_pack_either, _unpack_either),
}
