"""What else could have changed between Table 4's wheels: a1 and a3 beside other coefficients."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd

from wheelset.studies.inverse_geometry import Parameters, inverse_frame

#: What else may differ between the wheels: the ranges of Table 3 and of Fig. 8, SI.
FREEDOM: Mapping[str, tuple[float, ...]] = {
    "c0": (0.025, 0.05, 0.075),
    "c1": (-200.0, -50.0, 0.0, 50.0, 200.0),
    "e1": (-2500.0, -1000.0, 0.0, 1000.0),
}


def freedom_frame(
    p: Parameters, vehicle: str, printed: Sequence[tuple[float, float, float]], reading: str
) -> pd.DataFrame:
    """How a1 and a3 of every row move with another coefficient; with the curvatures' only where the
    study keeps them.

    Columns: parameter, value (SI), mileage, a1, neutral, a3.
    """
    frames = []
    kept_as_given = {change.split("=")[0] for change in p.given(vehicle)}
    for name, values in FREEDOM.items():
        for value in () if name in kept_as_given else values:
            table = inverse_frame(p, vehicle, printed, [f"{name}={value}"])
            table["a3"] = table[reading]
            kept = table[["mileage", "a1", "neutral", "a3"]]
            frames.append(kept.assign(parameter=name, value=value))
    columns = ["parameter", "value", "mileage", "a1", "neutral", "a3"]
    return pd.concat(frames, ignore_index=True)[columns]


def moved_frame(freedom: pd.DataFrame) -> pd.DataFrame:
    """By how much a1 and a3 move over the values of each coefficient, beside the rows' own spread.

    Columns: parameter, least, greatest (SI), a1 (largest move of a row, percent of its mean), a1
    rows (spread over the mileages at the middle value, percent), neutral (largest move, 1/m2).
    """
    rows = []
    for name, mine in freedom.groupby("parameter", sort=False):
        a1 = mine.pivot_table(index="mileage", columns="value", values="a1")
        neutral = mine.pivot_table(index="mileage", columns="value", values="neutral")
        middle = a1[a1.columns[len(a1.columns) // 2]]
        rows.append({
            "parameter": name, "least": a1.columns.min(), "greatest": a1.columns.max(),
            "a1": 100 * float((np.ptp(a1, axis=1) / a1.mean(axis=1)).max()),
            "a1 rows": 100 * float(np.ptp(middle) / middle.mean()),
            "neutral": float(np.ptp(neutral, axis=1).max()),
        })  # fmt: skip
    return pd.DataFrame(rows)
