"""Fig. 7: what section 4 says about the Hopf curves, and the curves themselves."""

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
from wheelset.studies import hopf_claims, hopf_curves
from wheelset.studies.hopf_rows import first_hopf, stability_changes

pytestmark = pytest.mark.slow

P = hopf_curves.Parameters()

#: Values of each coefficient at which curves are compared, as parts of the panel's window.
PARTS = tuple(k / 10 for k in range(11))


@cache
def scans():
    return hopf_curves.hopf_scans(P)


@cache
def claims():
    return hopf_claims.figure_7_claims(P, scans())


def sampled(s):
    low, high = s.scan.window
    frame = hopf_curves.speeds_at(s, [low + part * (high - low) for part in PARTS])
    return frame.assign(panel=s.scan.panel)


@pytest.mark.parametrize(("item", "vehicle"), judged(items_of("Fig. 7"), lambda _: P.vehicle))
def test_panel_is_as_the_paper_says(item, vehicle):
    sentences = claims()[claims()["item"] == item.item]
    assert len(sentences) > 0
    assert sentences["tolerated"].all()


@pytest.mark.parametrize("scan", hopf_curves.FIGURE_7, ids=lambda scan: scan.panel)
def test_windows_are_the_papers(scan):
    axis = panel(7, scan.panel).x
    assert (axis.label, axis.low, axis.high) == (scan.parameter, *scan.window)


def test_the_figure_looks_as_it_did(tmp_path):
    curves = hopf_curves.curve_frame(scans())
    same_picture("fig_7", panel_grid(7, curves, printed_speeds(7), (P.vehicle,)), tmp_path)


def test_curves_are_as_stored():
    regress("fig_7", pd.concat([sampled(s) for s in scans()], ignore_index=True))


@pytest.mark.parametrize(("name", "value"), [("a1", 0.6), ("c1", -900.0), ("f1", 700.0)])
def test_a_point_of_the_curve_is_the_hopf_point_of_that_vehicle(name, value):
    """By the zeros of the product of eigenvalue sums; both routes solve to 1e-9."""
    curve = next(s for s in scans() if s.scan.parameter == name)
    row = hopf_curves.speeds_at(curve, [value]).iloc[0]
    vehicle = P.load(P.vehicle, rows=[f"{name}={value}"])
    hopf = first_hopf(stability_changes(vehicle, P.window))
    assert row["v"] == pytest.approx(hopf.value, rel=1e-8)
    assert row["flc"] == pytest.approx(hopf.lyapunov, rel=1e-6)


def test_wheel_and_rail_curvature_act_through_their_sum():
    """e1 and f1 enter as e1 + f1 only, so that their GH points differ by the other's default."""
    found = hopf_curves.gh_frame(scans()).set_index("parameter")["value"]
    values = scans()[0].system.values
    assert found["e1"] + values["f1"] == pytest.approx(found["f1"] + values["e1"], rel=1e-9)
