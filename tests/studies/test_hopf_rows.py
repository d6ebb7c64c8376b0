"""Rows made from Hopf points."""

from __future__ import annotations

import pytest

from wheelset.studies import flange_models, hopf_point
from wheelset.studies.hopf_rows import first_hopf, hopf_row


def test_a_window_without_a_hopf_point_says_so():
    assert first_hopf(()) is None
    row = hopf_row(None, (10.0, 20.0))
    assert row["v"] is None
    assert row["words"] == "no Hopf point between 10 and 20 m/s"


def test_loci_are_four_curves_on_the_window():
    p = hopf_point.Parameters(v_min=40, v_max=60, resolution="quick")
    frame = hopf_point.eigenvalue_frame(hopf_point.loci(p))
    assert set(frame["locus"]) == {1, 2, 3, 4}
    assert (frame["v"].min(), frame["v"].max()) == (40, 60)
    assert frame.groupby("v")["re"].max().iloc[[0, -1]].gt(0).tolist() == [False, True]


def test_resolution_changes_the_grid_only():
    quick, paper = (
        flange_models.force_laws(flange_models.Parameters(resolution=r)) for r in ("quick", "paper")
    )
    quick, paper = (frame.round({"y": 9}) for frame in (quick, paper))
    both = paper.merge(quick, on=["law", "y"], suffixes=("", "_quick"))
    assert len(both) > 300
    assert both["force"].to_numpy() == pytest.approx(both["force_quick"].to_numpy(), abs=1e-6)
