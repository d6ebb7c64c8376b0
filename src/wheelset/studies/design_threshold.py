"""How large a disturbance triggers hunting between the two critical speeds.

The unstable cycle lies on the boundary between what dies out and what ends in hunting. Two
disturbances are sought on that boundary by bisection: the wheelset let go at rest off the centre,
and the wheelset in the centre with a sideways velocity.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from wheelset.bifurcation.curves.branch import Branch
from wheelset.bifurcation.integration.endings import ReachedEnd
from wheelset.bifurcation.integration.integrate import integrate
from wheelset.bifurcation.system import System
from wheelset.studies.design import Parameters, Reading

Array = NDArray[np.float64]

#: Parts of the way from v_non to v_lin at which the disturbances are sought.
PARTS = {"quick": (0.3, 0.7), "paper": (0.05, 0.15, 0.3, 0.5, 0.7, 0.85, 0.95)}

#: Sideways velocities are tried up to this multiple of the stable cycle's greatest.
KICK = 3.0

#: A bracket is narrow enough at this relative width.
NARROW = 2e-3

#: After the first of these times, s, all but the hunting motion has died out (the other modes decay
#: within tenths of a second); between them the amplitude is compared with the unstable cycle's.
SETTLED, SEEN = 1.0, 1.5

#: Relative tolerance of the integration.
ACCURACY = 1e-7


def family(reading: Reading) -> pd.DataFrame:
    """The cycles from the Hopf point on: v m/s, y m (greatest), unstable, point."""
    return reading.branch.table(["max y"]).rename(columns={"max y": "y"})


def thresholds(p: Parameters, reading: Reading) -> pd.DataFrame:
    """The smallest disturbances that trigger hunting, between the two critical speeds.

    Columns: v m/s, unstable and stable: greatest y of the two cycles, m; y0: displacement at rest,
    m, up to the stable cycle's greatest; yd0: sideways velocity in the centre, m/s, up to three
    times the stable cycle's. They are missing where even the greatest dies out.
    """
    low, high = float(reading.fold.values[0]), reading.hopf.value
    lower, upper = _parts(reading.branch)
    speeds = [low + part * (high - low) for part in PARTS[p.resolution]]
    return pd.DataFrame([_row(reading.found.system, v, lower, upper) for v in speeds])


def _row(system: System, v: float, lower: pd.DataFrame, upper: pd.DataFrame) -> dict[str, float]:
    at = system.with_values(v=float(v))
    unstable, stable, fastest = _at(lower, v, "y"), _at(upper, v, "y"), _at(upper, v, "yd")

    def let_go(y0: float) -> bool:
        return hunts(at, [y0, 0.0, 0.0, 0.0], unstable)

    def kicked(yd0: float) -> bool:
        return hunts(at, [0.0, 0.0, yd0, 0.0], unstable)

    return {
        "v": v, "unstable": unstable, "stable": stable,
        "y0": boundary(let_go, stable), "yd0": boundary(kicked, KICK * fastest),
    }  # fmt: skip


def _parts(branch: Branch) -> tuple[pd.DataFrame, pd.DataFrame]:
    """The family before and after its first fold, each in order of speed."""
    table = branch.table(["max y", "max yd"]).set_axis(
        ["v", "y", "yd", "unstable", "point"], axis=1
    )
    turn = int(table.index[table["point"] == "LPC"][0])
    after = table.loc[turn:]
    back = np.flatnonzero(np.diff(after["v"]) < 0)
    return table.loc[:turn].iloc[::-1], after.iloc[: back[0] + 1] if len(back) else after


def _at(part: pd.DataFrame, v: float, measure: str) -> float:
    return float(np.interp(v, part["v"], part[measure], left=np.nan, right=np.nan))


def boundary(hunting: Callable[[float], bool], most: float) -> float:
    """The size of a disturbance between dying out and hunting; NaN where ``most`` dies out."""
    low, high = 0.0, most
    if not hunting(high):
        return np.nan
    while high - low > NARROW * high:
        middle = (low + high) / 2
        low, high = (low, middle) if hunting(middle) else (middle, high)
    return (low + high) / 2


def hunts(system: System, start: list[float], unstable: float) -> bool:
    """Whether a motion is larger than the unstable cycle, of greatest y ``unstable`` [m], once the
    strongly damped modes have died out; leaving the contact formulas counts as hunting.
    """
    motion = integrate(system, start, SEEN, rtol=ACCURACY)
    if not isinstance(motion.outcome, ReachedEnd):
        return True
    late = motion(np.linspace(SETTLED, SEEN, 200))[:, 0]
    return float(np.abs(late).max()) > unstable
