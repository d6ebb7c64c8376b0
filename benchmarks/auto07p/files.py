"""AUTO's files: constants written, tables and logs read."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pandas as pd

#: Types of points by the last digit of their code, with its sign; a digit before it says on what
#: kind of curve the point lies. GH alone is known by two digits.
_TYPES = {
    1: "BP", 2: "LP", 3: "HB", 4: "RG", 5: "LP", 6: "BP", 7: "PD", 8: "TR", 9: "EP",
    -1: "BT", -2: "CP", -3: "ZH", -4: "UZ", -5: "R1", -6: "R2", -7: "R3", -8: "R4", -9: "MX",
}  # fmt: skip
_GENERALISED_HOPF = -32


def constants_text(constants: Mapping[str, object]) -> str:
    """A constants file; its values are written as Python writes them."""
    return "".join(f"{name} = {value!r}\n" for name, value in constants.items())


def point_type(code: int) -> str:
    """EP, HB, LP, MX, ...; empty for an ordinary point."""
    if code == _GENERALISED_HOPF:
        return "GH"
    return _TYPES.get(int(np.sign(code)) * (abs(code) % 10), "")


def read_table(path: Path) -> pd.DataFrame:
    """The points of a ``fort.7``: columns type and label, then AUTO's own, to 11 digits."""
    lines = [line for line in path.read_text("ascii").splitlines() if line.strip()]
    heading = next(line for line in lines if re.match(r"\s*0\s+PT\s+TY\s+LAB", line))
    names = re.findall(r"(?:MAX |MIN |INTEGRAL )?\S+", heading)[4:]
    rows = [row for row in map(str.split, lines) if row[0] != "0"]
    table = pd.DataFrame([[_number(text) for text in row[4:]] for row in rows], columns=names)
    table.insert(0, "type", [point_type(int(row[2])) for row in rows])
    table.insert(1, "label", [int(row[3]) for row in rows])
    return table


def iterations(path: Path) -> int:
    """Newton iterations that a ``fort.9`` tells of, those of located points included."""
    return len(re.findall(r"^ *-?\d+ +-?\d+ +[1-9]\d* +[-\d.]+E", path.read_text("ascii"), re.M))


def _number(text: str) -> float:
    """A double whose exponent of three digits may have pushed out its E: 1.0-100."""
    return float(re.sub(r"(?<=\d)([+-]\d{3})$", r"E\1", text))
