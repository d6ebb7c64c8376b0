"""The comparison: verdicts by one rule, reasons from one file, nothing left out."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from wheelset.published.comparison import COLUMNS, Judgement, compare, outdated, unexplained
from wheelset.published.departures import departure_of, departures
from wheelset.published.items import ITEMS, items_of
from wheelset.published.rules import RULES, verdict
from wheelset.vehicle import load_vehicle

ROW = "Table 3: c1=200"
FLC = (ROW, "flc")


def judged(key, value, vehicle=""):
    table = compare(ITEMS, {key: value}, vehicle)
    return table[(table.item == key[0]) & (table.quantity == key[1])].iloc[0]


def test_everything_is_not_yet_until_it_is_computed():
    table = compare(ITEMS, {})
    assert tuple(table.columns) == COLUMNS
    assert len(table) == len(ITEMS)
    assert set(table.verdict) == {"not yet"}
    assert unexplained(table, "guo2021") == outdated(table, "guo2021") == ()


@pytest.mark.parametrize(
    ("quantity", "published", "computed", "expected"),
    [
        ("hopf_speed", 51.70, 51.7199, "agrees"),
        ("hopf_speed", 51.70, 51.7201, "within tolerance"),
        ("hopf_speed", 51.70, 51.60, "within tolerance"),
        ("hopf_speed", 51.70, 51.59, "differs"),
        ("flc", -19.71, -19.32, "agrees"),
        ("flc", -19.71, -17.75, "within tolerance"),
        ("flc", -19.71, -17.73, "differs"),
        ("flc", -19.71, 19.71, "differs"),
        ("flc", 0.70, 0.7049, "agrees"),
        ("lpc_speed", 50.65, 50.74, "agrees"),
        ("nfc", 100.0, 104.0, "agrees"),
    ],
)
def test_the_rule(quantity, published, computed, expected):
    assert verdict(quantity, published, computed, rounding=0.005) == expected


@given(st.sampled_from(sorted(RULES)), st.floats(-1e6, 1e6), st.floats(0, 1e3), st.floats(0, 1e3))
def test_a_smaller_difference_never_has_a_worse_verdict(quantity, published, one, other):
    order = ["agrees", "within tolerance", "differs"]
    near, far = sorted((one, other))
    ranks = [order.index(verdict(quantity, published, published + d, 0.0)) for d in (near, far)]
    assert ranks[0] <= ranks[1]


def test_the_printed_number_agrees_with_itself():
    computed = {item.key: item.published for item in ITEMS if item.published is not None}
    assert set(compare(ITEMS, computed).verdict) == {"agrees", "not yet"}


def test_a_known_departure_gives_its_reason_and_an_unknown_one_is_named():
    known = judged(FLC, 86.72, "guo2021")
    assert known.verdict == "differs"
    assert known.reason == departure_of(*FLC, "guo2021").reason
    assert known.difference == pytest.approx(27.0)
    table = compare(items_of("Table 3"), {FLC: 86.72}, "guo2021_m2")
    (said,) = unexplained(table, "guo2021_m2")
    assert ROW in said
    assert "guo2021_m2" in said


def test_a_remark_does_not_explain_a_difference():
    table = compare(items_of("Table 3"), {FLC: 86.72}, "guo2021_m2").assign(reason="Fitted: so.")
    assert len(unexplained(table, "guo2021_m2")) == 1


def test_a_differing_figure_brings_its_own_reason():
    table = compare(ITEMS, {("Fig. 7: c", "figure"): Judgement("differs", "rises only")})
    assert unexplained(table, "guo2021") == ()


def test_a_departure_that_agrees_is_outdated():
    table = compare(items_of("Table 3"), {FLC: 59.7}, "guo2021")
    (said,) = outdated(table, "guo2021")
    assert ROW in said
    assert "agrees" in said


def test_a_figure_is_judged_in_words():
    row = judged(("Fig. 7: c", "figure"), Judgement("agrees", "falls, then rises"))
    assert (row.verdict, row.reason) == ("agrees", "falls, then rises")
    with pytest.raises(ValueError, match="is a figure"):
        compare(ITEMS, {("Fig. 7: c", "figure"): 1.0})
    with pytest.raises(ValueError, match="needs a reason"):
        Judgement("differs", " ")
    with pytest.raises(ValueError, match="allowed"):
        Judgement("fine", "why")


def test_what_is_no_item_or_no_number_is_refused():
    with pytest.raises(KeyError, match="Table 9"):
        compare(ITEMS, {("Table 9: x", "flc"): 1.0})
    with pytest.raises(ValueError, match="nan"):
        compare(ITEMS, {FLC: math.nan})
    assert judged(FLC, None).verdict == "not yet"


def test_departures_are_of_known_items_and_vehicles():
    keys = {item.key for item in ITEMS}
    for departure in departures():
        assert (departure.item, departure.quantity) in keys
        assert load_vehicle(departure.vehicle).name == departure.vehicle
        assert departure.reason.count(" ") > 5
    assert len({d.key for d in departures()}) == len(departures())
