"""The printed Hopf numbers as observations: what was changed in the vehicle, what came out.

Source: Guo, Shi, Luo, Zeng, Nonlinear Dynamics 104 (2021) 989-1005, sections 4 and 5, Table 3.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from wheelset.studies.table_3 import TABLE_3_ROWS

#: Names of the groups of observations.
TABLE_3, SECTION_4 = "Table 3", "section 4"

#: Section 4's zeros of the first Lyapunov coefficient at Table 1's coefficients, by coefficient.
#: f1's act through e1 + f1 as e1's do and say nothing more.
SECTION_4_ZEROS: tuple[tuple[str, float], ...] = (
    ("a3", 102.47), ("c1", 164.23), ("c1", 1137.95), ("e1", -2152.34), ("e1", 21023.16),
    ("a1", 11.14), ("a1", 38.14),
)  # fmt: skip

#: Model error allowed for beside half a unit of the last digit: parts of a speed, of an FLC, and
#: the FLC, 1/s, that a zero's part is taken of.
SPEED_SLACK, FLC_SLACK, FLC_AT_ZERO = 2e-4, 1e-2, 5.0

COLUMNS = ("item", "group", "quantity", "parameter", "changes", "printed", "half_unit")


class _Place(NamedTuple):
    item: str
    group: str
    quantity: str
    parameter: str
    changes: tuple[str, ...]


def _places() -> Iterator[_Place]:
    for name, value in TABLE_3_ROWS:
        for quantity in ("hopf_speed", "flc"):
            item = f"Table 3: {name}={value:g}"
            yield _Place(item, TABLE_3, quantity, name, _row_of_table_3(name, value))
    for quantity in ("hopf_speed", "flc"):
        yield _Place("Section 4: default", SECTION_4, quantity, "", ())
    for name, value in SECTION_4_ZEROS:
        item = f"Section 4: GH {name}={value:.12g}"
        yield _Place(item, SECTION_4, "gh_value", name, (f"{name}={value}",))


def _row_of_table_3(name: str, value: float) -> tuple[str, ...]:
    """Changes that make the vehicle a row of Table 3: a3 = 200 1/m2 (p. 1000), or the row's."""
    return (f"a3={value}",) if name == "a3" else ("a3=200", f"{name}={value}")


def observations(printed: pd.DataFrame) -> pd.DataFrame:
    """What a fit can be held to, one row a number.

    printed: item, quantity, published (SI), decimals, by the names of the paper's rows
    ("Table 3: a1=0.05"). Columns of the result: ``COLUMNS``; group is ``TABLE_3`` or ``SECTION_4``,
    changes the overrides of the vehicle as a text. Raises KeyError where a number is missing.
    """
    keys = zip(printed["item"], printed["quantity"], strict=True)
    numbers = zip(printed["published"], 0.5 * 10.0 ** -printed["decimals"], strict=True)
    known = dict(zip(keys, numbers, strict=True))
    rows = [
        (*place[:4], ", ".join(place.changes), *known[place.item, place.quantity])
        for place in _places()
    ]
    return pd.DataFrame(rows, columns=list(COLUMNS))


def changes_of(text: str) -> dict[str, float]:
    """The changes of an observation as numbers by name."""
    pairs = (part.split("=") for part in text.split(",") if part.strip())
    return {name.strip(): float(value) for name, value in pairs}


def tolerance(data: pd.DataFrame) -> NDArray[np.float64]:
    """What a residual is divided by: half a unit of the last digit and the model error allowed.

    For a zero of the FLC it is one of the FLC at the printed place, in 1/s.
    """
    speed = data["half_unit"] + SPEED_SLACK * data["printed"].abs()
    flc = data["half_unit"] + FLC_SLACK * data["printed"].abs()
    zero = pd.Series(FLC_SLACK * FLC_AT_ZERO + 0.005, index=data.index)
    kinds = [data["quantity"] == "hopf_speed", data["quantity"] == "flc"]
    return np.asarray(np.select(kinds, [speed, flc], zero), dtype=np.float64)
