"""What the printed numbers say about their own origin, with a vehicle's equations at hand.

Source of the numbers: Guo, Shi, Luo, Zeng, Nonlinear Dynamics 104 (2021) 989-1005, sections 4, 5.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from wheelset.bifurcation.equilibria.hopf_batch import HopfBatch, hopf_batch
from wheelset.bifurcation.system import System
from wheelset.hunting import hunting_system
from wheelset.studies.identification import Parameters
from wheelset.studies.identification_data import SECTION_4, TABLE_3, changes_of
from wheelset.studies.identification_fit import fit, starts
from wheelset.studies.identification_problem import problem
from wheelset.studies.identification_variants import REVERSED, Variant, variant

Array = NDArray[np.float64]

#: Table 1's a3, 1/m2, its linear curvature terms of wheel and rail, 1/m2, the ratio of the cubic
#: ones to them, 1/m2, and section 4's default speed, m/s.
DEFAULT_A3, E1, F1, DEFAULT_SPEED = -499.40, 9.14, 381.83, 51.70
CURVATURE_RATIO = (6616287.34 - 125311.23) / (F1 + E1)

#: Where the slope of the FLC in a3 is taken, 1/m2, and the step of a derivative by c1, 1/m.
A3_ENDS, SMALL_STEP = (-500.0, 200.0), 1e-2

#: The structures whose radius offset is looked at.
BOTH_SIGNS = {"reversed": variant(REVERSED), "physical": variant()}


def affine_in_a3(data: pd.DataFrame) -> pd.DataFrame:
    """The FLC as slope (a3 - zero), from Table 3's a3 rows and from section 4's two points.

    Columns: source, slope, zero (1/m2), worst (departure from the straight line, 1/s).
    """
    flc = data[(data["quantity"] == "flc") & (data["group"] == TABLE_3)]
    flc = flc[flc["parameter"] == "a3"]
    a3 = np.array([changes_of(text)["a3"] for text in flc["changes"]])
    slope, at_zero = np.polyfit(a3, flc["printed"], 1)
    worst = np.abs(slope * a3 + at_zero - flc["printed"]).max()
    zero_4, default, flc_4 = _section_4(data)
    rows = [
        ("Table 3", slope, -at_zero / slope, worst),
        ("section 4", flc_4 / (default - zero_4), zero_4, 0.0),
    ]
    return pd.DataFrame(rows, columns=["source", "slope", "zero", "worst"])


def _section_4(data: pd.DataFrame) -> tuple[float, float, float]:
    """Section 4's zero in a3, its default a3, and the FLC there."""
    part = data[data["group"] == SECTION_4]
    zero = part[(part["quantity"] == "gh_value") & (part["parameter"] == "a3")]["printed"].iloc[0]
    return float(zero), DEFAULT_A3, float(part[part["quantity"] == "flc"]["printed"].iloc[0])


def offset_evidence(p: Parameters, data: pd.DataFrame) -> pd.DataFrame:
    """Fits to Table 3's a1 and a3 rows alone, with and without the radius offset, for both signs.

    Columns: signs, offset, cost, worst (in tolerances), slope and zero of the FLC in a3; moved (by
    how much the offset alone moves that zero); lowered (by how much the offset's yaw moment lowers
    the effective a1: the a1 that keeps the speed, less the one without offset) and expected
    (lowered (e3 + f3)/(e1 + f1), the change of a3 that the same moment makes).
    """
    rows = data[(data["group"] == TABLE_3) & (data["parameter"] != "c1")].reset_index(drop=True)
    signs = {"quick": 1, "paper": 2}[p.resolution]
    return pd.DataFrame(
        [
            {"signs": sign, **_with_and_without(p, one, rows, held)}
            for sign, one in list(BOTH_SIGNS.items())[:signs]
            for held in (True, False)
        ]
    )


def _with_and_without(
    p: Parameters, one: Variant, rows: pd.DataFrame, held: bool
) -> dict[str, float]:
    free = problem(p, p.vehicle, one, rows)
    of = free.holding("radius_offset", 0.0) if held else free
    best = fit(of, starts(of, {"quick": 1, "paper": 2}[p.resolution]))
    values = {"radius_offset": 0.0, **best.values}
    del values["a1"]
    a1, slope, zero = _at_speed(of.system, DEFAULT_SPEED, values)
    without, _, zero_without = _at_speed(of.system, DEFAULT_SPEED, {**values, "radius_offset": 0.0})
    worst = float(np.abs(of.residuals(best.at)).max())
    return {
        "offset": values["radius_offset"], "cost": best.cost, "worst": worst, "slope": slope,
        "zero": zero, "moved": zero - zero_without, "lowered": a1 - without,
        "expected": (a1 - without) * CURVATURE_RATIO,
    }  # fmt: skip


