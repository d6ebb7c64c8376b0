"""Tables of the book: HTML without index column, in a box that scrolls on a narrow screen."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from html import escape
from typing import Any

import numpy as np
import pandas as pd
from IPython.display import Markdown
from pydantic import BaseModel

Format = Callable[[Any], str] | str

_MISSING = "–"

# "dataframe" is the class that the theme leaves unpainted in dark mode.
#: The box scrolls, not the table: only the box can be reached by keyboard.
_UNBOXED = "display:table;width:auto;max-width:none"

_NUMBER = ' style="text-align:right;white-space:nowrap"'


@dataclass(frozen=True, repr=False)
class Table:
    """A frame shown as HTML in a notebook.

    headings: column -> heading, in the order of display; columns not named are left out.
    formats: column -> a format such as ".2f" or a function to text (HTML: ``raw``).
    label: what the table is, for readers who do not see it.
    note: column of long texts, each shown across the table under its row where it is not empty.
    """

    frame: pd.DataFrame
    headings: Mapping[str, str]
    label: str
    formats: Mapping[str, Format] = field(default_factory=dict)
    raw: frozenset[str] = frozenset()
    note: str = ""

    @staticmethod
    def heading(text: str) -> Markdown:
        """A bold line between outputs."""
        return Markdown(f"**{text}**")

    def __repr__(self) -> str:
        return f"{self.label}: {len(self.frame)} rows"

    def _repr_html_(self) -> str:
        head = "".join(f'<th scope="col">{text}</th>' for text in self.headings.values())
        rows = "".join(self._rows(row) for row in self.frame.to_dict("records"))
        return (
            f'<div class="table-box" role="region" tabindex="0" aria-label="{escape(self.label)}" '
            f'style="overflow-x:auto"><table class="dataframe mathjax_process" style="{_UNBOXED}">'
            f"<thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table></div>"
        )

    def _rows(self, row: Mapping[Any, Any]) -> str:
        cells = "".join(self._cell(column, row[column]) for column in self.headings)
        note = row[self.note] if self.note else ""
        if not isinstance(note, str) or not note:
            return f"<tr>{cells}</tr>"
        return (
            f'<tr class="noted">{cells}</tr>'
            f'<tr class="note"><td colspan="{len(self.headings)}">'
            f"<div>{escape(note)}</div></td></tr>"
        )

    def _cell(self, column: str, value: Any) -> str:
        text = self._text(column, value)
        number = isinstance(value, int | float) and not isinstance(value, bool)
        style = _NUMBER if number else "" if column in self.raw else _width(text)
        return f"<td{style}>{text if column in self.raw else escape(text)}</td>"

    def _text(self, column: str, value: Any) -> str:
        if value is None or (isinstance(value, float) and pd.isna(value)):
            return _MISSING
        how = self.formats.get(column, "")
        text = how(value) if callable(how) else format(value, how)
        return text.replace("-", "−") if _is_number(value) else text


def _width(text: str) -> str:
    """Room for a text: short ones stay on one line, longer ones wrap at a readable width."""
    if text.startswith(r"\("):
        return ""
    least = 34 if len(text) > 60 else min(len(text), 16)
    return f' style="min-width:{least}ch;max-width:{max(least, 24)}ch"'


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float)


def link(text: str, address: str) -> str:
    """An HTML link for a ``raw`` column."""
    return f'<a href="{escape(address)}">{escape(text)}</a>'


def math(latex: str) -> str:
    """Inline mathematics for a column."""
    return rf"\({latex}\)"


def exact(value: float) -> str:
    """A value with as many digits as it takes to read it back."""
    if abs(value) >= 1e9:
        return np.format_float_scientific(value, trim="-", exp_digits=1)
    return repr(int(value)) if value == round(value) else f"{value:.12g}"


def parameter_table(parameters: BaseModel) -> Table:
    """The parameters a page was computed with, and what they mean."""
    rows = [
        {"name": name, "value": str(getattr(parameters, name)), "meaning": field.description or ""}
        for name, field in type(parameters).model_fields.items()
    ]
    headings = {"name": "parameter", "value": "value", "meaning": "meaning"}
    return Table(pd.DataFrame(rows), headings, "Parameters of this page")
