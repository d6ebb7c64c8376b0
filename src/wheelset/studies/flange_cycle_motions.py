"""Symmetry breaking and doubling seen by plain integration: no mesh, no Floquet multiplier."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
import pandas as pd

from wheelset.bifurcation.curves.branch import Branch, SpecialPoint
from wheelset.bifurcation.integration.endings import SettledToCycle
from wheelset.bifurcation.integration.integrate import integrate
from wheelset.studies.flange_cycles import Family

#: Longest motion, s.
DURATION = 60.0

#: Where a motion starts: this part of a state of the cycle at the breaking, so beside all cycles.
BESIDE = 0.98

#: Speeds before the breaking, m/s.
BEFORE = 0.1

_WORDS = ("symmetric", "asymmetric", "doubled")


def settled_frame(families: Iterable[Family]) -> pd.DataFrame:
    """Motions that settle before a symmetry breaking, between it and the doubling, and behind that.

    families: of one case and law. Columns: expected (symmetric, asymmetric, doubled), v m/s, low m
    and high m (extremes of y), period s, ratio (to the period at the breaking), outcome in
    words; NaN where a motion has not settled. Empty where symmetry does not break.
    """
    columns = ["expected", "v", "low", "high", "period", "ratio", "outcome"]
    return pd.DataFrame(list(_rows(tuple(families))), columns=columns)


def _rows(families: tuple[Family, ...]) -> Iterator[dict[str, Any]]:
    breaking = _first(families[0].branch, "BPC")
    if breaking is None:
        return
    start = BESIDE * breaking.solution.at(0.0)
    for expected, v in zip(_WORDS, _speeds(families), strict=False):
        system = families[0].system.with_values(v=v)
        motion = integrate(system, start, DURATION, stop_when_settled=True)
        yield {
            "expected": expected,
            "v": v,
            **_settled(motion.outcome, breaking.solution.period),
            "outcome": str(motion.outcome),
        }


def _speeds(families: tuple[Family, ...]) -> list[float]:
    """Before the first breaking, between it and the first doubling, between that and the next: of
    the doubled cycles or, where the doubling is undone before, of the asymmetric ones.
    """
    marks = [_first(f.branch, kind) for f, kind in zip(families, ("BPC", "PD", "PD"), strict=False)]
    if len(families) > 1 and marks[-1] is None:
        marks[2:] = _all(families[1].branch, "PD")[1:2]
    found = [float(mark.values[0]) for mark in marks if mark is not None]
    between = [(a + b) / 2 for a, b in pairwise(found)]
    return [found[0] - BEFORE, *between]


def _first(branch: Branch | None, kind: str) -> SpecialPoint | None:
    return next(iter(_all(branch, kind)), None)


def _all(branch: Branch | None, kind: str) -> Sequence[SpecialPoint]:
    return branch.of_kind(kind) if branch is not None else ()


def _settled(outcome: object, period: float) -> dict[str, float]:
    if not isinstance(outcome, SettledToCycle):
        return dict.fromkeys(("low", "high", "period", "ratio"), np.nan)
    return {
        "low": float(outcome.lowest[0]),
        "high": float(outcome.highest[0]),
        "period": outcome.period,
        "ratio": outcome.period / period,
    }
