"""What section 3 says about Figs 4 and 5 in words, each sentence measured.

The paper prints no numbers for these figures, so its sentences are what a computation can be held
to. ``item`` is the panel's name: figure, then panel.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pandas as pd

from wheelset.studies.flange_models import Parameters
from wheelset.vehicle.flange import FLANGE_LAWS, flange_force

Law = Callable[[np.ndarray], np.ndarray]

#: The displacement up to which section 3 compares the laws, m.
COMPARED_TO = 0.011

#: Curves this near to each other are coincident to the eye, and coincident at a loose reading, N:
#: a twentieth and a tenth of the panel's 100 kN.
COINCIDENT, LOOSELY_COINCIDENT = 5e3, 1e4

#: What "about 10 mm" and "its equilibrium at 0" are taken to mean for an amplitude, m.
ABOUT_10_MM = (0.009, 0.011)
AT_REST = (0.0, 1e-4)

_COLUMNS = ("item", "claim", "measured", "unit", "low", "high", "loose")


def figure_4_claims(p: Parameters) -> pd.DataFrame:
    """Fig. 4's panels: item, claim, measured, unit, low, high, loose, holds, tolerated.

    A claim holds if low <= measured <= high, and is tolerated up to ``loose``.
    """
    piecewise, quintic, exponential, reciprocal = (
        _law(p, name) for name in ("piecewise_linear", "quintic", "exponential", "reciprocal")
    )
    y = np.linspace(0.0, COMPARED_TO, 2201)
    clearance = p.load(p.vehicle_case_1).values["eta"]
    inside, end = y[y < clearance], np.array([COMPARED_TO])
    apart = float(np.abs(exponential(y) - piecewise(y)).max())
    steeper = float((exponential(1.1 * end) / piecewise(1.1 * end))[0])
    weaker = float((reciprocal(end) / piecewise(end))[0])
    rows = [
        ("Fig. 4: piecewise linear", "no force inside the clearance",
         float(np.abs(piecewise(inside)).max()), "N", 0.0, 0.0),
        ("Fig. 4: polynomial", "pushes outward up to 9-11 mm",
         float(y[quintic(y) > 0].max()), "m", 0.009, 0.011),
        ("Fig. 4: exponential", "coincides with the piecewise linear law up to 11 mm",
         apart, "N", 0.0, COINCIDENT, LOOSELY_COINCIDENT),
        ("Fig. 4: exponential", "far steeper beyond: ratio to the piecewise linear law at 12.1 mm",
         steeper, "1", 2.0, np.inf),
        ("Fig. 4: reciprocal", "much smaller at 11 mm: ratio to the piecewise linear law",
         weaker, "1", 0.0, 0.5),
    ]  # fmt: skip
    return _judged(rows)


def _law(p: Parameters, name: str) -> Law:
    law, values = FLANGE_LAWS[name], p.load(p.vehicle_case_1).values
    return lambda y: flange_force(law, y, values)


def figure_5_claims(outcomes: pd.DataFrame) -> pd.DataFrame:
    """Fig. 5's panels, from the outcomes of its motions; columns as ``figure_4_claims``."""
    return _judged([_motion_claim(row) for row in outcomes.itertuples()])


def _motion_claim(row: Any) -> tuple[object, ...]:
    hunting = row.law == "quintic"
    flange = "polynomial" if hunting else str(row.law)
    claim = "hunts with about 10 mm" if hunting else "returns to its equilibrium at 0"
    low, high = ABOUT_10_MM if hunting else AT_REST
    return f"Fig. 5: case {row.case}, {flange}", claim, row.amplitude, "m", low, high


def _judged(rows: Sequence[tuple[object, ...]]) -> pd.DataFrame:
    complete = [row if len(row) == len(_COLUMNS) else (*row, row[-1]) for row in rows]
    claims = pd.DataFrame(complete, columns=list(_COLUMNS))
    claims["holds"] = claims["measured"].between(claims["low"], claims["high"])
    claims["tolerated"] = claims["measured"].between(claims["low"], claims["loose"])
    return claims
