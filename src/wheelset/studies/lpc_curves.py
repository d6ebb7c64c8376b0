"""Section 5: the nonlinear critical speed over one coefficient at a time, Fig. 8.

The first fold of the cycles (LPC) is followed in speed and coefficient; where it ends in a
generalised Hopf point (GH) the same curve is computed again from there.

Source: Guo, Shi, Luo, Zeng, Nonlinear Dynamics 104 (2021) 989-1005, section 5, Fig. 8.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from wheelset.bifurcation.curves.branch import Branch, BranchPoint, SpecialPoint
from wheelset.bifurcation.curves.continuation import both_ways, follow
from wheelset.bifurcation.cycles.critical_start import lpc_from_cycle, lpc_from_gh, with_gh_ends
from wheelset.bifurcation.cycles.cycle import Cycle
from wheelset.bifurcation.equilibria.hopf_curve import GHPoint, gh_point
from wheelset.bifurcation.outcomes import NumericalOutcome
from wheelset.bifurcation.system import System
from wheelset.studies.first_fold import SECTION_5, WIDTH, FirstFold, first_fold
from wheelset.studies.section_curves import ReadingsParameters, Scan, hopf_at, hopf_branch, reached

#: Fig. 8's panels, and how far curves are followed beyond them.
FIGURE_8: tuple[Scan, ...] = (
    Scan("a", "a1", (0.0, 1.0), (0.0, 1.0)),
    Scan("b", "a3", (-1e3, 5e3), (-1e3, 5e3)),
    Scan("c", "c1", (-200.0, 200.0), (-400.0, 3000.0)),
    Scan("d", "c3", (-3e5, 3e5), (-3e5, 3e5)),
    Scan("e", "e1", (-2500.0, 1000.0), (-4000.0, 4000.0)),
    Scan("f", "e3", (-1e5, 1e5), (-1e5, 1e5)),
    Scan("g", "f1", (-2500.0, 1500.0), (-4400.0, 4400.0)),
    Scan("h", "f3", (6.3e6, 6.7e6), (6.3e6, 6.7e6)),
)

#: Speeds between which folds are followed, m/s.
FOLD_SPEEDS = (1.0, 400.0)

_POINTS = {"quick": 9, "paper": 41}


class Parameters(ReadingsParameters):
    """Parameters of the study of section 5's fold curves."""


@dataclass(frozen=True, eq=False)
class FoldScan:
    """A vehicle's Hopf curve and fold curve over the window of a panel.

    hopf: None without a Hopf point. folds: None where ``words`` says why.
    """

    vehicle: str
    scan: Scan
    system: System
    hopf: Branch | None
    folds: Branch | None
    words: str

    @property
    def parameters(self) -> tuple[str, str]:
        """The speed and the coefficient."""
        return "v", self.scan.parameter

    @property
    def labels(self) -> dict[str, str]:
        """What its rows begin with."""
        names = {"panel": self.scan.panel, "vehicle": self.vehicle}
        return {**names, "parameter": self.scan.parameter}

    @property
    def gh(self) -> tuple[SpecialPoint, ...]:
        """Generalised Hopf points in which the fold curve ends."""
        return () if self.folds is None else self.folds.of_kind("GH")


def default_fold(p: ReadingsParameters, vehicle: str | None = None) -> FirstFold:
    """The fold from which all panels start: section 5's geometry, with the reader's changes."""
    return first_fold(p.load(vehicle or p.vehicle, given=SECTION_5), p.window)


def fold_scans(p: ReadingsParameters, vehicle: str | None = None) -> tuple[FoldScan, ...]:
    """Fig. 8's curves of a vehicle (default: the study's)."""
    name = vehicle or p.vehicle
    found = default_fold(p, name)
    return tuple(_scanned(p, name, found, scan) for scan in FIGURE_8)


def _scanned(p: ReadingsParameters, vehicle: str, found: FirstFold, scan: Scan) -> FoldScan:
    window = scan.around(found.system.values[scan.parameter])
    hopf = (
        hopf_branch(found.system, found.hopf, scan.parameter, window, p.control)
        if found.hopf
        else None
    )
    folds, words = _folds(found, scan, window)
    return FoldScan(vehicle, scan, found.system, hopf, folds, words)


def _folds(found: FirstFold, scan: Scan, window: tuple[float, float]) -> tuple[Branch | None, str]:
    """The fold curve both ways through a window, or why there is none."""
    if found.cycle is None:
        return None, found.words
    try:
        start = lpc_from_cycle(
            found.system, found.cycle, ("v", scan.parameter), (WIDTH, window[1] - window[0])
        )
        windows = {"v": FOLD_SPEEDS, scan.parameter: window}
        branch = both_ways(
            start.problem, start.u, direction=start.tangent, windows=windows, steps=400,
            kind="folds of cycles",
        )  # fmt: skip
        return with_gh_ends(found.system, branch), ""
    except NumericalOutcome as outcome:
        return None, f"the fold could not be followed: {outcome}"


