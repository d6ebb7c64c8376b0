"""Files of profiles: what numbers stand in them.

Two forms are read by one reader: columns of numbers (comma, semicolon, tab or spaces; decimal
points or commas), and MiniProf's ASCII files (.mpt, .whl, .rai, .ban): a header of ``key=value``
lines, an empty line, then columns named by ``ColumnDef``, of which X and Y are used.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from wheelset.profiles.curves import Array
from wheelset.profiles.dialect import SPLITS, Split, number
from wheelset.profiles.errors import ProfileFileError

#: Fewer points than this are no profile; so many lost ones in a hundred are too many.
FEWEST, MOST_LOST = 20, 10

#: Lines by which the separators are told.
SOME = 40

_COMMENT = ("#", "%", "//", "!")


@dataclass
class Reading:
    """Points of a file in its own order and unit: x across, z along the profile's height.

    header: what MiniProf's header said; words: column names or a stated unit; notes: repairs.
    """

    path: Path
    x: Array
    z: Array
    header: dict[str, str] = field(default_factory=dict)
    words: str = ""
    notes: list[str] = field(default_factory=list)

    def error(self, reason: str, remedy: str, line: int | None = None) -> ProfileFileError:
        """An error about this file."""
        return ProfileFileError(self.path, reason, remedy, line)


def read_points(path: Path) -> Reading:
    """All points of a file. Raises ProfileFileError naming the file, the line and the reason."""
    reading = Reading(path, np.empty(0), np.empty(0))
    lines = _text(reading).splitlines()
    body = list(_body(reading, lines))
    if not body:
        raise reading.error("holds no numbers", "two columns, y and z, are expected")
    split, first = _dialect(reading, body)
    rows = _rows(reading, body, split, first)
    if len(rows) < FEWEST:
        raise reading.error(
            f"holds {len(rows)} points, a profile needs {FEWEST}", "is the file truncated?"
        )
    reading.x, reading.z = np.array(rows).T
    _check_count(reading, len(rows))
    return reading


def _text(reading: Reading) -> str:
    try:
        raw = reading.path.read_bytes()
    except OSError as error:
        raise reading.error(f"cannot be read: {error.strerror}", "check its path") from error
    if raw[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return raw.decode("utf-16", "replace")
    if b"\0" in raw or (raw and sum(b < 9 or 13 < b < 32 for b in raw) > len(raw) / 100):
        raise reading.error("is binary", "export it as text: two columns or MiniProf's ASCII")
    if not raw.strip():
        raise reading.error("is empty", "two columns, y and z, are expected")
    try:
        return raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        return raw.decode("latin-1")


def _body(reading: Reading, lines: list[str]) -> Iterator[tuple[int, str]]:
    """Numbered lines that hold points; the header goes into the reading."""
    begun = False
    for place, line in enumerate(lines, 1):
        text = line.strip()
        if not text or text.startswith(_COMMENT):
            reading.words += "" if begun else f" {text}"
        elif not begun and "=" in text:
            key, value = text.split("=", 1)
            reading.header[key.strip().lower()] = value.strip()
        elif not begun and not _looks_numeric(text):
            reading.words += f" {text}"
        else:
            begun = True
            yield place, text


def _looks_numeric(text: str) -> bool:
    return re.match(r"[-+]?[\d.,]*\d", text) is not None or text.split()[0].lower() == "nan"


def _dialect(reading: Reading, body: list[tuple[int, str]]) -> tuple[Split, int]:
    """How the lines are split, and the first of the two columns that count."""
    some = [text for _, text in body[:SOME]]
    for split, words in SPLITS:
        if sum(_is_point(split(text)) for text in some) >= 0.8 * len(some):
            if words:
                reading.notes.append(words)
            rows = [split(text) for _, text in body]
            return split, _first_column(reading, rows, len(rows[0]))
    line, text = body[0]
    if any(number(f) is not None for split, _ in SPLITS for f in split(text)):
        raise reading.error(
            f'holds one column ("{text[:40]}")', "two columns, y and z, are expected", line
        )
    raise reading.error(f'"{text[:40]}" is not a point', "two numbers are expected", line)


def _is_point(fields: list[str]) -> bool:
    return len(fields) >= 2 and all(number(f) is not None for f in fields)


def _first_column(reading: Reading, rows: list[list[str]], columns: int) -> int:
    names = [name.strip().lower() for name in reading.header.get("columndef", "").split(",")]
    if "x" in names and "y" in names[names.index("x") + 1 :][:1]:
        return names.index("x")
    if columns == 2:
        return 0
    counts = [row[0] for row in rows]
    counted = counts == [str(k) for k in range(len(rows))]
    counted = counted or counts == [str(k + 1) for k in range(len(rows))]
    used = "2 and 3 (the first counts the points)" if counted else "1 and 2"
    reading.notes.append(f"columns {used} of {columns} used")
    return int(counted)


def _rows(
    reading: Reading, body: list[tuple[int, str]], split: Split, first: int
) -> list[tuple[float, float]]:
    """The points; those that are not numbers are left out and noted."""
    rows, lost = [], []
    for k, (line, text) in enumerate(body):
        fields = split(text)[first : first + 2]
        values = [number(f) for f in fields]
        if len(values) == 2 and all(v is not None and math.isfinite(v) for v in values):
            rows.append((values[0] or 0.0, values[1] or 0.0))
        elif k == len(body) - 1 and (len(values) < 2 or None in values):
            reading.notes.append(f'line {line} is cut short ("{text[:30]}"): left out')
        elif len(values) == 2 and None not in values:
            lost.append(line)
        else:
            raise reading.error(f'"{text[:40]}" is not a point', "correct or delete it", line)
    _note_lost(reading, lost, len(rows))
    return rows


def _note_lost(reading: Reading, lost: list[int], kept: int) -> None:
    if not lost:
        return
    if len(lost) * 100 > MOST_LOST * (kept + len(lost)):
        raise reading.error(
            f"{len(lost)} of {kept + len(lost)} points are not numbers (NaN)",
            "measure again",
            lost[0],
        )
    some = ", ".join(str(line) for line in lost[:5]) + (", ..." if len(lost) > 5 else "")
    reading.notes.append(f"{len(lost)} points that are not numbers (NaN) left out: lines {some}")


def _check_count(reading: Reading, found: int) -> None:
    stated = reading.header.get("xypoints", "")
    if stated.isdigit() and int(stated) != found:
        reading.notes.append(
            f"the header announces {stated} points, {found} are there: the file may be truncated"
        )
