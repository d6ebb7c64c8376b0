"""Hopf curves of section 4: matching of points, and what a reader's change does."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest

from wheelset.bifurcation.equilibria.hopf import hopf_point
from wheelset.hunting import hunting_system
from wheelset.studies import hopf_curves, section_rows
from wheelset.studies.hopf_rows import first_hopf, stability_changes
from wheelset.studies.section_curves import Scan, hopf_at, hopf_branch


def curve(p, parameter, window):
    loaded = p.load(p.vehicle)
    hopf = first_hopf(stability_changes(loaded, p.window))
    return hunting_system(loaded), hopf_branch(
        hunting_system(loaded), hopf, parameter, window, p.control
    )


def test_points_are_matched_once_by_sign_and_size():
    assert section_rows.matched([9.0, 40.0], [11.0, 38.0]) == {11.0: 9.0, 38.0: 40.0}
    assert section_rows.matched([30.0], [11.0, 38.0]) == {11.0: None, 38.0: 30.0}
    assert section_rows.matched([-10.0, 100.0], [10.0]) == {10.0: None}
    assert section_rows.matched([], [1.0]) == {1.0: None}


def test_a_wanted_point_that_was_not_found_says_how_far_was_searched():
    points = pd.DataFrame({"parameter": ["c1"], "value": [150.0], "v": [51.0], "slc": [9.0]})
    found = section_rows.gh_for(points, [("c1", 160.0), ("e1", 5.0)], {"e1": "searched to 8"})
    here, gone = found.itertuples()
    assert (here.value, here.slc, here.words) == (150.0, 9.0, "")
    assert np.isnan(gone.value)
    assert gone.words == "No GH of this sign and size for e1: searched to 8"


def test_a_claim_is_judged_by_its_bounds():
    rows = [("f", "c", 0.5, "1", 0.0, 1.0), ("f", "c", 1.5, "1", 0.0, 1.0, 2.0),
            ("f", "c", None, "1", 0.0, 1.0)]  # fmt: skip
    claims = section_rows.claim_frame(rows)
    assert claims["holds"].tolist() == [True, False, False]
    assert claims["tolerated"].tolist() == [True, True, False]


def test_a_window_has_room_for_a_start_outside():
    scan = Scan("f", "e3", (-1.0, 1.0), (-3.0, 3.0))
    assert scan.around(0.0, searched=False) == (-1.0, 1.0)
    low, high = scan.around(-5.0)
    assert low < -5.0
    assert high == 3.0
    assert not scan.shows(-5.0)


def test_a_readers_change_moves_the_curve_and_no_value_lies_beyond_its_ends():
    window = (10.0, 20.0)
    speeds = []
    for changes in ("", "a1=0.25"):
        p = hopf_curves.Parameters(changes=changes, resolution="quick")
        system, branch = curve(p, "c1", window)
        assert hopf_at(system, branch, 25.0) is None
        hopf = hopf_at(system, branch, 12.0)
        direct = hopf_point(system.with_values(c1=12.0), "v", hopf.value + 1.0)
        assert hopf.value == pytest.approx(direct.value, rel=1e-9)
        speeds.append(hopf.value)
    assert speeds[1] < speeds[0]


def test_the_parts_change_at_the_generalised_hopf_point():
    _, branch = curve(hopf_curves.Parameters(resolution="quick"), "a3", (-1e3, 1e3))
    frame = section_rows.hopf_frame(branch)
    assert frame["value"].is_monotonic_increasing or frame["value"].is_monotonic_decreasing
    parts = frame["part"].tolist()
    (gh,) = [k for k, part in enumerate(parts) if part == "GH"]
    sides = {*parts[:gh]}, {*parts[gh + 1 :]}
    assert sorted(map(sorted, sides)) == [["H+"], ["H-"]]
