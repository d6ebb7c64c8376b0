"""Curves of constant critical speed in the suspension's stiffness, on the polynomial model."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest

from wheelset.bifurcation.equilibria.hopf import HopfPoint, instabilities
from wheelset.hunting import hunting_system
from wheelset.studies import stiffness_curves, stiffness_tables
from wheelset.studies.first_fold import SECTION_5, first_fold
from wheelset.vehicle import load_vehicle

VEHICLE = load_vehicle("guo2021", SECTION_5)


def own_speed():
    system = hunting_system(VEHICLE)
    return next(
        q for q in instabilities(system, "v", (10.0, 200.0)) if isinstance(q, HopfPoint)
    ).value


@pytest.fixture(scope="module")
def curves():
    """At the vehicle's own Hopf speed, so that Table 1's suspension lies on the Hopf curve."""
    p = stiffness_curves.Parameters(speed=own_speed(), resolution="quick")
    return stiffness_curves.curves_of(p, VEHICLE, 0.0, None, largest=np.inf)


def test_the_curve_passes_the_suspension_whose_speed_it_keeps(curves):
    """Table 1's suspension is the point from which the curve starts: exact but for rounding."""
    needed = stiffness_tables.required(curves.hopf)
    assert needed["longitudinal"] == pytest.approx(1e6, rel=1e-9)
    assert needed["alike"] == pytest.approx(1e6, rel=1e-9)


def test_at_other_points_the_speed_is_the_same(curves):
    for point in curves.hopf.points[1::5]:
        at = curves.system.with_values(Kpx=point.values[0], Kpy=point.values[1])
        speeds = [q.value for q in instabilities(at, "v", (10.0, 200.0))]
        assert min(abs(v - own_speed()) for v in speeds) < 1e-7


def test_the_fold_curve_has_its_fold_at_the_speed(curves):
    """The nonlinear critical speed at a point of the curve, found on its own cycles: 1e-4 m/s."""
    kpx, kpy = curves.folds.points[len(curves.folds) // 2].values
    there = VEHICLE.with_overrides([f"Kpx={kpx:.17g}", f"Kpy={kpy:.17g}"])
    fold = first_fold(there, (10.0, 200.0)).fold
    assert float(fold.values[0]) == pytest.approx(own_speed(), abs=1e-4)


def test_where_no_stiffness_has_the_speed_words_say_so():
    """Without conicity the wheelset never hunts: any suspension is stable at any speed."""
    p = stiffness_curves.Parameters(speed=5.0)
    cylinder = VEHICLE.with_overrides(["a1=1e-6", "a3=0", "c1=0", "e1=0", "f1=0"])
    none = stiffness_curves.curves_of(p, cylinder, 0.0, None)
    assert (none.hopf, none.folds) == (None, None)
    assert "straight running is" in none.words
    assert stiffness_tables.required(none.hopf) == {"alike": None, "longitudinal": None}


def test_the_spread_is_greatest_over_least():
    assert stiffness_tables.spread(pd.Series([1.0, 1.25, np.nan, 1.1])) == pytest.approx(25.0)
    assert stiffness_tables.spread(pd.Series([1.0, np.nan])) is None


def test_tables_hold_both_curves(curves):
    frame = stiffness_tables.curve_frame([curves])
    assert set(frame["curve"]) == {"Hopf", "LPC"}
    table = stiffness_tables.required_frame([curves])
    claims = stiffness_tables.figure_11_claims(frame, table)
    assert claims["measured"].isna().tolist() == [True, False, False]  # no spread of one wheel
    assert claims["holds"][1]  # on the panel
    assert claims["measured"][2] > 0.8  # but for a stretch at small Kpx
