"""The paper's numbers beside the computed ones, with a verdict and a reason for each."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import pandas as pd

from wheelset.published.departures import departure_of, departures
from wheelset.published.items import Item
from wheelset.published.rules import VERDICTS, Verdict, verdict

COLUMNS = ("item", "quantity", "published", "computed", "difference", "verdict", "reason")

AGREES: Verdict = "agrees"
WITHIN: Verdict = "within tolerance"
DIFFERS: Verdict = "differs"
NOT_YET: Verdict = "not yet"


@dataclass(frozen=True)
class Judgement:
    """A verdict that no rule can give, on a figure panel for instance; a reason is required."""

    verdict: Verdict
    reason: str

    def __post_init__(self) -> None:
        """Refuse what is no verdict, or has no reason."""
        if self.verdict not in VERDICTS:
            raise ValueError(f"verdict {self.verdict!r}; allowed: {', '.join(VERDICTS)}")
        if not self.reason.strip():
            raise ValueError(f"a judgement ({self.verdict}) needs a reason")


def number_or_reason(value: float | None, reason: str) -> float | Judgement:
    """A computed number, or the reason why there is none."""
    missing = value is None or math.isnan(value)
    return Judgement(NOT_YET, reason) if missing else float(value or 0.0)


Computed = Mapping[tuple[str, str], float | Judgement | None]


def compare(items: Sequence[Item], computed: Computed, vehicle: str = "") -> pd.DataFrame:
    """A table with the columns ``COLUMNS``, one row for each item.

    ``computed`` maps (item, quantity) to a number in the item's unit, to a Judgement, or to None;
    what it lacks is "not yet". ``vehicle`` is the name under which departures are known. Raises
    KeyError for a computed number that is none of the items, ValueError for a number where a
    Judgement is needed.
    """
    unknown = [key for key in computed if key not in {item.key for item in items}]
    if unknown:
        raise KeyError(f"computed, but not among the items compared: {unknown}")
    rows = [_row(item, computed.get(item.key), vehicle) for item in items]
    return pd.DataFrame(rows, columns=list(COLUMNS))


def unexplained(table: pd.DataFrame, vehicle: str) -> tuple[str, ...]:
    """Sentences on rows that differ from print without a known departure of ``vehicle``.

    Rows without a computed number are left out: a Judgement brings its own reason.
    """
    differing = table[(table["verdict"] == DIFFERS) & table["computed"].notna()]
    return tuple(
        f"{item}, {quantity}: computed {float(computed):g}, published {float(published):g}, "
        f"and no departure of {vehicle} says why"
        for item, quantity, published, computed in zip(
            *(differing[column] for column in COLUMNS[:4]), strict=True
        )
        if departure_of(item, quantity, vehicle) is None
    )


def outdated(table: pd.DataFrame, vehicle: str) -> tuple[str, ...]:
    """Sentences on known departures of ``vehicle`` whose numbers in ``table`` do not differ."""
    verdicts = {(str(r.item), str(r.quantity)): str(r.verdict) for r in table.itertuples()}
    return tuple(
        f"{departure.item}, {departure.quantity}: {vehicle} has a departure, but the number "
        f"{verdicts[departure.item, departure.quantity]}"
        for departure in departures()
        if departure.vehicle == vehicle
        and verdicts.get((departure.item, departure.quantity), NOT_YET) not in (DIFFERS, NOT_YET)
    )


def _row(item: Item, computed: float | Judgement | None, vehicle: str) -> tuple[object, ...]:
    published = math.nan if item.published is None else item.published
    if computed is None:
        return (*item.key, published, math.nan, math.nan, NOT_YET, "")
    if isinstance(computed, Judgement):
        return (*item.key, published, math.nan, math.nan, computed.verdict, computed.reason)
    return (*item.key, published, computed, computed - published, *_judged(item, computed, vehicle))


def _judged(item: Item, computed: float, vehicle: str) -> tuple[Verdict, str]:
    if item.published is None:
        raise ValueError(f"{item.item} is a figure: give a Judgement, not a number")
    if not math.isfinite(computed):
        raise ValueError(f"{item.item}, {item.quantity}: computed {computed}; give None or why not")
    judged = verdict(item.quantity, item.published, computed, item.rounding)
    departure = departure_of(*item.key, vehicle) if judged == DIFFERS else None
    return judged, departure.reason if departure else ""
