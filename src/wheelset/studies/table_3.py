"""Table 3: Hopf point and first fold of cycles for twelve contact geometries.

Source: Guo, Shi, Luo, Zeng, Nonlinear Dynamics 104 (2021) 989-1005, section 5, Table 3.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pandas as pd

from wheelset.bifurcation.equilibria.equilibrium import equilibrium
from wheelset.bifurcation.outcomes import DomainLeft, NumericalOutcome
from wheelset.hunting import hunting_system
from wheelset.studies.first_fold import SECTION_5, FirstFold, first_fold
from wheelset.studies.section_curves import ReadingsParameters

#: The rows of Table 3: coefficient and its values in SI units; the others as in section 5.
TABLE_3_ROWS: tuple[tuple[str, float], ...] = (
    *(("a1", value) for value in (0.05, 0.15, 0.25, 0.35)),
    *(("a3", value) for value in (-500.0, 200.0, 500.0, 5000.0)),
    *(("c1", value) for value in (-200.0, -50.0, 0.0, 200.0)),
)

#: How far the contact formula is tried, m.
FARTHEST = 0.02

#: Displacements from which equilibria beside straight running are sought, m.
_TILTED = tuple(1e-3 * (1 + k / 2) for k in range(20))


def table_3(p: ReadingsParameters, vehicle: str | None = None) -> pd.DataFrame:
    """Table 3 for a vehicle (default: the study's), one row a row of the table.

    Columns: vehicle, parameter, value (SI), v m/s, frequency rad/s, flc; lpc m/s, period s,
    amplitude m, b 1/s (MATCONT's normal form coefficient), slope (dT/ds, without its sign, see
    ``fold_coefficients``); words (how the search for the fold ended). None where there is no fold.
    """
    name = vehicle or p.vehicle
    return pd.DataFrame([_row(p, name, *row) for row in TABLE_3_ROWS])


def row_of_table(
    p: ReadingsParameters, vehicle: str, parameter: str, value: float
) -> tuple[str, FirstFold]:
    """The name of a row and what was found for it."""
    loaded = p.load(vehicle, given=SECTION_5, rows=[f"{parameter}={value}"])
    return f"{parameter}={value:g}", first_fold(loaded, p.window)


def _row(p: ReadingsParameters, vehicle: str, parameter: str, value: float) -> dict[str, object]:
    _, found = row_of_table(p, vehicle, parameter, value)
    place = {"vehicle": vehicle, "parameter": parameter, "value": value}
    return {**place, **_hopf(found), **_fold(found), "words": found.words}


def _hopf(found: FirstFold) -> dict[str, float | None]:
    hopf = found.hopf
    if hopf is None:
        return {"v": None, "frequency": None, "flc": None}
    return {"v": hopf.value, "frequency": hopf.frequency, "flc": hopf.lyapunov}


def _fold(found: FirstFold) -> dict[str, float | None]:
    fold, cycle = found.fold, found.cycle
    if fold is None or cycle is None:
        return dict.fromkeys(("lpc", "period", "amplitude", "b", "slope"))
    return {
        "lpc": float(fold.values[0]),
        "period": cycle.period,
        "amplitude": cycle.measure("max y"),
        "b": fold.coefficients["b"],
        "slope": abs(fold.coefficients["dT/ds"]),
    }


def tilted_equilibria(
    p: ReadingsParameters, vehicle: str, parameter: str, value: float
) -> tuple[float, ...]:
    """Lateral displacements, m, at which the wheelset of a row can rest beside the centre line.

    By Newton's method from many places; they do not depend on the speed.
    """
    system = hunting_system(p.load(vehicle, given=SECTION_5, rows=[f"{parameter}={value}"]))
    found: set[float] = set()
    for y in _TILTED:
        try:
            state, _ = equilibrium(system, system.p(), [y, y, 0.0, 0.0])
        except NumericalOutcome:
            continue  # nothing to rest at is reached from there
        if state[0] > _TILTED[0] / 10:
            found.add(round(float(state[0]), 9))
    return tuple(sorted(found))


def domain_end(
    p: ReadingsParameters, vehicle: str, parameter: str, value: float
) -> tuple[float, str]:
    """The lateral displacement, m, at which a row's contact formula ends, and what ends it.

    To a hundredth of a millimetre, at rest, up to ``FARTHEST``; (infinity, "") beyond that.
    """
    system = hunting_system(p.load(vehicle, given=SECTION_5, rows=[f"{parameter}={value}"]))
    for y in np.arange(0.0, FARTHEST, 1e-5):
        try:
            system.evaluate(np.array([y, 0.0, 0.0, 0.0]), system.p())
        except DomainLeft as outcome:
            return float(y), outcome.quantity
    return np.inf, ""


def normalisations(table: pd.DataFrame, printed: Sequence[float | None]) -> pd.DataFrame:
    """Printed normal form coefficients over ours, in three normalisations of the critical mode.

    printed: one a row of ``table_3``, None where there is none. Columns: normalisation, least,
    greatest (of print / ours over the rows that have both), spread (of its logarithm).
    """
    both = table.assign(printed=pd.Series(printed, index=table.index, dtype=float))
    rows = both.dropna(subset=["b", "printed"]).astype({"b": float, "slope": float})
    period = rows["period"].astype(float)
    ours = {
        "b, mode with S = T (MATCONT's)": rows["b"],
        "b T, the same per period": rows["b"] * period,
        "b |dT/ds| / T, mode of unit size": rows["b"] * rows["slope"] / period,
    }
    return pd.DataFrame([_ratios(name, rows["printed"] / one) for name, one in ours.items()])


def _ratios(name: str, ratio: pd.Series) -> dict[str, object]:
    ends = {"least": float(ratio.min()), "greatest": float(ratio.max())}
    return {"normalisation": name, **ends, "spread": float(np.log(ratio.abs()).std())}
