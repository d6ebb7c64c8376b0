"""What section 3 says about Fig. 6 in words, each sentence measured on the computed cycles.

``item`` is the panel's name: figure, then panel.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pandas as pd

#: Largest amplitude of case 1 without flange force that the text names, m, over the panel's speeds.
NAMED_AMPLITUDE, NAMED_UP_TO = 0.013, 65.0

#: Speeds, m/s: where amplitudes are compared, unless a branch ends before; where the polynomial
#: law's hunting was simulated (Fig. 5).
COMPARED_AT, SIMULATED_AT = 60.0, 40.0

#: A significantly smaller amplitude is below this part of the other, loosely below that one.
SMALLER, LOOSELY_SMALLER = 0.75, 0.9

#: "About 10 mm", m.
ABOUT_10_MM = (0.009, 0.011)

_PANELS = {"none": "none", "quintic": "polynomial", "exponential": "exponential"}
_COLUMNS = ("item", "claim", "measured", "unit", "low", "high", "loose")


def figure_6_claims(curves: pd.DataFrame) -> pd.DataFrame:
    """Fig. 6's panels: item, claim, measured, unit, low, high, loose, holds, tolerated.

    curves: ``curve_frame`` of one reading. A claim holds if low <= measured <= high and is
    tolerated up to ``loose``.
    """
    rows = [*_case_1(curves), *_case_2(curves)]
    complete = [row if len(row) == len(_COLUMNS) else (*row, row[-1]) for row in rows]
    claims = pd.DataFrame(complete, columns=list(_COLUMNS))
    claims["holds"] = claims["measured"].between(claims["low"], claims["high"])
    claims["tolerated"] = claims["measured"].between(claims["low"], claims["loose"])
    return claims


def _case_1(curves: pd.DataFrame) -> Sequence[tuple[object, ...]]:
    none, quintic, exponential = (born(curves, 1, law) for law in _PANELS)
    off = abs(largest_amplitude(curves) / NAMED_AMPLITUDE - 1)
    falls = float((np.diff(none["y"]) <= 0).sum() + (np.diff(none["v"]) <= 0).sum())
    common = min(COMPARED_AT, float(none["v"].max()), float(exponential["v"].max()))
    smaller = amplitude_at(exponential, common) / amplitude_at(none, common)
    return [
        ("Fig. 6: case 1, none", "steps on which amplitude or speed falls", falls, "1", 0.0, 0.0),
        ("Fig. 6: case 1, none", "reaches 13 mm: part by which it does not", off, "1",
         0.0, 0.05, 0.2),
        ("Fig. 6: case 1, polynomial", "a fold of cycles (LPC), number", count(curves, 1,
         "quintic", "LPC"), "1", 1.0, 1.0),
        ("Fig. 6: case 1, polynomial", "hunts at 40 m/s with about 10 mm",
         amplitude_at(quintic, SIMULATED_AT), "m", *ABOUT_10_MM),
        ("Fig. 6: case 1, exponential", f"amplitude at {common:.1f} m/s over that without flange",
         smaller, "1", 0.0, SMALLER, LOOSELY_SMALLER),
        ("Fig. 6: case 1, exponential", "unstable part of the branch up to 65 m/s",
         unstable(exponential[exponential["v"] < NAMED_UP_TO]), "1", 0.0, 0.0),
        ("Fig. 6: case 1, reciprocal", "period doublings (PD) on a first family, number",
         count(curves, 1, "reciprocal", "PD"), "1", 1.0, np.inf),
    ]  # fmt: skip


def _case_2(curves: pd.DataFrame) -> Sequence[tuple[object, ...]]:
    quintic, exponential = (born(curves, 2, law) for law in ("quintic", "exponential"))
    folds = {law: count(curves, 2, law, "LPC") for law in (*_PANELS, "reciprocal")}
    others = min(fold_speed(curves, 2, law) for law in ("exponential", "reciprocal"))
    ratio = fold_speed(curves, 2, "quintic") / others if np.isfinite(others) else np.inf
    return [
        ("Fig. 6: case 2, none", "a fold of cycles (LPC), number", folds["none"], "1", 1.0, 1.0),
        ("Fig. 6: case 2, polynomial", "a fold of cycles (LPC), number", folds["quintic"], "1",
         1.0, 1.0),
        ("Fig. 6: case 2, polynomial", "fold significantly changed: its speed over the others'",
         ratio, "1", 0.0, 0.8, 0.9),
        ("Fig. 6: case 2, polynomial", "hunts at 40 m/s with about 10 mm",
         amplitude_at(quintic, SIMULATED_AT), "m", *ABOUT_10_MM),
        ("Fig. 6: case 2, exponential", "a fold of cycles (LPC), number", folds["exponential"], "1",
         1.0, 1.0),
        ("Fig. 6: case 2, exponential", "unstable part of the branch beyond the fold",
         unstable(beyond_fold(exponential)), "1", 0.0, 0.0),
        ("Fig. 6: case 2, reciprocal", "a fold of cycles (LPC), number", folds["reciprocal"], "1",
         1.0, 1.0),
        ("Fig. 6: case 2, reciprocal", "period doublings (PD) on a first family, number",
         count(curves, 2, "reciprocal", "PD"), "1", 1.0, np.inf),
    ]  # fmt: skip


def largest_amplitude(curves: pd.DataFrame) -> float:
    """Largest |y| in m of case 1 without flange force, at the speeds of its panel."""
    none = born(curves, 1, "none")
    shown = none[none["v"] <= NAMED_UP_TO]
    return max(float(shown["y"].max()), amplitude_at(none, NAMED_UP_TO))


def born(curves: pd.DataFrame, case: int, law: str) -> pd.DataFrame:
    """The branch born at the Hopf point."""
    place = (curves["case"] == case) & (curves["law"] == law) & (curves["family"] == "H")
    return curves[place]


def count(curves: pd.DataFrame, case: int, law: str, letters: str) -> float:
    """Special points of these letters on the branch from the Hopf point and on what its first
    symmetry breaking sends off.
    """
    place = (curves["case"] == case) & (curves["law"] == law)
    near = curves["family"].isin(["H", "H BPC1"])
    return float((place & near & (curves["point"] == letters)).sum())


def fold_speed(curves: pd.DataFrame, case: int, law: str) -> float:
    """Speed of the first fold, m/s; infinite where there is none."""
    branch = born(curves, case, law)
    speeds = branch.loc[branch["point"] == "LPC", "v"]
    return float(speeds.iloc[0]) if len(speeds) else np.inf


def beyond_fold(branch: pd.DataFrame) -> pd.DataFrame:
    """The part of a branch after its first fold; all of it where it has none."""
    folds = np.flatnonzero(branch["point"] == "LPC")
    return branch.iloc[folds[0] + 1 :] if len(folds) else branch


def unstable(branch: pd.DataFrame) -> float:
    """Part of the ordinary points at which a branch is unstable."""
    return float((branch.loc[branch["point"] == "", "unstable"] > 0).mean())


def amplitude_at(branch: pd.DataFrame, speed: float) -> float:
    """Largest |y| in m of the largest cycle at a speed, between points by a straight line; zero
    where the branch has none.
    """
    v, y = branch["v"].to_numpy(), branch["y"].to_numpy()
    crossed = np.flatnonzero((v[:-1] - speed) * (v[1:] - speed) <= 0)
    parts = [(speed - v[i]) / (v[i + 1] - v[i]) for i in crossed]
    values = [y[i] + s * (y[i + 1] - y[i]) for i, s in zip(crossed, parts, strict=True)]
    return float(max(values, default=0.0))
