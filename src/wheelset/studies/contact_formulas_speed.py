"""What exact contact formulas would do to the speed at which straight running loses stability."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pandas as pd
import sympy as sp

from wheelset.bifurcation.equilibria.hopf import instabilities
from wheelset.bifurcation.system import System
from wheelset.hunting import hunting_system
from wheelset.studies.contact_formulas import Parameters
from wheelset.studies.contact_formulas_bounds import centred_ratio
from wheelset.studies.contact_formulas_exact import BeyondTable
from wheelset.studies.contact_formulas_model import COMPARED, Against, wheel
from wheelset.studies.hopf_rows import first_hopf, hopf_row
from wheelset.vehicle.geometry import SIDES
from wheelset.vehicle.quantities import A, B, on_side

#: The coefficients that are corrected.
CORRECTED = ("f11", "f22", "f23")

#: Half the width, in log(A/B), over which a correction's exponent is taken.
STEP = 1e-3

#: The field's parameters that a correction goes through: f becomes factor (A/B)^exponent f.
_FACTORS = {name: sp.Symbol(f"{name}_correction", real=True) for name in CORRECTED}
_EXPONENTS = {name: sp.Symbol(f"{name}_exponent", real=True) for name in CORRECTED}


def correctable(system: System) -> System:
    """A vehicle's system with the parameters <f>_correction = 1 and <f>_exponent = 0 for each f
    of ``CORRECTED``: its coefficient becomes correction (A/B)^exponent f on both wheels.
    """
    laws = {
        on_side(COMPARED[name], side): _FACTORS[name]
        * (on_side(A, side) / on_side(B, side)) ** _EXPONENTS[name]
        for name in CORRECTED
        for side in SIDES
    }
    field = replace(
        system.field,
        parameters=(*system.field.parameters, *_FACTORS.values(), *_EXPONENTS.values()),
        assignments=tuple((s, e * laws.get(s, 1)) for s, e in system.field.assignments),
    )
    neutral = {
        **{s.name: 1.0 for s in _FACTORS.values()},
        **{s.name: 0.0 for s in _EXPONENTS.values()},
    }
    return replace(system, field=field, values={**system.values, **neutral})


def corrections(p: Parameters, name: str, against: Against, nu: float) -> dict[str, float]:
    """Values of ``correctable``'s parameters that make a vehicle's f11, f22, f23 exact.

    Value and slope over A/B are right at y = 0, which is what linear stability sees where left and
    right wheel are alike. Raises BeyondTable.
    """
    vehicle, centre = p.load(name), np.log(centred_ratio(p, name))
    ratio = np.exp(centre + STEP * np.array([-1, 0, 1]))
    exact, ours = wheel(ratio, vehicle, against, nu), wheel(ratio, vehicle)
    found = {}
    for f in CORRECTED:
        low, here, high = np.log(exact[f] / ours[f])
        exponent = (high - low) / (2 * STEP)
        found[_EXPONENTS[f].name] = float(exponent)
        found[_FACTORS[f].name] = float(np.exp(here - exponent * centre))
    return found


def hopf_speeds(p: Parameters) -> pd.DataFrame:
    """First Hopf speeds in the window with exact formulas in place of the model's.

    Columns: vehicle, against (Hertz, Kalker, both; "" the model as it is), nu (of Kalker's table;
    the study's, and the vehicle's own if another), v m/s, change m/s, words (where there is no
    speed).
    """
    return pd.DataFrame([row for name in p.vehicles for row in _rows(p, name)])


def _rows(p: Parameters, name: str) -> Iterator[dict[str, object]]:
    system, own = correctable(hunting_system(p.load(name))), p.load(name).values["nu"]
    before = _first_speed(system, p.window)
    yield {"vehicle": name, "against": "", "nu": None, "change": None, **before}
    cases: list[tuple[Against, float]] = [("Hertz", p.nu), ("Kalker", p.nu), ("both", p.nu)]
    if own != p.nu:
        cases.append(("both", own))
    for against, nu in cases:
        after = _exact_speed(p, name, system, against, nu)
        known = after["v"] is not None and before["v"] is not None
        change = after["v"] - before["v"] if known else None
        which = {"against": against, "nu": None if against == "Hertz" else nu}
        yield {"vehicle": name, **which, "change": change, **after}


def _exact_speed(
    p: Parameters, name: str, system: System, against: Against, nu: float
) -> dict[str, Any]:
    try:
        exact = system.with_values(**corrections(p, name, against, nu))
    except BeyondTable as outcome:
        return {"v": None, "words": str(outcome)}
    return _first_speed(exact, p.window)


def _first_speed(system: System, window: tuple[float, float]) -> dict[str, Any]:
    row = hopf_row(first_hopf(instabilities(system, "v", window)), window)
    return {"v": row["v"], "words": row["words"] if row["v"] is None else ""}
