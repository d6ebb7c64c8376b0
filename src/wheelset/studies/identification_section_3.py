"""Section 3's hidden wheel load: what gives Table 2, the flange counted once or twice.

Source: Guo, Shi, Luo, Zeng, Nonlinear Dynamics 104 (2021) 989-1005, Table 2.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy.optimize import brentq

from wheelset.bifurcation.equilibria.hopf_batch import HopfBatch, hopf_batch
from wheelset.bifurcation.system import System
from wheelset.hunting import hunting_system
from wheelset.studies.identification import Parameters

Array = NDArray[np.float64]

#: Loads that are searched, N, on so many points.
LOADS, POINTS = (2e3, 8e4), {"quick": 20, "paper": 79}

#: How often the flange force may be counted.
WHEELS = (1, 2)


@dataclass(frozen=True)
class Printed:
    """Table 2's numbers that the search needs: speed m/s without flange, the jump of the FLC under
    the quintic law, and the FLC of both cases without flange, 1/s.
    """

    speed: float
    jump: float
    flc: tuple[float, float]

    @classmethod
    def of(cls, printed: pd.DataFrame) -> Printed:
        """From a table with columns item, quantity, published."""
        numbers = printed.set_index(["item", "quantity"])["published"]
        plain = tuple(float(numbers[f"Table 2: case {case}, none", "flc"]) for case in (1, 2))
        jump = float(numbers["Table 2: case 1, polynomial", "flc"]) - plain[0]
        speed = float(numbers["Table 2: case 1, none", "hopf_speed"])
        return cls(speed, jump, (plain[0], plain[1]))


@dataclass(frozen=True, eq=False)
class _Laws:
    """The vehicle of section 3 under the laws that matter, a flange count chosen."""

    plain: System
    quintic: System
    reciprocal: System

    @classmethod
    def of(cls, p: Parameters, wheels: int) -> _Laws:
        def under(law: str) -> System:
            rows = [f"flange_law={law}", f"flange_wheels={wheels}"]
            return hunting_system(p.load(p.vehicle_section_3, rows=rows))

        return cls(under("none"), under("quintic"), under("reciprocal"))


def jumps(p: Parameters, printed: Printed) -> pd.DataFrame:
    """The jump of the FLC under the quintic law over the wheel load, the Hopf speed kept by a1.

    Columns: wheels, p0 N, a1, jump 1/s. Loads without such a Hopf point are left out.
    """
    loads = np.linspace(*LOADS, POINTS[p.resolution])
    frames = []
    for wheels in WHEELS:
        laws = _Laws.of(p, wheels)
        a1, jump = _jump(laws, printed.speed, loads)
        frame = pd.DataFrame({"wheels": wheels, "p0": loads, "a1": a1, "jump": jump})
        frames.append(frame.dropna())
    return pd.concat(frames, ignore_index=True)


def _jump(laws: _Laws, speed: float, loads: Array) -> tuple[Array, Array]:
    """a1 and the jump at some loads; NaN where there is no Hopf point at the speed."""
    plain = _at(laws.plain, speed, loads)
    with_law = _at(laws.quintic, speed, loads)
    return plain.values, with_law.lyapunov - plain.lyapunov


def _at(system: System, speed: float, loads: Array, **values: float) -> HopfBatch:
    """Hopf points at a speed, a1 free, for some loads."""
    rows = np.array([system.p(v=speed, p0=load, **values) for load in loads])
    return hopf_batch(system, "a1", rows)


def readings(p: Parameters, printed: Printed, found: pd.DataFrame) -> pd.DataFrame:
    """Every load at which the jump is the printed one, and what else follows from it.

    Columns: wheels, p0 N, a1, jump; a3_1 and a3_2 (of both cases, 1/m2); under the reciprocal law
    v m/s, flc_1, flc_2.
    """
    rows = []
    for wheels, curve in found.groupby("wheels"):
        laws = _Laws.of(p, int(str(wheels)))
        off = (curve["jump"] - printed.jump).to_numpy()
        loads = curve["p0"].to_numpy()
        for k in np.flatnonzero(off[:-1] * off[1:] < 0):
            apart = partial(_apart, laws, printed)
            load = float(brentq(apart, loads[k], loads[k + 1], xtol=1e-6))
            rows.append({"wheels": wheels, **_reading(laws, printed, load)})
    return pd.DataFrame(rows)


def _apart(laws: _Laws, printed: Printed, load: float) -> float:
    return float(_jump(laws, printed.speed, np.array([load]))[1][0]) - printed.jump


def _reading(laws: _Laws, printed: Printed, load: float) -> dict[str, float]:
    (a1,), (jump,) = _jump(laws, printed.speed, np.array([load]))
    a3 = [_a3(laws.plain, printed.speed, load, flc) for flc in printed.flc]
    system = laws.reciprocal
    rows = np.array([system.p(v=printed.speed, p0=load, a1=a1, a3=one) for one in a3])
    batch = hopf_batch(system, "v", rows)
    return {
        "p0": load, "a1": float(a1), "jump": float(jump), "a3_1": a3[0], "a3_2": a3[1],
        "v": float(batch.values[0]), "flc_1": float(batch.lyapunov[0]),
        "flc_2": float(batch.lyapunov[1]),
    }  # fmt: skip


def _a3(system: System, speed: float, load: float, flc: float) -> float:
    """The a3 with a given FLC, which is affine in it."""
    ends = np.array([-500.0, 500.0])
    low, high = (_at(system, speed, np.array([load]), a3=a3).lyapunov[0] for a3 in ends)
    return float(ends[0] + (flc - low) * (ends[1] - ends[0]) / (high - low))
