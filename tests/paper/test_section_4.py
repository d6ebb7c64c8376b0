"""Section 4: the default Hopf point."""

from __future__ import annotations

import pytest

from tests.paper import reference_values as reference
from tests.paper.judging import judged
from wheelset.published.items import ITEMS
from wheelset.published.rules import verdict
from wheelset.studies import hopf_point

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
