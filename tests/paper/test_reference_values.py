"""What is known of the vehicles, judged by the rule that judges the book."""

from __future__ import annotations

import pytest

from tests.paper.reference_values import ROWS, Reference
from wheelset.published.comparison import compare, outdated, unexplained
from wheelset.published.items import geometry_item, items_of
from wheelset.published.numbers import TABLE_3


def _computed(rows: tuple[Reference, ...]) -> dict[tuple[str, str], float]:
    names = [geometry_item(row) for row in TABLE_3]
    speeds = {(n, "hopf_speed"): row.hopf_speed for n, row in zip(names, rows, strict=True)}
    return speeds | {(n, "flc"): row.flc for n, row in zip(names, rows, strict=True)}


@pytest.mark.parametrize("vehicle", ROWS)
def test_rows_are_those_of_table_3(vehicle):
    assert [(r.parameter, r.value) for r in ROWS[vehicle]] == [
        (r.parameter, r.value) for r in TABLE_3
    ]


@pytest.mark.parametrize("vehicle", ROWS)
def test_every_difference_is_a_known_departure_and_every_departure_differs(vehicle):
    table = compare(items_of("Table 3"), _computed(ROWS[vehicle]), vehicle)
    assert unexplained(table, vehicle) == ()
    assert outdated(table, vehicle) == ()


@pytest.mark.parametrize("vehicle", ROWS)
def test_all_hopf_speeds_are_within_a_tenth_of_print(vehicle):
    table = compare(items_of("Table 3"), _computed(ROWS[vehicle]), vehicle)
    speeds = table[table.quantity == "hopf_speed"]
    assert set(speeds.verdict) <= {"agrees", "within tolerance"}
