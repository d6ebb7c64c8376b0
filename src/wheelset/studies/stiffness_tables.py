"""Fig. 11's curves as rows of tables, and the stiffness they ask for."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
import pandas as pd

from wheelset.bifurcation.curves.branch import Branch
from wheelset.studies.section_rows import claim_frame, part_where
from wheelset.studies.stiffness_curves import PANEL, STIFFNESSES, StiffnessCurves
from wheelset.studies.worn_profiles import Array

#: The two measures of the stiffness required: both alike, or the lateral one kept at Table 1's.
FIXED = 1e6

#: What the paper's "maximum of 25 %" lets a spread be, percent: within a twentieth, and a fifth.
PRINTED, LOOSE = (23.75, 26.25), 30.0


def curve_frame(found: Sequence[StiffnessCurves]) -> pd.DataFrame:
    """All points: mileage, curve (Hopf, LPC), Kpx N/m, Kpy N/m, flc or NaN, amplitude m or NaN."""
    frames = [frame for s in found for frame in _points(s)]
    columns = ["mileage", "curve", *STIFFNESSES, "flc", "amplitude"]
    return (
        pd.concat(frames, ignore_index=True)[columns] if frames else pd.DataFrame(columns=columns)
    )


def _points(s: StiffnessCurves) -> Iterator[pd.DataFrame]:
    if s.hopf is not None:
        table = s.hopf.table(("FLC",)).rename(columns={"FLC": "flc"})
        yield table.assign(mileage=s.mileage, curve="Hopf", amplitude=np.nan)
    if s.folds is not None:
        table = s.folds.table(("amplitude y",)).rename(columns={"amplitude y": "amplitude"})
        yield table.assign(mileage=s.mileage, curve="LPC", flc=np.nan)


def required(branch: Branch | None) -> dict[str, float | None]:
    """What a curve asks for: alike (Kpx = Kpy, N/m) and longitudinal (Kpx at Kpy = 1 MN/m).

    None where the curve does not pass there.
    """
    if branch is None:
        return {"alike": None, "longitudinal": None}
    kpx, kpy = branch.values.T
    alike = _passing(kpx - kpy, kpx, 0.0)
    return {"alike": alike, "longitudinal": _passing(kpy, kpx, FIXED)}


def _passing(along: Array, wanted: Array, value: float) -> float | None:
    """The largest of ``wanted`` where ``along`` passes a value."""
    k = np.flatnonzero((along[:-1] - value) * (along[1:] - value) <= 0)
    if not len(k):
        return None
    part = (value - along[k]) / (along[k + 1] - along[k])
    return float((wanted[k] + part * (wanted[k + 1] - wanted[k])).max())


def required_frame(found: Sequence[StiffnessCurves]) -> pd.DataFrame:
    """Required stiffness by mileage: mileage, curve, alike and longitudinal N/m, words."""
    rows = []
    for s in found:
        rows.append({"mileage": s.mileage, "curve": "Hopf", **required(s.hopf), "words": s.words})
        words = s.fold_words
        rows.append({"mileage": s.mileage, "curve": "LPC", **required(s.folds), "words": words})
    return pd.DataFrame(rows).astype({"alike": float, "longitudinal": float})


def spread(values: pd.Series) -> float | None:
    """Greatest less least over the least, percent; None with fewer than two values."""
    known = values.dropna()
    if len(known) < 2:
        return None
    return 100 * (float(known.max()) / float(known.min()) - 1)


def spread_frame(table: pd.DataFrame) -> pd.DataFrame:
    """Spread over the mileages: curve, measure, least and greatest N/m, spread percent, known."""
    rows = []
    for curve, mine in table.groupby("curve", sort=False):
        for measure in ("alike", "longitudinal"):
            values = mine[measure]
            rows.append(
                (curve, measure, values.min(), values.max(), spread(values), values.count())
            )
    return pd.DataFrame(rows, columns=["curve", "measure", "least", "greatest", "spread", "known"])


def figure_11_claims(curves: pd.DataFrame, table: pd.DataFrame) -> pd.DataFrame:
    """What section 6 says about Fig. 11, columns as ``claim_frame``.

    curves: ``curve_frame``; table: ``required_frame``.
    """
    hopf = curves[curves["curve"] == "Hopf"]
    required_alike = table[table["curve"] == "Hopf"]["alike"]
    shown = hopf["Kpx"].between(*PANEL["Kpx"]) & hopf["Kpy"].between(*PANEL["Kpy"])
    lines = [mine.sort_values("Kpx")["Kpy"] for _, mine in hopf.groupby("mileage")]
    falls = np.concatenate([np.diff(line) < 0 for line in lines]) if lines else np.array([], bool)
    return claim_frame([
        ("Fig. 11", "the required stiffness (Kpx = Kpy) varies with a maximum of 25 %: spread",
         spread(required_alike), "1", *PRINTED, LOOSE),
        ("Fig. 11", "every wheel has its curve on the panel: part of them",
         hopf[shown]["mileage"].nunique() / max(1, table["mileage"].nunique()), "1", 1.0, 1.0),
        ("Fig. 11", "more stable with larger stiffness: part of the curves that falls",
         part_where(falls), "1", 1.0, 1.0),
    ])  # fmt: skip
