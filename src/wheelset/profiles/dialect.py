"""How a line of a file is split into numbers: separators, decimal commas, words for nothing."""

from __future__ import annotations

import math
import re
from collections.abc import Callable

_LOST = {"", "nan", "na", "n/a", "#n/a", "-", "--", "---", "inf", "-inf", "null", "none"}

Split = Callable[[str], list[str]]


def _by(separator: str | None, *, comma: bool = False) -> Split:
    def split(text: str) -> list[str]:
        parts = [part.strip() for part in text.split(separator)]
        while len(parts) > 1 and not parts[-1]:
            parts.pop()
        return [part.replace(",", ".") for part in parts] if comma else parts

    return split


def _paired(text: str) -> list[str]:
    """``12,5,3,4``: both the separator and the decimals are commas."""
    parts = text.replace(" ", "").split(",")
    return [".".join(parts[k : k + 2]) for k in range(0, len(parts) - 1, 2)]


_COMMAS = "decimal commas read as points"

#: Ways to split a line, the likeliest first, and what to say when one is used.
SPLITS: tuple[tuple[Split, str], ...] = (
    (_by(";"), ""),
    (_by(";", comma=True), _COMMAS),
    (_by("\t"), ""),
    (_by("\t", comma=True), _COMMAS),
    (_by(None), ""),
    (lambda text: _by(",")(text) if text.count(",") < 3 else [], ""),
    (_by(None, comma=True), _COMMAS),
    (lambda text: _paired(text) if re.fullmatch(r"-?\d+,\d+, ?-?\d+,\d+", text) else [], _COMMAS),
    (_by(","), ""),
)


def number(text: str) -> float | None:
    """A number, NaN for a word that stands for none, or None."""
    if text.lower() in _LOST:
        return math.nan
    try:
        return float(text)
    except ValueError:
        return None
