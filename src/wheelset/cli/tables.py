"""How commands show what they found: rich tables for a reader, JSON for a program."""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from typing import Any

import typer
from rich.console import Console
from rich.table import Table

Row = Sequence[Any]


def show_table(title: str, columns: Sequence[str], rows: Iterable[Row], numeric: int = 0) -> None:
    """Print a table; the first ``numeric`` columns are aligned to the right."""
    headed = any(columns)
    table = Table(title=title, title_justify="left", title_style="bold", show_header=headed)
    for i, column in enumerate(columns):
        table.add_column(column, justify="right" if i < numeric else "left", overflow="fold")
    for row in rows:
        table.add_row(*(str(cell) for cell in row))
    Console().print(table)


def show_json(record: Any) -> None:
    """Print a record as JSON: SI units, full precision."""
    typer.echo(json.dumps(record, indent=2, ensure_ascii=False))