# --- the fold at given values --------------------------------------------------------------------


def sheet(folds: Branch) -> list[BranchPoint]:
    """The points around the start up to where the coefficient turns, growing coefficient."""
    start = next(i for i, point in enumerate(folds.points) if point.arclength == 0.0)
    value = folds.values[:, 1]
    steps = np.sign(np.diff(value))
    if not len(steps):
        return list(folds.points)
    sense = steps[min(start, len(steps) - 1)]
    left = right = start
    while right < len(steps) and steps[right] == sense:
        right += 1
    while left > 0 and steps[left - 1] == sense:
        left -= 1
    points = list(folds.points[left : right + 1])
    return points if sense > 0 else points[::-1]


def fold_at(s: FoldScan, value: float) -> Cycle | None:
    """The cycle at the fold for a value of the coefficient; None beyond the sheet's ends."""
    if s.folds is None:
        return None
    points = sheet(s.folds)
    at = np.array([float(point.values[1]) for point in points])
    if not reached(value, at):
        return None
    near: Cycle = points[int(np.argmin(np.abs(at - value)))].solution
    guess = replace(near, parameters={**near.parameters, s.scan.parameter: value})
    widths = (WIDTH, float(at[-1] - at[0]))
    start = lpc_from_cycle(s.system, guess, s.parameters, widths)
    cycles = start.problem.cycles
    return cycles.cycle(start.u, start.problem.linearised(start.u).floquet)


def speeds_at(s: FoldScan, values: Sequence[float]) -> pd.DataFrame:
    """Both critical speeds solved for at given values of the coefficient.

    Columns: value, v_lin m/s, flc, v_non m/s, amplitude m, period s; missing (NaN) where the curve
    does not reach.
    """
    return pd.DataFrame([_speeds(s, value) for value in values])


def _speeds(s: FoldScan, value: float) -> dict[str, float | None]:
    hopf = None if s.hopf is None else hopf_at(s.system, s.hopf, value)
    cycle = fold_at(s, value)
    return {
        "value": value,
        "v_lin": hopf.value if hopf else np.nan,
        "flc": hopf.lyapunov if hopf and hopf.lyapunov is not None else np.nan,
        "v_non": cycle.measure("v") if cycle else np.nan,
        "amplitude": cycle.measure("max y") if cycle else np.nan,
        "period": cycle.period if cycle else np.nan,
    }


def grid(p: ReadingsParameters, scan: Scan) -> NDArray[np.float64]:
    """Values of the coefficient spread evenly over the panel."""
    return np.linspace(*scan.window, _POINTS[p.resolution])


# --- the same curve from its other end -----------------------------------------------------------


def from_gh_frame(scans: Sequence[FoldScan]) -> pd.DataFrame:
    """Fold curves that end in GH, computed again from there back to the vehicle's own value.

    Columns: panel, vehicle, parameter, gh (SI), slc, v_cycle and v_gh m/s (the speed at the
    vehicle's own value by either way), difference m/s, words.
    """
    rows = [_from_gh(s, point) for s in scans for point in s.gh]
    names = ("panel", "vehicle", "parameter", "gh", "slc", "v_cycle", "v_gh", "difference", "words")
    return pd.DataFrame(rows, columns=list(names))


def _from_gh(s: FoldScan, point: SpecialPoint) -> dict[str, object]:
    own = s.system.values[s.scan.parameter]
    known = fold_at(s, own)
    assert known is not None
    row: dict[str, object] = {
        **s.labels,
        "gh": float(point.values[1]),
        "slc": point.coefficients["SLC"],
    }
    speed_here = known.measure("v")
    row["v_cycle"] = speed_here
    try:
        branch = _back(s, _gh(s, point), own)
    except NumericalOutcome as outcome:
        return {**row, "v_gh": None, "difference": None, "words": str(outcome)}
    speed, value = branch.values[-1]
    if value != own and abs(value - own) > 1e-9 * abs(own):
        return {**row, "v_gh": None, "difference": None, "words": branch.ended.words}
    return {**row, "v_gh": speed, "difference": speed - speed_here, "words": "arrived"}


def _gh(s: FoldScan, point: SpecialPoint) -> GHPoint:
    speed, value = map(float, point.values)
    near = (np.zeros(s.system.n), point.coefficients["frequency"], {"v": speed})
    return gh_point(s.system.with_values(**{s.scan.parameter: value}), s.parameters, near)


def _back(s: FoldScan, gh: GHPoint, own: float) -> Branch:
    """The fold curve from GH up to a value of the coefficient."""
    low, high = s.scan.around(own)
    start = lpc_from_gh(s.system, gh, (WIDTH, high - low))
    window = (low, own) if gh.values[1] < own else (own, high)
    return follow(
        start.problem, start.u, direction=start.tangent,
        windows={"v": FOLD_SPEEDS, s.scan.parameter: window}, steps=400, kind="folds of cycles",
    )  # fmt: skip
