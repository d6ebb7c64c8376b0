"""Section 6: Hopf speed, first Lyapunov coefficient and nonlinear speeds by mileage, Table 4.

The contact of the worn wheels goes into the model as it was searched, averaged over a stated width,
not through a polynomial fit.

Source: Guo, Shi, Luo, Zeng, Nonlinear Dynamics 104 (2021) 989-1005, section 6, Table 4.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd

from wheelset.profiles import Contact
from wheelset.studies.on_profiles import OnProfiles, on_profiles, speeds_row
from wheelset.studies.worn_profiles import AT_THE_FLANGE, WearParameters

#: Widths over which the contact is averaged, m, to tell what does not depend on it.
WIDTHS = (3e-4, 5e-4, 1e-3)


def runs(
    p: WearParameters, contacts: Mapping[float, Contact], width: float | None = None
) -> dict[float, OnProfiles]:
    """The vehicle on worn wheels: Hopf point and cycles, by mileage."""
    vehicle = p.load(p.vehicle)
    return {m: on_profiles(vehicle, c, p.window, width or p.width) for m, c in contacts.items()}


def table_4(found: Mapping[float, OnProfiles]) -> pd.DataFrame:
    """Table 4, one row a mileage: mileage 1e4 km, then ``on_profiles.speeds_row``.

    v_fold m/s and fold_amplitude m are those of the slowest fold short of the flange.
    """
    rows = [{"mileage": m, **speeds_row(run), **_fold(run)} for m, run in found.items()]
    return pd.DataFrame(rows)


def _fold(run: OnProfiles) -> dict[str, float | None]:
    folds = [(float(f.values[0]), f.solution.measure("amplitude y")) for f in run.folds]
    v, amplitude = min((f for f in folds if f[1] < AT_THE_FLANGE), default=(None, None))
    return {"v_fold": v, "fold_amplitude": amplitude}


def width_frame(
    p: WearParameters, contacts: Mapping[float, Contact], known: pd.DataFrame
) -> pd.DataFrame:
    """Table 4 for the study's width and each of ``WIDTHS``: width m, then ``table_4``'s columns.

    known: ``table_4`` for the study's width.
    """
    frames = [known.assign(width=p.width)]
    others = [width for width in WIDTHS if width != p.width]
    frames += [table_4(runs(p, contacts, width)).assign(width=width) for width in others]
    return pd.concat(frames, ignore_index=True).sort_values(["width", "mileage"])


# --- trends ---------------------------------------------------------------------------------------


def trends(table: pd.DataFrame) -> dict[str, object]:
    """What the speeds and coefficients do as the mileage grows.

    table: mileage, v_lin m/s, flc; optionally v_fold m/s. Keys: fastest (mileage of the greatest
    Hopf speed), spread (greatest over least) and rank (correlation with the mileage) of the Hopf
    speed; signs of the FLC by mileage and their changes; fold_spread, fold_rank. None for what is
    missing.
    """
    speeds = table.dropna(subset=["v_lin"])
    signs = np.sign(speeds["flc"].to_numpy(float))
    spread, rank = _over_mileage(table, "v_lin")
    fold_spread, fold_rank = _over_mileage(table, "v_fold")
    order = speeds.sort_values("v_lin")["mileage"]
    return {
        "fastest": float(order.iloc[-1]) if len(order) else None,
        "spread": spread,
        "rank": rank,
        "signs": "".join("+" if s > 0 else "\u2212" for s in signs),
        "changes": int((np.diff(signs) != 0).sum()),
        "fold_spread": fold_spread,
        "fold_rank": fold_rank,
    }


def _over_mileage(table: pd.DataFrame, column: str) -> tuple[float | None, float | None]:
    """Greatest over least, and the rank correlation with the mileage; None without two values."""
    known = table.dropna(subset=[column]) if column in table else table[:0]
    if len(known) < 2:
        return None, None
    v = known[column].to_numpy(float)
    return float(v.max() / v.min()), rank_correlation(known["mileage"].tolist(), v.tolist())


def change(table: pd.DataFrame, column: str) -> tuple[float, float]:
    """A column's first and last known value by mileage; ValueError if there are not two."""
    known = table[column].dropna().astype(float)
    if len(known) < 2:
        raise ValueError(f"{column}: {len(known)} values; two are needed for a change")
    return float(known.iloc[0]), float(known.iloc[-1])


def rank_correlation(one: Sequence[float], other: Sequence[float]) -> float:
    """Spearman's: 1 where both rise together, -1 where one falls."""
    ranks = pd.DataFrame({"one": one, "other": other}).dropna().rank()
    return float(ranks["one"].corr(ranks["other"]))


# --- the other way round --------------------------------------------------------------------------


def crossing_frame(
    series: Mapping[str, pd.DataFrame], printed: Sequence[tuple[float, float]]
) -> pd.DataFrame:
    """At which simulated mileage a speed is a printed one.

    series: by name, with columns mileage 1e4 km and v m/s. printed: mileage and speed of the paper.
    Columns: mileage, v, then one a series, of words: the mileages, or a dash.
    """
    rows = []
    for mileage, speed in printed:
        found = {name: _words(crossings(curve, speed)) for name, curve in series.items()}
        rows.append({"mileage": mileage, "v": speed, **found})
    return pd.DataFrame(rows)


def _words(mileages: Sequence[float]) -> str:
    return ", ".join(f"{m:.1f}" for m in mileages) or "\u2013"


def crossings(curve: pd.DataFrame, speed: float) -> tuple[float, ...]:
    """The mileages at which a curve of speeds passes a speed [m/s], straight from row to row."""
    curve = curve.dropna(subset=["v"])
    v, m = curve["v"].to_numpy(float) - speed, curve["mileage"].to_numpy(float)
    k = np.flatnonzero(v[:-1] * v[1:] < 0)
    return tuple((m[k] - v[k] * (m[k + 1] - m[k]) / (v[k + 1] - v[k])).tolist())
