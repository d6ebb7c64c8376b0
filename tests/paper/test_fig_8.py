"""Fig. 8 and the numbers in section 5's text: fold curves against words, print and other routes."""

from __future__ import annotations

from functools import cache

import pandas as pd
import pytest

from tests.paper.arrays import regress
from tests.paper.judging import judged
from tests.paper.pictures import same_picture
from wheelset.plotting.section_curves import panel_grid, printed_speeds
from wheelset.published.figures import panel
from wheelset.published.items import items_of
from wheelset.published.numbers import GENERALIZED_HOPF
from wheelset.published.rules import verdict
from wheelset.studies import first_fold, lpc_claims, lpc_curves, lpc_rows

pytestmark = pytest.mark.slow

P = lpc_curves.Parameters()
SENTENCES = [i for i in items_of("Section 5") if i.quantity in ("lpc_drop", "lpc_change")]
POINTS = [(row.parameter, row.value) for row in GENERALIZED_HOPF if row.section == 5]
POINT_ITEMS = [i for i in items_of("Section 5") if i.quantity == "gh_value"]


@cache
def scans(vehicle=P.vehicle):
    return lpc_curves.fold_scans(P, vehicle)


@cache
def claims():
    frames = lpc_claims.panel_speeds(P, scans())
    return lpc_claims.figure_8_claims(frames, scans())


def sampled(s):
    low, high = s.scan.window
    return lpc_curves.speeds_at(s, [low + k * (high - low) / 10 for k in range(11)]).assign(
        panel=s.scan.panel
    )


@pytest.mark.parametrize(("item", "vehicle"), judged(items_of("Fig. 8"), lambda _: P.vehicle))
def test_panel_is_as_the_paper_says(item, vehicle):
    sentences = claims()[claims()["item"] == item.item]
    assert len(sentences) > 0
    assert sentences["tolerated"].all()


def test_the_figure_looks_as_it_did(tmp_path):
    curves = lpc_rows.curve_frame(scans())
    same_picture("fig_8", panel_grid(8, curves, printed_speeds(8), (P.vehicle,)), tmp_path)


@pytest.mark.parametrize(("item", "vehicle"), judged(SENTENCES, lambda _: P.vehicle))
def test_number_in_the_text_is_the_papers(item, vehicle):
    value = lpc_claims.numbers(scans())[item.quantity]
    assert verdict(item.quantity, item.published, value, item.rounding) != "differs"


@pytest.mark.parametrize(("item", "vehicle"), judged(POINT_ITEMS, lambda _: P.vehicle))
def test_generalised_hopf_point_is_the_papers(item, vehicle):
    (row,) = lpc_rows.printed_gh(scans(), POINTS).itertuples()
    assert row.words == ""
    assert verdict(item.quantity, item.published, row.value, item.rounding) != "differs"


@pytest.mark.parametrize("scan", lpc_curves.FIGURE_8, ids=lambda scan: scan.panel)
def test_windows_are_the_papers(scan):
    axes = panel(8, scan.panel)
    assert (axes.x.label, axes.x.low, axes.x.high) == (scan.parameter, *scan.window)
    assert lpc_claims.AXIS.get(scan.panel, axes.y.low) == axes.y.low


def test_curves_are_as_stored():
    """Folds are solved to 1e-9 on a mesh whose error is about 1e-7 of the amplitude."""
    regress("fig_8", pd.concat([sampled(s) for s in scans()], ignore_index=True), rtol=1e-6)


@pytest.mark.parametrize("vehicle", P.readings[:2])
def test_curves_from_the_cycles_and_from_gh_agree(vehicle):
    back = lpc_curves.from_gh_frame(scans(vehicle))
    assert set(back["panel"]) == set("bceg")
    assert (back["words"] == "arrived").all()
    assert back["difference"].abs().max() < 1e-7  # both are solved to 1e-9 of 50 m/s


@pytest.mark.parametrize(("name", "value"), [("a1", 0.15), ("c1", -50.0), ("e1", -1500.0)])
def test_a_point_of_the_curve_is_the_first_fold_of_that_vehicle(name, value):
    """The fold located on the cycles born at the row's own Hopf point, another mesh: 1e-5 m/s."""
    curve = next(s for s in scans() if s.scan.parameter == name)
    loaded = P.load(P.vehicle, given=first_fold.SECTION_5, rows=[f"{name}={value}"])
    fold = first_fold.first_fold(loaded, P.window).fold
    assert lpc_curves.fold_at(curve, value).measure("v") == pytest.approx(fold.values[0], abs=1e-5)


def test_the_physical_reading_has_no_fold_and_says_why():
    ends = lpc_rows.end_frame(scans(P.vehicle_physical))
    assert ends["words"].str.startswith("no fold of cycles: they are born stable").all()
