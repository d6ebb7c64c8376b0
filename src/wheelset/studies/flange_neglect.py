"""What section 3 may have neglected: its cycles with other nonlinear contact terms kept.

The paper says that "the nonlinear wheel/rail contact parameters" are neglected and does not name
them; what it prints about cycles can tell some of the possibilities apart.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np
import pandas as pd

from wheelset.studies.flange_cycle_artefacts import Cycles, Printed, printed_points, speed_of
from wheelset.studies.flange_cycle_claims import NAMED_AMPLITUDE, largest_amplitude
from wheelset.studies.flange_cycle_tables import curve_frame
from wheelset.studies.flange_cycles import Family, Parameters, case_vehicle, families_of
from wheelset.studies.flange_readings import chosen_again

#: Printed points that are told apart by, besides the largest amplitude without flange force.
ASKED = (
    "case 2, none, LPC", "case 2, exponential, LPC", "case 2, reciprocal, LPC",
    "case 2, reciprocal, PD", "case 1, reciprocal, PD",
)  # fmt: skip

#: Cases and laws that these need.
PLACES = ((1, "none"), (1, "reciprocal"), (2, "none"), (2, "exponential"), (2, "reciprocal"))

#: Terms of the contact angle.
ANGLE = ("c1", "c3")


def other_terms(p: Parameters) -> dict[str, tuple[str, ...]]:
    """Further possibilities: what is kept, and the changes to the cases that keep it."""
    values = p.load(p.vehicle_in_full).values
    return {
        "only e₁ and f₁": ("e3=0", "f3=0"),
        "only e₃ and f₃": ("e1=0", "f1=0"),
        "all, c₁ and c₃ too": tuple(f"{name}={values[name]!r}" for name in ANGLE),
    }


def neglect_frame(
    p: Parameters, items: pd.DataFrame, known: Mapping[str, Iterable[Family]]
) -> pd.DataFrame:
    """The printed points of ``ASKED`` and the largest amplitude by what is kept; "paper" first.

    items: item, quantity, published (of section 3). known: families of both cases by what is kept,
    for readings already computed; the others choose a1 and a3 again and keep the load. Columns:
    kept, one of ``ASKED`` each (m/s, the nearest point of the branches; NaN: none), amplitude m.
    """
    printed = {one.item.removeprefix("Section 3: "): one for one in printed_points(items)}
    asked = {name: printed[name] for name in ASKED}
    paper = {name: one.speed for name, one in asked.items()}
    rows = [{"kept": "paper", **paper, "amplitude": NAMED_AMPLITUDE}]
    for kept, families in known.items():
        rows.append(_row(kept, tuple(families), asked))
    for kept, changes in other_terms(p).items():
        rows.append(_row(kept, _families(p, kept, changes), asked))
    return pd.DataFrame(rows)


def _families(p: Parameters, kept: str, changes: tuple[str, ...]) -> tuple[Family, ...]:
    rows = {case: chosen_again(p, case, changes) for case in p.cases}
    return tuple(
        family
        for case, law in PLACES
        for family in families_of(p, case_vehicle(p, case, law, rows[case]), (kept, case, law))
    )


def _row(
    kept: str, families: tuple[Family, ...], asked: Mapping[str, Printed]
) -> dict[str, object]:
    speeds = {name: _nearest(families, one) for name, one in asked.items()}
    return {"kept": kept, **speeds, "amplitude": largest_amplitude(curve_frame(families))}


def _nearest(families: tuple[Family, ...], one: Printed) -> float:
    """Speed of the point of the same letters nearest to the printed one, m/s; NaN: none."""
    mine = Cycles(tuple(f for f in families if (f.case, f.law) == (one.case, one.law)))
    special = mine.nearest(one.point, one.speed)
    return np.nan if special is None else speed_of(special)
