"""Section 4: the default Hopf point and the generalised Hopf points."""

from __future__ import annotations

from functools import cache

import pytest

from tests.paper import reference_values as reference
from tests.paper.judging import judged
from wheelset.published.items import ITEMS, items_of
from wheelset.published.numbers import GENERALIZED_HOPF
from wheelset.published.rules import verdict
from wheelset.studies import hopf_curves, hopf_point
from wheelset.studies.section_curves import hopf_at

DEFAULT = [item for item in ITEMS if item.item == "Section 4: default"]


def default(vehicle):
    return hopf_point.first_default(hopf_point.Parameters(vehicle=vehicle))


def test_default_point_equals_the_reference_to_its_last_digit():
    point = default("guo2021")
    assert round(point.v, 8) == reference.HOPF_SPEED
    assert round(point.frequency, 8) == reference.HOPF_FREQUENCY
    assert round(point.flc, 6) == reference.FLC_DEFAULT


def test_stability_is_lost_once_and_gently():
    changes = hopf_point.default_hopf(hopf_point.Parameters())
    assert list(changes["kind"]) == ["H-"]
    assert "stability is lost" in changes["words"][0]


@pytest.mark.parametrize(
    ("item", "vehicle"),
    [
        parameter
        for vehicle in ("guo2021", "guo2021_m2")
        for parameter in judged(DEFAULT, lambda _, v=vehicle: v)
    ],
)
def test_default_point_is_the_papers(item, vehicle):
    point = default(vehicle)
    value = {"hopf_speed": point.v, "flc": point.flc}[item.quantity]
    assert verdict(item.quantity, item.published, value, item.rounding) != "differs"


# --- generalised Hopf points ---------------------------------------------------------------------

CURVES = hopf_curves.Parameters()
POINTS = [row for row in GENERALIZED_HOPF if row.section == 4]
POINT_ITEMS = [i for i in items_of("Section 4") if i.quantity in ("gh_value", "slc")]


@cache
def points():
    wanted = [(row.parameter, row.value) for row in POINTS]
    found = hopf_curves.printed_gh(hopf_curves.hopf_scans(CURVES), wanted)
    return {f"Section 4: GH {row.parameter}={row.wanted:.12g}": row for row in found.itertuples()}


@pytest.mark.slow
@pytest.mark.parametrize(("item", "vehicle"), judged(POINT_ITEMS, lambda _: CURVES.vehicle))
def test_generalised_hopf_point_is_the_papers(item, vehicle):
    row = points()[item.item]
    assert row.words == ""
    value = {"gh_value": row.value, "slc": row.slc}[item.quantity]
    assert verdict(item.quantity, item.published, value, item.rounding) != "differs"


@pytest.mark.slow
def test_the_coefficient_vanishes_at_every_point_found():
    """FLC at the point, by the Hopf point solved for there: zero beside its size elsewhere."""
    for s in hopf_curves.hopf_scans(CURVES):
        for point in s.searched.of_kind("GH"):
            hopf = hopf_at(s.system, s.searched, float(point.values[1]))
            largest = max(abs(one.solution.lyapunov) for one in s.searched.points)
            assert abs(hopf.lyapunov) < 1e-6 * largest
