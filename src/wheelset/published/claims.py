"""Verdicts on figures: the paper's sentences about them, measured."""

from __future__ import annotations

from collections.abc import Mapping

import pandas as pd

from wheelset.published.comparison import AGREES, DIFFERS, WITHIN, Judgement
from wheelset.published.departures import departure_of
from wheelset.published.items import FIGURE


def judge(
    claims: pd.DataFrame, vehicles: Mapping[str, str]
) -> dict[tuple[str, str], float | Judgement | None]:
    """A Judgement for each figure panel, ready for ``compare``.

    claims: item, claim, measured, unit, holds, tolerated. vehicles: by item, for the reason of a
    known departure. A panel agrees if every sentence about it holds, and is within tolerance if
    each is at least tolerated.
    """
    return {
        (str(item), FIGURE): _judgement(str(item), rows, vehicles.get(str(item), ""))
        for item, rows in claims.groupby("item", sort=False)
    }


def _judgement(item: str, claims: pd.DataFrame, vehicle: str) -> Judgement:
    words = "; ".join(
        f"{row.claim}: {_measured(row.measured, row.unit)}" for row in claims.itertuples()
    )
    if claims["holds"].all():
        return Judgement(AGREES, f"{words}.")
    if claims["tolerated"].all():
        return Judgement(WITHIN, f"{words}.")
    departure = departure_of(item, FIGURE, vehicle)
    return Judgement(DIFFERS, f"{words}. {departure.reason if departure else ''}".strip())


def _measured(value: object, unit: object) -> str:
    number = float(str(value))
    scale, shown = {"m": (1e3, " mm"), "N": (1e-3, " kN"), "1": (1.0, "")}[str(unit)]
    return f"{number * scale:.2f}{shown}"
