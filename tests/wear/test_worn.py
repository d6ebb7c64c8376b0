"""Worn wheels: the curve, those that travel with the package, and that they can be made again."""

from __future__ import annotations

import numpy as np
import pytest

from wheelset.profiles import contact_geometry, equivalent_conicity, packaged, packaged_profiles
from wheelset.profiles.errors import ProfileError
from wheelset.profiles.worn import (
    LAWS,
    WornCurve,
    worn,
    worn_header,
    worn_names,
    worn_profiles,
)
from wheelset.wear import MILEAGES, Simulation, evolve, history_of, wear_law

NEW, RAIL = packaged("LMB10"), packaged("CHN60")
Y = np.linspace(-0.042, 0.030, 289)


def dent(y=Y):
    return 1e-3 * np.exp(-((y / 0.008) ** 2))


def test_a_worn_wheel_is_the_new_one_less_the_depth():
    wheel = worn(NEW, Y, dent())
    y = np.linspace(-0.04, 0.029, 500)
    assert NEW.z(y) - wheel.z(y) == pytest.approx(dent(y), abs=1e-9)
    slope = NEW.slope(y) - wheel.slope(y)
    assert slope == pytest.approx(-2 * y / 0.008**2 * dent(y), abs=1e-5)
    z, z1, z2 = wheel.curve.jet(y)
    assert np.array_equal(z, wheel.z(y))
    assert np.array_equal(z1, wheel.slope(y))
    assert np.array_equal(z2, wheel.curve(y, 2))


def test_nothing_is_removed_beyond_the_depths():
    wheel = worn(NEW, Y, dent())
    for y in (-0.055, -0.0421, 0.0301, 0.05):
        assert wheel.z(y) == NEW.z(y)
        assert wheel.curvature(y) == NEW.curvature(y)


def test_curves_can_be_moved_and_turned():
    curve = WornCurve.of(NEW.curve, Y, dent())
    y = np.linspace(-0.02, 0.02, 41)
    assert curve.moved(1e-3, 2e-3)(y + 1e-3) == pytest.approx(curve(y) + 2e-3, abs=1e-12)
    turned = curve.rotated(0.01)
    at, c, s = curve(y), np.cos(0.01), np.sin(0.01)
    assert turned(y * c + at * s) == pytest.approx(at * c - y * s, abs=1e-8)


@pytest.mark.parametrize("law", LAWS)
def test_packaged_wear_has_the_mileages_and_the_rate_of_the_field(law):
    wheels = worn_profiles(law)
    assert tuple(wheels) == MILEAGES
    depths = [NEW.z(Y) - wheel.z(Y) for wheel in wheels.values()]
    assert depths[-1].max() == pytest.approx(0.055e-3 * 18.5, rel=1e-6)
    assert np.all(np.diff([d.max() for d in depths]) > 0)
    assert min(d.min() for d in depths) >= 0
    # the published band: wear within 15 to 25 mm of the nominal circle
    for depth in depths:
        band = Y[depth > 0.1 * depth.max()]
        assert -0.025 <= band[0] < band[-1] <= 0.025
        assert abs(Y[depth.argmax()]) < 0.015


@pytest.mark.parametrize("law", LAWS)
def test_the_contact_of_packaged_worn_wheels_is_found_everywhere(law):
    conicities = []
    for wheel in worn_profiles(law).values():
        contact = contact_geometry(wheel, RAIL, trim=True)
        assert not contact.ended
        assert np.isfinite(contact.dr).all() and np.isfinite(contact.left.rho).all()
        conicities.append(equivalent_conicity(contact, 3e-3).integration)
    new = equivalent_conicity(contact_geometry(NEW, RAIL), 3e-3).integration
    assert conicities[0] > new
    assert conicities[-1] > 2 * new


@pytest.mark.parametrize("law", LAWS)
def test_depths_have_continuous_curvature(law):
    y = np.linspace(-0.03, 0.03, 60_001)
    for wheel in worn_profiles(law).values():
        bend = wheel.curve.removed(y, 2)
        # no step between points 1 um apart: a jump would stay whatever their distance
        assert abs(np.diff(bend)).max() < 2e-3 * np.ptp(bend) + 1e-3


def test_names_are_found_and_listed():
    assert packaged("lmb10@4.8-USFD").name == "LMB10@4.8-usfd"
    assert set(worn_names()) <= {p.name for p in packaged_profiles()}
    y = np.linspace(-0.02, 0.02, 9)
    assert np.array_equal(packaged("LMB10@18.5-usfd").z(y), worn_profiles("usfd")[18.5].z(y))
    with pytest.raises(ProfileError, match="did you mean"):
        packaged("LMB10@4.8-usdf")
    with pytest.raises(ProfileError, match='no worn wheels of the law "zobory"'):
        worn_profiles("zobory")


@pytest.mark.parametrize("law", LAWS)
def test_headers_say_how_the_wear_was_made(law):
    words = "\n".join(worn_header(law))
    for part in ("not measured", "wheelset wear LMB10 CHN60", law, "calibration", "\nseed: ", "mu"):
        assert part in words


@pytest.mark.slow
@pytest.mark.parametrize("law", LAWS)
def test_packaged_wear_can_be_made_again(law):
    simulation = Simulation(NEW, RAIL, wear_law(law))
    history = history_of(simulation, evolve(simulation))
    stored = [NEW.z(history.y) - wheel.z(history.y) for wheel in worn_profiles(law).values()]
    # the file has nine digits after the point of a millimetre
    assert history.depth == pytest.approx(np.array(stored), rel=1e-6, abs=2e-12)
