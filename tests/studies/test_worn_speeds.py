"""Trends and crossings of speeds by mileage, on numbers whose answers are known."""

from __future__ import annotations

from types import SimpleNamespace

import pandas as pd
import pytest

from wheelset.studies import worn_speeds
from wheelset.studies.worn_profiles import AT_THE_FLANGE

TABLE = pd.DataFrame(
    {
        "mileage": [1.0, 2.0, 3.0, 4.0],
        "v_lin": [60.0, 66.0, None, 55.0],
        "flc": [-1.0, 2.0, None, -3.0],
        "v_fold": [50.0, 45.0, 40.0, 30.0],
    }
)


def test_trends_are_those_of_the_rows_that_have_a_value():
    row = worn_speeds.trends(TABLE)
    assert (row["fastest"], row["changes"]) == (2.0, 2)
    assert row["spread"] == pytest.approx(66 / 55)
    assert row["signs"] == "\u2212+\u2212"
    assert (row["fold_rank"], row["fold_spread"]) == pytest.approx((-1.0, 5 / 3))


def test_trends_of_what_is_missing_are_none():
    row = worn_speeds.trends(TABLE.drop(columns="v_fold").iloc[:1])
    assert (row["fastest"], row["spread"], row["fold_rank"]) == (1.0, None, None)
    assert worn_speeds.trends(TABLE[2:3])["fastest"] is None


def test_a_change_needs_two_values():
    assert worn_speeds.change(TABLE, "v_lin") == (60.0, 55.0)
    with pytest.raises(ValueError, match="two are needed"):
        worn_speeds.change(TABLE[2:3], "v_lin")


def test_rank_correlation_knows_order_only():
    assert worn_speeds.rank_correlation([1, 2, 3], [0.1, 10.0, 1e6]) == pytest.approx(1.0)
    assert worn_speeds.rank_correlation([1, 2, 3], [3.0, 2.9, -1.0]) == pytest.approx(-1.0)


def test_crossings_are_where_straight_lines_pass():
    curve = pd.DataFrame({"mileage": [0.0, 2.0, 4.0], "v": [80.0, 60.0, 70.0]})
    assert worn_speeds.crossings(curve, 65.0) == pytest.approx((1.5, 3.0))
    assert worn_speeds.crossings(curve, 90.0) == ()
    words = worn_speeds.crossing_frame({"a": curve}, [(0.2, 65.0), (4.8, 90.0)])["a"]
    assert words.tolist() == ["1.5, 3.0", "\u2013"]


def test_the_fold_is_the_slowest_short_of_the_flange():
    def fold(speed, amplitude):
        return SimpleNamespace(
            values=[speed], solution=SimpleNamespace(measure=lambda _: amplitude)
        )

    folds = (fold(80.0, 1e-3), fold(70.0, 4e-3), fold(50.0, 1.01 * AT_THE_FLANGE))
    run = SimpleNamespace(folds=folds, hopf=None, branch=None, found=SimpleNamespace(words=""))
    row = worn_speeds.table_4({1.0: run}).iloc[0]
    assert (row["v_fold"], row["fold_amplitude"]) == (70.0, 4e-3)
    empty = SimpleNamespace(folds=(), hopf=None, branch=None, found=SimpleNamespace(words="none"))
    assert pd.isna(worn_speeds.table_4({1.0: empty})["v_fold"]).all()
