"""Section 3's limit cycles as tables: curves, special points, ends, folds' sensitivities."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
import pandas as pd

from wheelset.bifurcation.curves.branch import BranchPoint, SpecialPoint
from wheelset.bifurcation.cycles.critical_start import lpc_from_cycle
from wheelset.bifurcation.cycles.cycle import Cycle
from wheelset.studies.flange_cycles import Family

#: Coefficients that a fold's speed may depend on, besides the flange law's own.
GEOMETRY = ("a1", "a3", "p0", "e0", "nu")
FLANGE = {
    "quintic": ("d1", "d2"), "exponential": ("p1", "q1"), "reciprocal": ("p2", "q2"),
}  # fmt: skip

#: Coefficients of special points, by the engine's names and the tables'.
COEFFICIENTS = {"b": "b", "dT/ds": "dT/ds", "c": "c", "c MATCONT": "c MATCONT"}

#: Typical change of the speed, m/s, for norms.
WIDTH = 10.0


def curve_frame(families: Iterable[Family]) -> pd.DataFrame:
    """Points of all branches in order, special ones among them.

    Columns: reading, case, law, family, v m/s, y m (largest |y|), mean m (of the extremes of y),
    period s, unstable (number of directions), point (letters, "" at an ordinary point).
    """
    return pd.DataFrame([row for family in families for row in _curve_rows(family)])


def _curve_rows(family: Family) -> list[dict[str, object]]:
    """What the table of a branch says, by name; a branch that is missing has no rows."""
    if family.branch is None:
        return []
    points: list[tuple[float, str, BranchPoint | SpecialPoint]]
    points = [(float(i), "", point) for i, point in enumerate(family.branch.points)]
    points += [(special.index, special.kind, special) for special in family.branch.special]
    return [
        {**_place(family), **_measures(point.values, point.solution), "point": letters}
        for _, letters, point in sorted(points, key=lambda row: row[:2])
    ]


def _place(family: Family) -> dict[str, object]:
    return {
        "reading": family.reading, "case": family.case, "law": family.law, "family": family.name,
    }  # fmt: skip


def _measures(values: np.ndarray, cycle: Cycle) -> dict[str, object]:
    low, high = cycle.extremes("y")
    return {
        "v": float(values[0]),
        "y": max(high, -low),
        "mean": (high + low) / 2,
        "period": cycle.period,
        "unstable": cycle.unstable,
    }


def point_frame(families: Iterable[Family]) -> pd.DataFrame:
    """Every special point: the columns of ``curve_frame``, b, dT/ds, c, c MATCONT (NaN where a
    point has none), words.
    """
    rows = [
        {
            **_place(family),
            "point": special.kind,
            **_measures(special.values, special.solution),
            **{name: special.coefficients.get(key, np.nan) for key, name in COEFFICIENTS.items()},
            "words": special.words,
        }
        for family in families
        if family.branch is not None
        for special in family.branch.special
    ]
    columns = [
        "reading", "case", "law", "family", "point", "v", "y", "mean", "period", "unstable",
        *COEFFICIENTS.values(), "words",
    ]  # fmt: skip
    return pd.DataFrame(rows, columns=columns)


def end_frame(families: Iterable[Family]) -> pd.DataFrame:
    """How every family ends: reading, case, law, family, hopf m/s, v m/s and y m of the last cycle
    (NaN where there is none), stable (whether it is), ended in words.
    """
    return pd.DataFrame([{**_place(family), **_end(family)} for family in families])


def _end(family: Family) -> dict[str, object]:
    if family.branch is None:
        none = {"v": np.nan, "y": np.nan, "stable": False}
        return {"hopf": family.hopf, **none, "ended": f"could not be started: {family.missing}"}
    last = family.branch.points[-1]
    measures = _measures(last.values, last.solution)
    return {
        "hopf": family.hopf,
        "v": measures["v"],
        "y": measures["y"],
        "stable": measures["unstable"] == 0,
        "ended": family.branch.ended.words,
    }


def sensitivity_frame(families: Iterable[Family]) -> pd.DataFrame:
    """How the first fold of each family moves with the coefficients, exactly, along its LPC curve.

    Columns: reading, case, law, family, v m/s, parameter, value (SI), slope (m/s per SI unit),
    percent (m/s for one percent of the value).
    """
    rows: list[dict[str, Any]] = []
    for family in families:
        folds = () if family.branch is None else family.branch.of_kind("LPC")
        for fold in folds[:1]:
            rows += [_sensitivity(family, fold, name) for name in _coefficients(family)]
    columns = ["reading", "case", "law", "family", "v", "parameter", "value", "slope", "percent"]
    return pd.DataFrame(rows, columns=columns)


def _coefficients(family: Family) -> Sequence[str]:
    names = (*GEOMETRY, *FLANGE.get(family.law, ()))
    return [name for name in names if family.system.values.get(name)]


def _sensitivity(family: Family, fold: SpecialPoint, name: str) -> dict[str, Any]:
    start = lpc_from_cycle(family.system, fold.solution, ("v", name), (WIDTH, None))
    here, there = (start.problem.values(u) for u in (start.u, start.u + start.tangent))
    slope, value = float((there - here)[0] / (there - here)[1]), float(here[1])
    return {
        **_place(family), "v": float(here[0]), "parameter": name, "value": value, "slope": slope,
        "percent": slope * value / 100,
    }  # fmt: skip
