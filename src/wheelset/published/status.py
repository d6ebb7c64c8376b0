"""The state of the reproduction: every published item, beside what the pages computed."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import pandas as pd

from wheelset.published.comparison import COLUMNS, NOT_YET
from wheelset.published.fits import is_fitted
from wheelset.published.items import ITEMS, Item
from wheelset.published.rules import VERDICTS

Row = dict[str, Any]


def status(comparisons: Mapping[str, pd.DataFrame]) -> pd.DataFrame:
    """One row an item of the paper, in the paper's order: the columns of a comparison and page.

    comparisons: by page, as ``compare`` makes them. Items on no page are "not yet", page "".
    Raises ValueError for an item that two pages claim or the paper does not have.
    """
    found = _by_key(comparisons)
    rows = [found.get(item.key) or _empty(item) for item in ITEMS]
    return pd.DataFrame(rows, columns=[*COLUMNS, "page"])


def _by_key(comparisons: Mapping[str, pd.DataFrame]) -> dict[tuple[str, str], Row]:
    found: dict[tuple[str, str], Row] = {}
    known = {item.key for item in ITEMS}
    for page, table in comparisons.items():
        for row in table.fillna({"reason": ""}).to_dict("records"):
            key = (row["item"], row["quantity"])
            if key in found or key not in known:
                why = f"also on {found[key]['page']}" if key in found else "not in the paper"
                raise ValueError(f"{page}: {key[0]}, {key[1]} is {why}; take it out there")
            found[key] = {**{str(name): value for name, value in row.items()}, "page": page}
    return found


def _empty(item: Item) -> Row:
    nothing = {"computed": None, "difference": None, "verdict": NOT_YET, "reason": "", "page": ""}
    return {"item": item.item, "quantity": item.quantity, "published": item.published, **nothing}


def counts(table: pd.DataFrame) -> pd.DataFrame:
    """Numbers of items by part of the paper and verdict, a last row for the whole.

    Columns: part, items, one for each verdict, fitted (how many a vehicle was fitted to).
    """
    part = table["item"].str.split(":").str[0]
    rows = [_count(str(name), rows) for name, rows in table.groupby(part, sort=False)]
    return pd.DataFrame([*rows, _count("all", table)])


def _count(part: str, rows: pd.DataFrame) -> dict[str, object]:
    verdicts = {str(verdict): int((rows["verdict"] == verdict).sum()) for verdict in VERDICTS}
    return {"part": part, "items": len(rows), **verdicts, "fitted": int(is_fitted(rows).sum())}
