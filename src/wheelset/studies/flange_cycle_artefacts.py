"""Branch points of cycles in print that are none: the Hopf point, or a fold, under another name.

On half a period of a symmetric cycle symmetry breaks where an eigenvalue of N = S Phi(T/2) is -1,
and the fold is where a second one is +1: the two cannot be taken for each other.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd

from wheelset.bifurcation.curves.branch import Branch, SpecialPoint
from wheelset.studies.flange_cycles import Family

#: A branch point printed this near to the Hopf speed is the Hopf point, m/s; one this near to a
#: printed fold is that fold.
AT_HOPF, AT_FOLD = 0.02, 0.15

#: Names of the flange laws in print and here.
LAW = {"polynomial": "quintic"}

_ITEM = re.compile(r"Section 3: case (\d), (\w+), (LPC|BPC|PD)")


@dataclass(frozen=True)
class Printed:
    """A printed bifurcation of cycles: its item's name, where it belongs, its speed in m/s."""

    item: str
    case: int
    law: str
    point: str
    speed: float


@dataclass(frozen=True)
class Cycles:
    """All families of a case under a law in one reading."""

    families: tuple[Family, ...]

    @property
    def branches(self) -> tuple[Branch, ...]:
        """Those that could be followed."""
        return tuple(f.branch for f in self.families if f.branch is not None)

    @property
    def hopf(self) -> float:
        """Speed of the Hopf point, m/s."""
        return self.families[0].hopf

    @property
    def span(self) -> tuple[float, float]:
        """Lowest and highest speed at which a cycle was found, m/s."""
        speeds = [float(b.values[:, 0].min()) for b in self.branches]
        return min(speeds), max(float(b.values[:, 0].max()) for b in self.branches)

    def nearest(self, letters: str, speed: float) -> SpecialPoint | None:
        """The special point of these letters nearest to a speed."""
        found = [s for b in self.branches for s in b.of_kind(letters)]
        return min(found, key=lambda s: abs(speed_of(s) - speed), default=None)


def printed_points(items: pd.DataFrame) -> tuple[Printed, ...]:
    """The bifurcations of cycles among the items."""
    found = []
    for row in items.itertuples():
        match = _ITEM.match(str(row.item))
        if match and str(row.quantity).endswith("_speed"):
            case, flange, point = match.groups()
            law = LAW.get(flange, flange)
            found.append(Printed(str(row.item), int(case), law, point, float(str(row.published))))
    return tuple(found)


def speed_of(special: SpecialPoint) -> float:
    """Speed of a special point, m/s."""
    return float(special.values[0])


def at_hopf(one: Printed, cycles: Cycles) -> bool:
    """Whether a printed branch point is the Hopf point."""
    return one.point == "BPC" and abs(one.speed - cycles.hopf) <= AT_HOPF


def artefact(one: Printed, printed: Sequence[Printed], cycles: Cycles) -> str:
    """Why a printed branch point is none, or nothing.

    cycles: of a reading that has the fold, where one has it.
    """
    if one.point != "BPC":
        return ""
    if at_hopf(one, cycles):
        return _hopf_words(cycles)
    folds = [q for q in printed if (q.case, q.law, q.point) == (one.case, one.law, "LPC")]
    if folds and abs(folds[0].speed - one.speed) <= AT_FOLD:
        return _fold_words(one, folds[0], cycles)
    return ""


def _hopf_words(cycles: Cycles) -> str:
    first = cycles.branches[0].points[0].solution
    return (
        f"The Hopf point, {cycles.hopf:.2f} m/s: the branch turns there at size zero and comes "
        "back with its phase shifted. On the smallest cycle computed no eigenvalue is nearer to "
        f"−1 than {_from_minus_one(first.computed):.2f}: symmetry does not break."
    )


def _fold_words(one: Printed, fold: Printed, cycles: Cycles) -> str:
    below = fold.speed - one.speed
    apart = (
        f"It lies {below:.2f} m/s below the fold printed beside it, where the branch has no cycles."
        if below > 0.005
        else "It is the number of the fold printed beside it."
    )
    return f"{apart} {_at_our_fold(cycles, fold)} {_breaking(cycles)}"


def _at_our_fold(cycles: Cycles, printed: Printed) -> str:
    fold = cycles.nearest("LPC", printed.speed)
    if fold is None:
        return "No fold is found here, so that nothing can be evaluated at it."
    branch = cycles.branches[0]
    before, after = (branch.points[int(fold.index) + k].tests["branch"] for k in (0, 1))
    sign = "keeps" if before * after > 0 else "changes"
    return (
        f"At our fold ({speed_of(fold):.2f} m/s) the eigenvalue nearest to −1 is "
        f"{_from_minus_one(fold.solution.computed):.2f} away from it, and the bordered "
        f"determinant {sign} its sign."
    )


def _breaking(cycles: Cycles) -> str:
    branch = cycles.branches[0]
    breaks = branch.of_kind("BPC")
    if not breaks:
        last = branch.points[-1]
        reach = max(last.solution.extremes("y")) * 1e3
        return (
            "Symmetry breaks nowhere on the branch, which was followed to "
            f"{float(last.values[0]):.2f} m/s, |y| = {reach:.2f} mm."
        )
    first = breaks[0]
    reach = max(first.solution.extremes("y")) * 1e3
    return f"Symmetry does break at {speed_of(first):.2f} m/s, |y| = {reach:.2f} mm."


def _from_minus_one(values: np.ndarray) -> float:
    return float(np.abs(values + 1).min())
