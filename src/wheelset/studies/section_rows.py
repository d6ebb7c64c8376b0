"""Curves of sections 4 and 5 as rows of tables, their special points, and claims about them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

from wheelset.bifurcation.curves.branch import Branch, SpecialPoint

Array = NDArray[np.float64]

#: Two values of opposite sign, or further apart than this factor, are not the same point.
APART = 5.0

_CLAIM = ("item", "claim", "measured", "unit", "low", "high", "loose")


def hopf_frame(branch: Branch) -> pd.DataFrame:
    """A Hopf curve: curve, value (SI), v m/s, flc, part (H-, H+, or GH at such a point), point
    (letters of special points), amplitude m (none).
    """
    table = branch.table(("frequency", "FLC"))
    value, speed = branch.parameters[1], branch.parameters[0]
    rows = [
        (at, v, flc, "GH" if point == "GH" else _part(float(flc)), point)
        for at, v, flc, point in zip(
            table[value], table[speed], table["FLC"], table["point"], strict=True
        )
    ]
    frame = pd.DataFrame(rows, columns=["value", "v", "flc", "part", "point"])
    frame.insert(0, "curve", "Hopf")
    return frame.assign(amplitude=np.nan)


def _part(flc: float) -> str:
    if np.isnan(flc):
        return ""
    return "H-" if flc < 0 else "H+"


def special_frame(points: Sequence[SpecialPoint]) -> pd.DataFrame:
    """Special points of a curve in two parameters: point, value (SI), v m/s, slc."""
    rows = [
        (one.kind, float(one.values[1]), float(one.values[0]), one.coefficients.get("SLC", np.nan))
        for one in points
    ]
    return pd.DataFrame(rows, columns=["point", "value", "v", "slc"])


def gh_for(
    points: pd.DataFrame, wanted: Sequence[tuple[str, float]], words: Mapping[str, str]
) -> pd.DataFrame:
    """The generalised Hopf points found that stand for wanted ones: parameter, value.

    points: parameter, value, v, slc. words: by parameter, how far was searched. Columns: parameter,
    wanted, value, v m/s, slc (NaN where there is none), words.
    """
    rows = []
    for parameter in dict.fromkeys(name for name, _ in wanted):
        mine = points[points["parameter"] == parameter].set_index("value")
        values = [value for name, value in wanted if name == parameter]
        for value, found in matched(mine.index.tolist(), values).items():
            v, slc = (np.nan, np.nan) if found is None else mine.loc[found, ["v", "slc"]]
            none = f"No GH of this sign and size for {parameter}: {words.get(parameter, '')}"
            said = none if found is None else ""
            rows.append((parameter, value, np.nan if found is None else found, v, slc, said))
    return pd.DataFrame(rows, columns=["parameter", "wanted", "value", "v", "slc", "words"])


def matched(found: Sequence[float], wanted: Sequence[float]) -> dict[float, float | None]:
    """The found value that stands for each wanted one, each used once; None where there is none.

    Pairs have one sign and differ by less than the factor ``APART``; all together they differ by
    the least product of factors.
    """
    pairs: dict[float, float | None] = dict.fromkeys(wanted)
    if not len(found) or not len(wanted):
        return pairs
    ratio = np.divide.outer(np.array(wanted, float), np.array(found, float))
    most = np.log(APART)
    cost = np.abs(np.log(np.where(ratio > 0, ratio, 1e9)))
    near = np.where(cost < most, cost, 10 * most)
    for row, column in zip(*linear_sum_assignment(near), strict=True):
        if cost[row, column] < most:
            pairs[wanted[row]] = float(found[column])
    return pairs


def ends(branch: Branch) -> tuple[tuple[Array, str], tuple[Array, str]]:
    """Both ends of a curve in two parameters: (values, words), lower coefficient first."""
    first = branch.points[0].values, branch.began.words
    last = branch.points[-1].values, branch.ended.words
    return (first, last) if first[0][1] <= last[0][1] else (last, first)


def claim_frame(rows: Sequence[Sequence[object]]) -> pd.DataFrame:
    """Claims: item, claim, measured, unit, low, high, loose, holds, tolerated.

    A row may leave ``loose`` out. A claim holds if low <= measured <= high, and is tolerated up to
    loose; a measure that could not be taken (None) holds for nothing.
    """
    complete = [row if len(row) == len(_CLAIM) else (*row, row[-1]) for row in rows]
    claims = pd.DataFrame(complete, columns=list(_CLAIM))
    claims["measured"] = claims["measured"].astype(float)
    claims["holds"] = claims["measured"].between(claims["low"], claims["high"])
    claims["tolerated"] = claims["measured"].between(claims["low"], claims["loose"])
    return claims


def part_where(steps: NDArray[np.bool_]) -> float | None:
    """The part of neighbouring pairs of which something holds; None if there is no pair."""
    return float(np.mean(steps)) if len(steps) else None


def exponent(frame: pd.DataFrame, column: str) -> float:
    """The power of the coefficient that a speed follows from the first to the last row."""
    first, last = frame.iloc[0], frame.iloc[-1]
    ratio: float = np.log(last[column] / first[column]) / np.log(last["value"] / first["value"])
    return float(ratio)


def labelled(frame: pd.DataFrame, labels: Mapping[str, str]) -> pd.DataFrame:
    """The frame with columns put in front that say what it belongs to."""
    for position, (name, text) in enumerate(labels.items()):
        frame.insert(position, name, text)
    return frame
