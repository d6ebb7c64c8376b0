"""Section 3's cycles, computed once for all tests of a session."""

from __future__ import annotations

from functools import cache

from wheelset.published.items import item_frame, items_of
from wheelset.studies import (
    flange_cycle_tables,
    flange_cycle_verdicts,
    flange_cycles,
    flange_readings,
)

P = flange_cycles.Parameters()
ITEMS = items_of("Section 3")


def vehicle_of(item):
    return P.cases[2 if "case 2" in item.item else 1]


@cache
def families(reading):
    return flange_cycles.all_families(P, reading, flange_readings.readings(P)[reading])


@cache
def filed():
    return families(flange_cycles.AS_FILED)


@cache
def constant():
    return families(flange_readings.CONSTANT)


@cache
def curves():
    return flange_cycle_tables.curve_frame(filed())


@cache
def verdicts():
    return flange_cycle_verdicts.verdict_frame(item_frame(ITEMS), filed(), constant())


def panel_of(case, law):
    return [f for f in filed() if (f.case, f.law) == (case, law)]
