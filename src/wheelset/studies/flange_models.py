"""Section 3: what four ways to write the flange force do to the hunting motion.

Source: Guo, Shi, Luo, Zeng, Nonlinear Dynamics 104 (2021) 989-1005, Eqs. (24)-(27), Figs 4 and 5,
Table 2. The paper prints only that the nonlinear contact parameters are neglected; the two packaged
cases say what was inferred.
"""

from __future__ import annotations

import numpy as np
import pandas as pd
import sympy as sp
from pydantic import Field

from wheelset.studies.hopf_rows import first_hopf, hopf_row, stability_changes
from wheelset.studies.parameters import CaseParameters, Speed
from wheelset.vehicle import Vehicle
from wheelset.vehicle.flange import FLANGE_LAWS, FlangeLaw, flange_force
from wheelset.vehicle.symbols import p as symbol
from wheelset.vehicle.symbols import y as lateral

#: The laws of Fig. 4 and those of Table 2, in the paper's order.
FIGURE_4_LAWS = ("piecewise_linear", "quintic", "exponential", "reciprocal")
TABLE_2_LAWS = ("none", "quintic", "exponential", "reciprocal")

#: Half the width of Fig. 4's abscissa, m.
FIGURE_4_REACH = 0.015

_POINTS = {"quick": 121, "paper": 601}


class Parameters(CaseParameters):
    """Parameters of the study of section 3."""

    speed: Speed = Field(
        default=40.0, description="Speed of the simulated motions of Fig. 5, m/s; 0 to 1000."
    )
    initial_displacement: float = Field(
        default=0.010,
        ge=-0.05,
        le=0.05,
        description="Lateral displacement y at the start, m; -0.05 to 0.05.",
    )
    duration: float = Field(
        default=5.0, gt=0.0, le=600.0, description="Simulated time, s; up to 600."
    )


def force_laws(p: Parameters) -> pd.DataFrame:
    """Fig. 4: force of the four laws, counted once, with case 1's coefficients.

    Columns: law, title, y m, force N. A law appears only inside its domain: the reciprocal one
    between its poles.
    """
    vehicle = p.load(p.vehicle_case_1)
    displacement = np.linspace(-FIGURE_4_REACH, FIGURE_4_REACH, _POINTS[p.resolution])
    return pd.concat(
        [_law_frame(FLANGE_LAWS[name], vehicle, displacement) for name in FIGURE_4_LAWS],
        ignore_index=True,
    )


def _law_frame(law: FlangeLaw, vehicle: Vehicle, displacement: np.ndarray) -> pd.DataFrame:
    values = {name: vehicle.values[name] for name in law.parameters}
    inside = displacement[_inside(law, values, displacement)]
    force = flange_force(law, inside, values)
    return pd.DataFrame({"law": law.name, "title": law.title, "y": inside, "force": force})


def _inside(law: FlangeLaw, values: dict[str, float], displacement: np.ndarray) -> np.ndarray:
    """Which displacements [m] lie in the domain of a law."""
    inside = np.ones(displacement.shape, dtype=bool)
    for bound in law.bounds:
        margin = sp.lambdify(lateral, bound.expression.subs(_by_symbol(values)))
        inside &= margin(displacement) > 1e-12
    return inside


def _by_symbol(values: dict[str, float]) -> dict[sp.Symbol, float]:
    return {getattr(symbol, name): value for name, value in values.items()}


def domains(p: Parameters) -> pd.DataFrame:
    """Both ends of every law's domain: law, low m, high m (infinite where there is no pole)."""
    values = _by_symbol(dict(p.load(p.vehicle_case_1).values))
    rows = []
    for name in FIGURE_4_LAWS:
        ends = [sp.solve(b.expression.subs(values), lateral) for b in FLANGE_LAWS[name].bounds]
        poles = sorted(float(end) for solutions in ends for end in solutions)
        low, high = (poles[0], poles[-1]) if poles else (-np.inf, np.inf)
        rows.append({"law": name, "low": low, "high": high})
    return pd.DataFrame(rows)


def hopf_table(p: Parameters) -> pd.DataFrame:
    """Table 2: Hopf point by case and flange law, with the vehicles' own flange_wheels.

    Columns: case, law, v m/s, frequency rad/s, flc (MATCONT's normalisation), kind, words.
    """
    rows = [(case, vehicle, law) for case, vehicle in p.cases.items() for law in TABLE_2_LAWS]
    return pd.DataFrame([_table_2_row(p, *row) for row in rows])


def _table_2_row(p: Parameters, case: int, vehicle: str, law: str) -> dict[str, object]:
    loaded = p.load(vehicle, rows=[f"flange_law={law}"])
    changes = stability_changes(loaded, p.window)
    return {"case": case, "law": law, **hopf_row(first_hopf(changes), p.window)}
