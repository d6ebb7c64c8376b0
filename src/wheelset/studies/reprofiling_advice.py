"""From speeds by mileage to the mileage at which a margin is exhausted, and to words of advice."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from wheelset.studies.reprofiling import Found, Parameters
from wheelset.studies.reprofiling_campaigns import unmeasured

Array = NDArray[np.float64]

#: What may become of a campaign.
WITHIN, NEVER, FIRST, UNKNOWN = "within", "not in the series", "from the start", "not computed"

#: Per cent of the campaigns between which a mileage is told.
LOW, HIGH = 5, 95


@dataclass(frozen=True)
class Criterion:
    """A margin: its title, the speed looked at and the one required, m/s, by mileage."""

    title: str
    speed: str
    required: float


def criteria(p: Parameters) -> tuple[Criterion, ...]:
    """Those of the study."""
    limit = f"with the suspension stiffened by {p.stiffness_limit:g}"
    return (
        Criterion("Hopf speed", "v_lin", p.v_linear),
        Criterion("nonlinear critical speed", "v_non", p.v_nonlinear),
        Criterion(f"Hopf speed {limit}", "v_limit", p.v_linear),
        Criterion(f"nonlinear critical speed {limit}", "v_non_limit", p.v_nonlinear),
    )


def exhausted(mileages: Array, speeds: Array, required: float) -> tuple[Array, list[str]]:
    """Mileages at which speeds (campaigns, mileages) first fall below a required one, linear in
    between, and what became of each campaign; the mileage is NaN unless that is WITHIN.
    """
    below = speeds < required
    at = np.full(len(speeds), np.nan)
    outcomes = np.where(below.any(axis=1), WITHIN, NEVER).astype(object)
    outcomes[below[:, 0]] = FIRST
    outcomes[~np.isfinite(speeds).all(axis=1)] = UNKNOWN
    for k in np.flatnonzero(outcomes == WITHIN):
        j = int(below[k].argmax())
        (v0, v1), (m0, m1) = speeds[k, j - 1 : j + 1], mileages[j - 1 : j + 1]
        at[k] = m0 + (m1 - m0) * (v0 - required) / (v0 - v1)
    return at, list(outcomes)


def percentiles(at: Array, outcomes: list[str]) -> list[float | None]:
    """Mileages not reached by 5, 50 and 95 per cent of the campaigns computed: 0 where they were
    exhausted from the start, None where not within the series.
    """
    kept = np.array([o != UNKNOWN for o in outcomes])
    last = np.where(np.array(outcomes) == FIRST, 0.0, np.where(np.isnan(at), np.inf, at))[kept]
    if not len(last):
        return [None] * 3
    found = np.percentile(last, [LOW, 50, HIGH], method="inverted_cdf")
    return [float(m) if np.isfinite(m) else None for m in found]


def measured_speeds(p: Parameters, table: pd.DataFrame, speed: str) -> Array:
    """Speeds of campaigns (campaigns, mileages), m/s."""
    if speed == "v_non_limit":
        table = table.assign(v_non_limit=table["v_non"] * p.stiffness_limit ** table["power"])
    return table.pivot(index="sample", columns="mileage", values=speed).to_numpy(float)


def advice_table(p: Parameters, all_found: Found) -> pd.DataFrame:
    """One row a criterion: criterion, required m/s; itself: the mileage of the wheels as they are
    and became: its outcome; of the campaigns median, low and high (see ``percentiles``), and how
    many ended in each outcome.
    """
    wheels = _as_they_are(all_found)
    return pd.DataFrame([_row(p, all_found, c, wheels) for c in criteria(p)])


def _row(
    p: Parameters, all_found: Found, criterion: Criterion, wheels: pd.DataFrame
) -> dict[str, object]:
    mileages = all_found.mileages
    own, became = exhausted(
        mileages, measured_speeds(p, wheels, criterion.speed), criterion.required
    )
    at, outcomes = exhausted(
        mileages, measured_speeds(p, all_found.table, criterion.speed), criterion.required
    )
    low, median, high = percentiles(at, outcomes)
    return {
        "criterion": criterion.title, "required": criterion.required,
        "itself": None if np.isnan(own[0]) else own[0], "became": became[0],
        "median": median, "low": low, "high": high,
        **{name: outcomes.count(name) for name in (WITHIN, NEVER, FIRST, UNKNOWN)},
    }  # fmt: skip


def _as_they_are(all_found: Found) -> pd.DataFrame:
    """One campaign of the wheels themselves, in the columns of the measured ones."""
    return pd.concat([unmeasured(all_found.plan, case) for case in all_found.cases])


def campaign_mileages(p: Parameters, table: pd.DataFrame, criterion: Criterion) -> Array:
    """The mileages of the campaigns in which a criterion is exhausted within the series."""
    mileages = np.sort(table["mileage"].unique())
    at, _ = exhausted(mileages, measured_speeds(p, table, criterion.speed), criterion.required)
    return at[np.isfinite(at)]


def ways_table(p: Parameters, all_found: Found) -> pd.DataFrame:
    """What other ways to measure do: way, campaigns; lin_std and non_std: scatter of the speeds of
    one wheel, m/s (root mean square over the mileages); lin_mileage and non_mileage: standard
    deviation of the mileages.
    """
    tables = {"as measured": all_found.table, **all_found.variants}
    return pd.DataFrame([_way(p, words, table) for words, table in tables.items()])


def _way(p: Parameters, words: str, table: pd.DataFrame) -> dict[str, object]:
    row: dict[str, object] = {"way": words, "campaigns": table["sample"].nunique()}
    for criterion in criteria(p)[:2]:
        name = criterion.speed.removeprefix("v_")
        scatter = table.groupby("mileage")[criterion.speed].std()
        at = campaign_mileages(p, table, criterion)
        row[f"{name}_std"] = float(np.sqrt((scatter**2).mean()))
        row[f"{name}_mileage"] = float(at.std(ddof=1)) if len(at) > 1 else None
    return row


def advice(p: Parameters, all_found: Found) -> list[str]:
    """Words of advice, made of the numbers: one sentence a criterion."""
    last = all_found.mileages[-1]
    return [_sentence(row, last) for row in advice_table(p, all_found).to_dict("records")]


def _sentence(row: dict[Any, Any], last: float) -> str:
    counts = {name: int(row[name]) for name in (WITHIN, NEVER, FIRST, UNKNOWN)}
    title, total = str(row["criterion"]), sum(counts.values())
    start = f"{title[0].upper()}{title[1:]}, {row['required']:g} m/s"
    within = row["became"] == WITHIN
    itself = f"at {kilometres(row['itself'])}" if within else str(row["became"])
    end = f"With the wheels as they are: {itself}."
    if counts[NEVER] > total / 2:
        share = f"in {counts[NEVER]} of {total} campaigns"
        return f"{start}: kept up to {kilometres(last)}, the end of the series, {share}. {end}"
    if counts[FIRST] > total / 2:
        share = f"in {counts[FIRST]} of {total} campaigns"
        return f"{start}: not even kept by the first wheel {share}. {end}"
    if not counts[WITHIN]:
        return f"{start}: {_counted(counts)}. {end}"
    rest = {name: n for name, n in counts.items() if n and name != WITHIN}
    besides = f"; of {total} campaigns {_counted(rest)}" if rest else ""
    low, median, high = (_mileage(row[name], last) for name in ("low", "median", "high"))
    return (
        f"{start}: exhausted at {median} (5 to 95 per cent of the campaigns: {low} to {high})"
        f"{besides}. {end}"
    )


def _mileage(at: Any, last: float) -> str:
    known = at is not None and np.isfinite(at)
    return kilometres(at) if known else f"more than {kilometres(last)}"


def kilometres(mileage: float) -> str:
    """A mileage [1e4 km] in words, to the thousand: 46 000 km."""
    return f"{round(mileage * 10) * 1000:,} km".replace(",", "\N{NO-BREAK SPACE}")


def _counted(counts: dict[str, int]) -> str:
    return ", ".join(f"{n} {name}" for name, n in counts.items() if n)
