"""Table 4: the speeds of simulated worn wheels beside print, other routes and what they were."""

from __future__ import annotations

import pandas as pd
import pytest

from tests.paper.arrays import regress
from tests.paper.judging import judged
from tests.paper.worn import P, contacts, runs, table
from wheelset.bifurcation.equilibria.hopf import instabilities
from wheelset.hunting import hunting_system
from wheelset.profiles.functions import Polynomial
from wheelset.published.items import items_of
from wheelset.published.numbers import TABLE_4, frame
from wheelset.published.rules import verdict
from wheelset.studies import inverse_geometry, worn_speeds
from wheelset.vehicle.geometry import ExpandedGeometry

pytestmark = pytest.mark.slow

COLUMNS = {"hopf_speed": "v_lin", "flc": "flc"}


def value_of(item):
    row = table().set_index("mileage").loc[float(item.item.split(": ")[1].removesuffix("e4 km"))]
    return row[COLUMNS[item.quantity]], row["words"]


@pytest.mark.parametrize(("item", "vehicle"), judged(items_of("Table 4"), lambda _: P.vehicle))
def test_row_is_the_papers(item, vehicle):
    value, words = value_of(item)
    assert not pd.isna(value), words
    assert verdict(item.quantity, item.published, value, item.rounding) != "differs"


def test_every_printed_mileage_is_computed():
    assert table()["mileage"].tolist() == [row.mileage for row in TABLE_4]


def beginning(function):
    """The cubic with which a function's Taylor series at 0 begins."""
    return Polynomial(tuple(function.taylor(0.0, 3).ravel().tolist()))


@pytest.mark.parametrize("mileage", [0.2, 18.5])
def test_the_hopf_speed_is_that_of_the_slope_at_the_centre(mileage):
    """The spline replaced by the polynomial of its own Taylor series: no other point counts."""
    run = runs()[mileage]
    functions = {n: beginning(f) for n, f in run.geometry.functions.items()}
    system = hunting_system(run.vehicle, ExpandedGeometry(functions, run.geometry.reach))
    again = instabilities(system, "v", P.window)[0]
    assert again.value == pytest.approx(run.hopf.value, rel=1e-9)
    assert again.lyapunov == pytest.approx(run.hopf.lyapunov, rel=1e-6)


def test_divided_by_the_frequency_the_printed_coefficients_ask_for_an_a3_like_table_1s():
    """As MATCONT prints it, for one at its neutral value: within 1 percent of section 5's range.

    Like Table 1's: within a factor of two of 499.4.
    """
    p = inverse_geometry.Parameters()
    printed = [(row.mileage, row.hopf_speed, row.flc) for row in TABLE_4]
    wheels = inverse_geometry.inverse_frame(p, p.vehicle, printed)
    section_5 = (-500.0, 5000.0)
    tuned = inverse_geometry.readings_frame(wheels, section_5).set_index("reading")["tuned"]
    matcont, divided, _ = inverse_geometry.READINGS
    assert tuned[matcont] < 0.01
    assert 499.4 / 2 < wheels[divided].abs().max() < 499.4 * 2


def test_the_papers_trends_are_not_those_of_simulated_wheels():
    """Print: highest speed in the middle, three changes of the FLC's sign. Ours: neither."""
    printed = worn_speeds.trends(frame(TABLE_4).rename(columns={"hopf_speed": "v_lin"}))
    ours = worn_speeds.trends(table())
    assert (printed["fastest"], printed["changes"]) == (6.8, 3)
    assert ours["fastest"] == 0.2
    assert ours["changes"] == 0


@pytest.mark.parametrize("law", [P.law, P.law_second])
def test_wear_lowers_the_fold_far_more_than_the_hopf_speed(law):
    hopf = worn_speeds.change(table(law), "v_lin")
    fold = worn_speeds.change(table(law), "v_fold")
    assert fold[0] - fold[1] > 2 * (hopf[0] - hopf[1])
    assert worn_speeds.trends(table(law))["fold_rank"] == -1.0


def test_the_fold_does_not_hang_on_the_averaging_width():
    """Over widths from 0.3 to 1 mm it moves less than a tenth of what wear does to it."""
    last = {18.5: contacts()[18.5]}
    folds = [
        worn_speeds.table_4(worn_speeds.runs(P, last, width))["v_fold"].iloc[0]
        for width in worn_speeds.WIDTHS
    ]
    first, final = worn_speeds.change(table(), "v_fold")
    assert max(folds) - min(folds) < 0.1 * (first - final)


def test_rows_are_as_stored():
    """Folds are located to 1e-7 m/s on a mesh whose error is about 1e-7 of the amplitude."""
    numbers = ["mileage", "v_lin", "flc", "v_fold", "fold_amplitude"]
    regress("table_4", table()[numbers].astype(float), rtol=2e-6)
