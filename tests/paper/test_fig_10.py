"""Fig. 10: the contact of simulated worn wheels against the paper's sentences and other routes."""

from __future__ import annotations

import numpy as np
import pytest

from tests.paper.arrays import regress
from tests.paper.judging import judged
from tests.paper.worn import P, conicity, contacts, curves, sentences
from wheelset.profiles import equivalent_conicity
from wheelset.published.items import items_of
from wheelset.studies import worn_profiles

pytestmark = pytest.mark.slow


@pytest.mark.parametrize(("item", "vehicle"), judged(items_of("Fig. 10"), lambda _: P.vehicle))
def test_panel_is_as_the_paper_says(item, vehicle):
    assert len(sentences(item)) > 0
    assert sentences(item)["tolerated"].all()


@pytest.mark.parametrize("mileage", [0.2, 18.5])
def test_rolling_radius_is_the_profiles_at_the_contact(mileage):
    """r0 plus the profile's height where the contact is, moved so that the centre has r0."""
    contact = contacts()[mileage]
    mine = curves()[curves()["mileage"] == mileage]
    height = contact.wheels[0].z(contact.left.wheel_y)
    centre = np.interp(0.0, contact.y, height)
    assert np.allclose(mine["r"], contact.setup.r0 + height - centre, rtol=0, atol=1e-12)


@pytest.mark.parametrize("mileage", [0.2, 18.5])
def test_conicity_is_that_of_its_wave(mileage):
    contact = contacts()[mileage]
    at = worn_profiles.conicity_at(conicity(), 4e-3)[mileage]
    assert at == equivalent_conicity(contact, 4e-3).integration


def test_curves_are_as_stored():
    """Every half millimetre; the search settles to 1e-9 m."""
    rows = curves()[curves()["y"].mul(2e3).sub(curves()["y"].mul(2e3).round()).abs() < 1e-6]
    regress("fig_10", rows.round({"y": 12}), rtol=1e-5, atol=1e-8)
    regress("fig_10_conicity", conicity(), rtol=1e-5)
