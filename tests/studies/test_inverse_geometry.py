"""The inverse of Table 4: forward again, linear in a3, and honest where there is no answer."""

from __future__ import annotations

import numpy as np
import pytest

from wheelset.hunting import hunting_system
from wheelset.studies import inverse_freedom, inverse_geometry
from wheelset.studies.hopf_rows import first_hopf, stability_changes

P = inverse_geometry.Parameters()
MATCONT, OVER_FREQUENCY, MILLIMETRES = inverse_geometry.READINGS
PRINTED = [(0.2, 65.91, -0.81), (9.4, 62.55, 0.73)]


@pytest.fixture(scope="module")
def table():
    return inverse_geometry.inverse_frame(P, P.vehicle, PRINTED)


@pytest.mark.parametrize("reading", [MATCONT, OVER_FREQUENCY])
def test_the_geometry_found_has_the_printed_numbers(table, reading):
    """The speed is a root to 1e-9, the coefficient linear in a3 but for rounding."""
    forward = inverse_geometry.forward_frame(P, P.vehicle, table, reading)
    assert forward["v"].tolist() == pytest.approx([v for _, v, _ in PRINTED], rel=1e-8)
    assert forward["flc"].tolist() == pytest.approx([flc for *_, flc in PRINTED], rel=1e-7)


def test_a_vehicles_own_numbers_give_its_own_geometry():
    hopf = first_hopf(stability_changes(P.load(P.vehicle), (10.0, 200.0)))
    own = P.load(P.vehicle).values
    row = inverse_geometry.inverse_frame(P, P.vehicle, [(0.0, hopf.value, hopf.lyapunov)]).iloc[0]
    assert row["a1"] == pytest.approx(own["a1"], rel=1e-8)
    assert row[MATCONT] == pytest.approx(own["a3"], rel=1e-6)


def test_a_coefficient_of_nought_is_neutral_in_every_reading():
    found = inverse_geometry.inverse(hunting_system(P.load(P.vehicle)), 60.0)
    assert {found.a3(0.0, reading) for reading in inverse_geometry.READINGS} == {found.neutral}


def test_a_speed_without_geometry_has_gaps():
    """At 2 m/s even a cone of one half is stable."""
    row = inverse_geometry.inverse_frame(P, P.vehicle, [(0.0, 2.0, 1.0)]).iloc[0]
    assert np.isnan(row["a1"])
    assert np.isnan(row[MATCONT])


def test_readings_compare_with_the_range_of_section_5(table):
    readings = inverse_geometry.readings_frame(table, (-500.0, 5000.0)).set_index("reading")
    assert readings.loc[MATCONT, "tuned"] < readings.loc[OVER_FREQUENCY, "tuned"]
    assert readings.loc[MILLIMETRES, "inside"] == 0.0


def test_freedom_leaves_the_printed_numbers_as_they_are(table):
    free = inverse_freedom.freedom_frame(P, P.vehicle, PRINTED[:1], MATCONT)
    row = free[(free["parameter"] == "c1") & (free["value"] == 200.0)].iloc[0]
    moved = P.load(P.vehicle, rows=["c1=200", f"a1={row['a1']:.17g}", f"a3={row['a3']:.17g}"])
    hopf = first_hopf(stability_changes(moved, (30.0, 100.0)))
    assert hopf.value == pytest.approx(PRINTED[0][1], rel=1e-8)
    assert hopf.lyapunov == pytest.approx(PRINTED[0][2], rel=1e-6)
    assert set(inverse_freedom.moved_frame(free)["parameter"]) == set(inverse_freedom.FREEDOM)


def test_stiffness_needed_falls_where_the_speed_rises():
    rows = [(0.0, 60.0, 0.0), (1.0, 70.0, 0.0), (2.0, 75.0, 0.0)]
    table = inverse_geometry.inverse_frame(P, P.vehicle, rows)
    needed = inverse_geometry.stiffness_frame(P, P.vehicle, table, MATCONT)
    assert needed["longitudinal"].iloc[1] == pytest.approx(
        1e6, rel=1e-6
    )  # its speed is kept as it is
    assert (np.diff(needed["alike"]) < 0).all()
