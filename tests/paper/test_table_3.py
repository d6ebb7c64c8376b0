"""Table 3, Hopf columns: two readings of the unprinted values, against references and print."""

from __future__ import annotations

from functools import cache

import pytest

from tests.paper.judging import judged
from tests.paper.reference_values import ROWS
from wheelset.published.items import items_of
from wheelset.published.rules import verdict
from wheelset.studies import hopf_point

HOPF_ITEMS = [i for i in items_of("Table 3") if i.quantity in ("hopf_speed", "flc")]


@cache
def computed(vehicle):
    table = hopf_point.table_3_hopf(hopf_point.Parameters(vehicle=vehicle))
    return {f"Table 3: {row.parameter}={row.value:g}": row for row in table.itertuples()}


def rows():
    return [(vehicle, row) for vehicle, references in ROWS.items() for row in references]


@pytest.mark.slow
@pytest.mark.parametrize(("vehicle", "reference"), rows())
def test_row_equals_the_reference_to_its_last_digit(vehicle, reference):
    row = computed(vehicle)[f"Table 3: {reference.parameter}={reference.value:g}"]
    assert round(row.v, 2) == reference.hopf_speed
    assert round(row.flc, reference.flc_decimals) == reference.flc


@pytest.mark.slow
@pytest.mark.parametrize(
    ("item", "vehicle"),
    [parameter for vehicle in ROWS for parameter in judged(HOPF_ITEMS, lambda _, v=vehicle: v)],
)
def test_row_is_the_papers(item, vehicle):
    row = computed(vehicle)[item.item]
    value = {"hopf_speed": row.v, "flc": row.flc}[item.quantity]
    assert verdict(item.quantity, item.published, value, item.rounding) != "differs"
    if item.quantity == "hopf_speed":
        assert value == pytest.approx(item.published, abs=0.1)
