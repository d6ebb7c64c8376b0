"""Table 2: Hopf speed and first Lyapunov coefficient by flange model."""

from __future__ import annotations

from functools import cache

import pytest

from tests.paper.judging import judged
from wheelset.published.items import items_of
from wheelset.published.rules import verdict
from wheelset.studies import flange_models

CASES = flange_models.Parameters().cases
LAWS = {"none": "none", "quintic": "polynomial", "exponential": "exponential"} | {
    "reciprocal": "reciprocal"
}


@cache
def computed():
    table = flange_models.hopf_table(flange_models.Parameters())
    return {
        f"Table 2: case {row.case}, {LAWS[row.law]}": {"hopf_speed": row.v, "flc": row.flc}
        for row in table.itertuples()
    }


def vehicle_of(item):
    return CASES[int(item.item.split("case ")[1][0])]


@pytest.mark.slow
@pytest.mark.parametrize(("item", "vehicle"), judged(items_of("Table 2"), vehicle_of))
def test_row_is_the_papers(item, vehicle):
    value = computed()[item.item][item.quantity]
    assert verdict(item.quantity, item.published, value, item.rounding) != "differs"


@pytest.mark.slow
@pytest.mark.parametrize("case", CASES)
def test_cases_are_fitted_to_their_row_without_flange(case):
    row = computed()[f"Table 2: case {case}, none"]
    assert row["hopf_speed"] == pytest.approx(52.29, abs=5e-4)
    assert row["flc"] == pytest.approx({1: -11.17, 2: 10.68}[case], abs=5e-3)


@pytest.mark.slow
@pytest.mark.parametrize("case", CASES)
def test_only_the_polynomial_changes_the_type(case):
    signs = {law: computed()[f"Table 2: case {case}, {law}"]["flc"] > 0 for law in LAWS.values()}
    subcritical = case == 2
    assert signs == {law: subcritical or law == "polynomial" for law in LAWS.values()}
