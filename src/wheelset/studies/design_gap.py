"""Where the first Lyapunov coefficient mispredicts the gap between the two critical speeds.

Near the Hopf point r' = r (l' (v - v_lin) + FLC r^2), with y = 2 r |q_y| cos. If the flange alone
ended the growth, at the clearance eta, the cycles would turn at

    v_lin - v_non = FLC r^2 / l',    r = eta / (2 |q_y|),

in proportion to FLC. What is left out is the fifth order of the contact geometry.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd

from wheelset.bifurcation.curves.branch import Branch, BranchPoint
from wheelset.bifurcation.curves.continuation import both_ways
from wheelset.bifurcation.cycles.critical_start import lpc_from_cycle
from wheelset.bifurcation.equilibria.hopf import HopfPoint, hopf_point
from wheelset.bifurcation.equilibria.hopf_curve import hopf_curve
from wheelset.bifurcation.equilibria.hopf_sensitivity import eigenvalue_slopes
from wheelset.bifurcation.equilibria.lyapunov import critical_pair
from wheelset.bifurcation.outcomes import NumericalOutcome
from wheelset.bifurcation.system import System
from wheelset.studies.design import Reading
from wheelset.studies.first_fold import WIDTH


@dataclass(frozen=True)
class Range:
    """A parameter and the values over which the gap is looked at, SI."""

    parameter: str
    low: float
    high: float


#: What section 5 varies in Table 3.
RANGES = (Range("a1", 0.05, 0.5), Range("a3", 20.0, 5000.0), Range("c1", -140.0, 400.0))

#: Points of a curve at which the gap is estimated, at most.
MOST = 40

#: Folds of smaller cycles than this, m, are beside a generalised Hopf point, where both vanish.
SMALL = 1e-4


def gaps(reading: Reading) -> pd.DataFrame:
    """The gap along curves of folds beside its estimate.

    Columns: parameter, value (SI), v_lin, v_non, gap m/s, flc, estimate m/s, ratio (gap over
    estimate), amplitude m (of the cycle at the fold); words where a curve could not be followed.
    """
    return pd.concat([_along(reading, r) for r in RANGES], ignore_index=True)


def _along(reading: Reading, scan: Range) -> pd.DataFrame:
    system, names = reading.found.system, ("v", scan.parameter)
    window = {scan.parameter: (scan.low, scan.high)}
    try:
        hopf = hopf_curve(system, reading.hopf, names, window)
        start = lpc_from_cycle(system, reading.cycle, names, (WIDTH, scan.high - scan.low))
        folds = both_ways(
            start.problem, start.u, direction=start.tangent, windows=window, steps=400
        )
    except NumericalOutcome as outcome:
        return pd.DataFrame([{"parameter": scan.parameter, "words": str(outcome)}])
    points = [point for point in folds.points if _amplitude(point) > SMALL]
    chosen = np.unique(np.linspace(0, len(points) - 1, MOST).round().astype(int))
    rows = [_row(reading, scan.parameter, hopf, points[i]) for i in chosen]
    return pd.DataFrame([row for row in rows if row is not None])


def _hopf_beside(system: System, hopf: Branch, value: float) -> HopfPoint | None:
    """The Hopf point with the second parameter at a value; None off the Hopf curve."""
    speeds, values = hopf.values[:, 0], hopf.values[:, 1]
    order = np.argsort(values)
    if not values[order[0]] <= value <= values[order[-1]]:
        return None
    return hopf_point(system, "v", float(np.interp(value, values[order], speeds[order])))


def _amplitude(point: BranchPoint) -> float:
    return float(point.solution.measure("max y"))


def _row(
    reading: Reading, name: str, curve: Branch, point: BranchPoint
) -> dict[str, object] | None:
    v_non, value = map(float, point.values)
    system = reading.found.system.with_values(**{name: value})
    hopf = _hopf_beside(system, curve, value)
    if hopf is None:
        return None
    estimate = estimated_gap(system, hopf, reading.values["eta"])
    gap = hopf.value - v_non
    return {
        "parameter": name,
        "value": value,
        "v_lin": hopf.value,
        "v_non": v_non,
        "gap": gap,
        "flc": hopf.lyapunov,
        "estimate": estimate,
        "ratio": gap / estimate,
        "amplitude": _amplitude(point),
    }


def estimated_gap(system: System, hopf: HopfPoint, clearance: float) -> float:
    """FLC r^2 / l' with r = clearance / (2 |q_y|), m/s; NaN where there is no FLC."""
    x, p = np.array(hopf.state), system.p(**{hopf.parameter: hopf.value})
    pair = critical_pair(system.jacobian(x, p), hopf.frequency)
    radius = clearance / (2 * abs(pair.q[0]))
    growth = eigenvalue_slopes(system, hopf, [hopf.parameter])[hopf.parameter].real
    return np.nan if hopf.lyapunov is None else hopf.lyapunov * radius**2 / growth