def _at_speed(
    system: System, speed: float, values: Mapping[str, float]
) -> tuple[float, float, float]:
    """The a1 with a system's Hopf point at a speed, and slope and zero of its FLC in a3 there."""
    rows = np.array([system.p(**{**values, "v": speed, "a3": a3}) for a3 in A3_ENDS])
    batch = _all_found(hopf_batch(system, "a1", rows))
    (low, high), (first, last) = A3_ENDS, batch.lyapunov
    slope = (last - first) / (high - low)
    return float(batch.values[0]), float(slope), float(low - first / slope)


def _all_found(batch: HopfBatch) -> HopfBatch:
    """A batch; raises the outcome of the first row without a Hopf point."""
    for outcome in batch.outcomes:
        if outcome is not None:
            raise outcome
    return batch


def curvature_zeros(data: pd.DataFrame) -> pd.DataFrame:
    """Section 4's three zeros of the FLC over S = e1 + f1, read as one parabola.

    a3 + alpha S + beta S^2 = const, the zeros lying at (102.47, 390.97), (-499.40, -1770.51) and
    (-499.40, 21404.99). Columns: reading, alpha, beta, const, worst (what is left over, 1/m2).
    """
    zeros = data[data["quantity"] == "gh_value"]
    S = np.array([F1 + E1, *(F1 + zeros[zeros["parameter"] == "e1"]["printed"])])
    a3 = np.array([zeros[zeros["parameter"] == "a3"]["printed"].iloc[0], DEFAULT_A3, DEFAULT_A3])
    full = np.column_stack([-S, -(S**2), np.ones(3)])
    rows = []
    for reading, columns in (("a constant", 3), ("no constant", 2)):
        found = np.linalg.lstsq(full[:, :columns], a3, rcond=None)[0]
        left = float(np.abs(full[:, :columns] @ found - a3).max())
        rows.append((reading, *found, *([0.0] * (3 - columns)), left))
    return pd.DataFrame(rows, columns=["reading", "alpha", "beta", "const", "worst"])


def curvature_effect(system: System) -> dict[str, float]:
    """How a system's zero of the FLC in a3 moves with S = e1 + f1: alpha and beta of
    a3 + alpha S + beta S^2 = const through its own values at S = 0, 391 and 782.
    """
    S = np.array([0.0, 1.0, 2.0]) * (E1 + F1)
    zeros = []
    for value in S:
        rows = np.array(
            [system.p(v=51.7, a3=end, e1=value - system.values["f1"]) for end in A3_ENDS]
        )
        (first, last), (low, high) = _all_found(hopf_batch(system, "v", rows)).lyapunov, A3_ENDS
        zeros.append(low - first * (high - low) / (last - first))
    beta, alpha, const = np.polyfit(S, -np.array(zeros), 2)
    return {"alpha": float(alpha), "beta": float(beta), "const": float(-const)}


def angle_effect(p: Parameters, vehicle: str) -> dict[str, float]:
    """What the slope c1 of the contact angle does to a vehicle's Hopf speed.

    v m/s; effect dv/dc1 in m/s for a c1 of 1 1/m; without_spin: the same without f23, which leaves
    gravity; without_gravity: what is left.
    """
    system = hunting_system(p.load(vehicle))
    speed, effect = _along_c1(system)
    _, gravity = _along_c1(system.with_values(f23_factor=0.0))
    return {
        "v": speed, "effect": effect, "without_spin": gravity, "without_gravity": effect - gravity,
    }  # fmt: skip


def _along_c1(system: System) -> tuple[float, float]:
    """Hopf speed, and its derivative by c1 from central differences."""
    c1 = system.values["c1"]
    rows = np.array([system.p(v=52.0, c1=c1 + step) for step in (-SMALL_STEP, 0.0, SMALL_STEP)])
    batch = _all_found(hopf_batch(system, "v", rows))
    low, speed, high = batch.values
    return float(speed), float((high - low) / (2 * SMALL_STEP))
