"""What became of every cycle bifurcation that section 3 prints: found, elsewhere, or no such thing.

A doubling of a symmetric cycle does not exist (it would need eigenvalues +-i of N = S Phi(T/2) at
once), so that a real one belongs to asymmetric cycles.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
import pandas as pd

from wheelset.bifurcation.curves.branch import SpecialPoint
from wheelset.studies.flange_cycle_artefacts import (
    Cycles,
    Printed,
    artefact,
    at_hopf,
    printed_points,
    speed_of,
)
from wheelset.studies.flange_cycle_claims import largest_amplitude
from wheelset.studies.flange_cycles import Family

#: The words of the verdicts.
REAL = "real"
ELSEWHERE = "real, at another speed"
CONSTANT_ONLY = "real if curvatures are constant"
ARTEFACT = "artefact"
OUTSIDE = "outside the domain"

#: A point this near to print is the printed one, m/s: the tolerance of cycle bifurcations.
NEAR = 0.505

#: Which coefficient MATCONT prints.
PRINTED_COEFFICIENT = {"LPC": "b", "PD": "c MATCONT"}


def verdict_frame(
    items: pd.DataFrame, filed: Iterable[Family], constant: Iterable[Family]
) -> pd.DataFrame:
    """A verdict on every printed bifurcation of cycles.

    items: item, quantity, published (of section 3). Columns: item, case, law, point, printed m/s,
    found m/s and coefficient (as MATCONT prints it, 1/s) in the cases as filed, found_constant and
    coefficient_constant with constant curvatures (NaN: none), y m (largest |y| of what the print
    is taken for), verdict, evidence.
    """
    printed = printed_points(items)
    here, there = tuple(filed), tuple(constant)
    return pd.DataFrame(
        [_row(one, printed, _cycles(here, one), _cycles(there, one)) for one in printed]
    )


def computed_numbers(
    items: pd.DataFrame, verdicts: pd.DataFrame, curves: pd.DataFrame
) -> dict[tuple[str, str], float | None]:
    """Our number for each item of section 3, in its unit; None where there is none.

    curves: ``curve_frame``, for the largest amplitude of case 1 without flange force.
    """
    rows = verdicts.set_index("item")
    numbers: dict[tuple[str, str], float | None] = {}
    for item, quantity in zip(items["item"], items["quantity"], strict=True):
        if item in rows.index:
            column = "coefficient" if quantity == "nfc" else "found"
            value = float(rows.loc[item, column])
            numbers[item, quantity] = None if np.isnan(value) else value
        elif quantity == "amplitude":
            numbers[item, quantity] = largest_amplitude(curves) * 1e3
    return numbers


def _cycles(families: Sequence[Family], one: Printed) -> Cycles:
    return Cycles(tuple(f for f in families if (f.case, f.law) == (one.case, one.law)))


def _row(
    one: Printed, printed: Sequence[Printed], filed: Cycles, constant: Cycles
) -> dict[str, object]:
    folded = filed if filed.nearest("LPC", one.speed) else constant
    fault = artefact(one, printed, folded)
    pair = [None if fault else c.nearest(one.point, one.speed) for c in (filed, constant)]
    word, evidence = (ARTEFACT, fault) if fault else _found(one, filed, constant)
    (here, b_here), (there, b_there) = (_numbers(one, special) for special in pair)
    return {
        "item": one.item, "case": one.case, "law": one.law, "point": one.point,
        "printed": one.speed, "found": here, "coefficient": b_here, "found_constant": there,
        "coefficient_constant": b_there, "y": _height(one, filed, constant),
        "verdict": word, "evidence": evidence,
    }  # fmt: skip


def _numbers(one: Printed, special: SpecialPoint | None) -> tuple[float, float]:
    """Speed and printed coefficient of a point, NaN in a table where there is none."""
    if special is None:
        return np.nan, np.nan
    return speed_of(special), special.coefficients.get(
        PRINTED_COEFFICIENT.get(one.point, ""), np.nan
    )


def _height(one: Printed, filed: Cycles, constant: Cycles) -> float:
    """Largest |y| of the cycle that a printed point is taken for, m."""
    if at_hopf(one, filed):
        return 0.0
    letters = "LPC" if one.point == "BPC" else one.point
    special = filed.nearest(letters, one.speed) or constant.nearest(letters, one.speed)
    return np.nan if special is None else max(np.abs(special.solution.extremes("y")))


def _found(one: Printed, filed: Cycles, constant: Cycles) -> tuple[str, str]:
    here, there = (c.nearest(one.point, one.speed) for c in (filed, constant))
    if here is not None and abs(speed_of(here) - one.speed) <= NEAR:
        return REAL, _found_words(here, one, filed)
    if there is not None and abs(speed_of(there) - one.speed) <= NEAR:
        found = _found_words(there, one, constant)
        missing = _missing_words(one, filed)
        return CONSTANT_ONLY, f"As filed: {missing} With constant curvatures: {found}"
    if here is not None and (one.point == "LPC" or _has_cycles(filed, one.speed)):
        return ELSEWHERE, f"{_found_words(here, one, filed)} {_constant_words(one, there)}".strip()
    words = [_missing_words(one, cycles) for cycles in (filed, constant)]
    return OUTSIDE, f"As filed: {words[0]} With constant curvatures: {words[1]}"


def _has_cycles(cycles: Cycles, speed: float) -> bool:
    """Whether a speed lies among those of the cycles. Folds are not asked: they bound them."""
    low, high = cycles.span
    return low <= speed <= high


def _found_words(special: SpecialPoint, one: Printed, cycles: Cycles) -> str:
    low, high = special.solution.extremes("y")
    owner = next(f for f in cycles.families if f.branch and special in f.branch.special)
    sort = "symmetric" if special.solution.symmetric else "asymmetric"
    speed = speed_of(special)
    return (
        f"Found at {speed:.3f} m/s ({speed - one.speed:+.2f}) on {sort} cycles (family "
        f"{owner.name}), y from {low * 1e3:.2f} to {high * 1e3:.2f} mm.{_beside(special, owner)}"
    )


def _beside(special: SpecialPoint, owner: Family) -> str:
    """What else of the same letters lies on the branch of a point."""
    assert owner.branch is not None
    others = [s for s in owner.branch.of_kind(special.kind) if s is not special]
    speeds = ", ".join(f"{speed_of(other):.3f}" for other in others)
    return f" Another {special.kind} of that family: {speeds} m/s." if others else ""


def _constant_words(one: Printed, there: SpecialPoint | None) -> str:
    if there is None:
        return ""
    return (
        f"With constant curvatures at {speed_of(there):.2f} ({speed_of(there) - one.speed:+.2f})."
    )


def _missing_words(one: Printed, cycles: Cycles) -> str:
    """What there is instead of a printed point."""
    low, high = cycles.span
    inside = "" if _has_cycles(cycles, one.speed) else f", where {one.speed:.2f} does not lie"
    special = cycles.nearest(one.point, one.speed)
    nearest = f"no {one.point} is among them"
    if special is not None:
        nearest = f"the nearest {one.point} is at {speed_of(special):.2f}"
    reach = max(p.solution.extremes("y")[1] for b in cycles.branches for p in b.points)
    return (
        f"cycles were followed from {low:.2f} to {high:.2f} m/s{inside}; {nearest}. They reach "
        f"|y| = {reach * 1e3:.2f} mm; how the branch from the Hopf point ends: "
        f"{cycles.branches[0].ended.words}."
    )
