"""The logic of section 3's cycles: verdicts, claims and readings, on cases small enough to see."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest
from pydantic import ValidationError

from wheelset.bifurcation.outcomes import NoConvergence
from wheelset.published.items import item_frame, items_of
from wheelset.studies import (
    flange_cycle_artefacts,
    flange_cycle_claims,
    flange_cycle_tables,
    flange_cycle_verdicts,
    flange_cycles,
    flange_readings,
)

P = flange_cycles.Parameters(resolution="quick")


@pytest.fixture(scope="module")
def exponential():
    place = (flange_cycles.AS_FILED, 2, "exponential")
    vehicle = flange_cycles.case_vehicle(P, 2, "exponential")
    return flange_cycles.families_of(P, vehicle, place)


@pytest.fixture(scope="module")
def curves(exponential):
    return flange_cycle_tables.curve_frame(exponential)


def test_every_printed_point_is_read():
    points = flange_cycle_artefacts.printed_points(item_frame(items_of("Section 3")))
    assert len(points) == 12
    assert {one.law for one in points} == set(flange_cycles.LAWS)
    assert points[-1] == flange_cycle_artefacts.Printed(
        "Section 3: case 2, reciprocal, PD", 2, "reciprocal", "PD", 51.37
    )


def test_constant_curvatures_leave_hopf_point_and_coefficient_where_they_were():
    for case in P.cases:
        rows = flange_readings.chosen_again(P, case, flange_readings.CURVATURES)
        plain, constant = (
            flange_cycles.hopf_of(P, flange_cycles.case_vehicle(P, case, "none", changes))
            for changes in ((), rows)
        )
        assert constant.value == pytest.approx(plain.value, abs=1e-8)
        assert constant.lyapunov == pytest.approx(plain.lyapunov, abs=1e-6)
        assert rows[:4] == flange_readings.CURVATURES
        assert [row.split("=")[0] for row in rows[4:]] == ["a1", "a3"]


def test_a_branch_is_a_table_in_order(exponential, curves):
    (family,) = exponential
    assert len(curves) == len(family.branch.points) + len(family.branch.special)
    fold = curves[curves["point"] == "LPC"]
    assert fold["v"].to_numpy() == pytest.approx(curves["v"].min(), abs=1e-6)
    assert (np.diff(curves["y"]) > 0).all()
    beyond = flange_cycle_claims.beyond_fold(curves)
    assert flange_cycle_claims.unstable(beyond) == 0.0
    assert flange_cycle_claims.unstable(curves.loc[: fold.index[0]]) == 1.0


def test_a_printed_branch_point_at_hopf_or_at_the_fold_is_an_artefact(exponential):
    (family,) = exponential
    fold = float(family.branch.of_kind("LPC")[0].values[0])
    speeds = {"LPC": fold, "BPC": fold - 0.1, "BPC 2": family.hopf, "BPC 3": fold + 1.0}
    items = pd.DataFrame(
        {
            "item": [f"Section 3: case 2, exponential, {name}" for name in speeds],
            "quantity": [f"{name[:3].lower()}_speed" for name in speeds],
            "published": list(speeds.values()),
        }
    )
    frame = flange_cycle_verdicts.verdict_frame(items, exponential, exponential)
    words = ["real", "artefact", "artefact", "outside the domain"]
    assert frame["verdict"].tolist() == words
    assert "0.10 m/s below the fold" in frame["evidence"][1]
    assert frame["y"][2] == 0.0
    assert frame["found"].isna().tolist() == [False, True, True, True]


def test_a_fold_far_from_print_is_at_another_speed(exponential):
    fold = float(exponential[0].branch.of_kind("LPC")[0].values[0])
    items = pd.DataFrame(
        {
            "item": ["Section 3: case 2, exponential, LPC"],
            "quantity": ["lpc_speed"],
            "published": [fold + 0.6],
        }
    )
    frame = flange_cycle_verdicts.verdict_frame(items, exponential, exponential)
    assert frame["verdict"].tolist() == [flange_cycle_verdicts.ELSEWHERE]
    assert "(-0.60)" in frame["evidence"][0]


def test_sensitivity_of_a_fold_is_the_difference_of_two_folds(exponential):
    """A central difference over 2 percent of a1; its own error is of second order, 1e-4."""
    slopes = flange_cycle_tables.sensitivity_frame(exponential).set_index("parameter")
    value = slopes.loc["a1", "value"]
    ends = []
    for part in (0.99, 1.01):
        vehicle = flange_cycles.case_vehicle(P, 2, "exponential", [f"a1={float(part * value)!r}"])
        (family,) = flange_cycles.families_of(P, vehicle, ("", 2, "exponential"))
        ends.append(float(family.branch.of_kind("LPC")[0].values[0]))
    slope = (ends[1] - ends[0]) / (0.02 * value)
    assert slopes.loc["a1", "slope"] == pytest.approx(slope, rel=1e-3)


def test_amplitude_between_points_is_on_a_straight_line():
    branch = pd.DataFrame({"v": [1.0, 3.0, 2.0], "y": [0.0, 2.0, 4.0]})
    assert flange_cycle_claims.amplitude_at(branch, 2.5) == pytest.approx(3.0)
    assert flange_cycle_claims.amplitude_at(branch, 5.0) == 0.0


def test_a_window_without_hopf_point_is_a_named_outcome():
    narrow = flange_cycles.Parameters(v_min=10, v_max=20)
    with pytest.raises(NoConvergence, match="no Hopf point between 10 and 20"):
        flange_cycles.hopf_of(narrow, flange_cycles.case_vehicle(narrow, 1, "none"))


def test_speeds_followed_hold_the_hopf_point():
    assert flange_cycles.followed(52.0, "none") == flange_cycles.OTHER_SPEEDS
    assert flange_cycles.followed(120.0, "quintic") == (20.0, 130.0)
    assert flange_cycles.followed(20.0, "none") == (15.0, 70.0)


def test_unknown_parameters_are_refused():
    with pytest.raises(ValidationError, match="vehicle_case_3"):
        flange_cycles.Parameters(vehicle_case_3="guo2021")
