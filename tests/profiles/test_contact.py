"""Contacts: against closed forms and against a search without refinement."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

from tests.profiles.shapes import CONE, LEVEL, RAIL, ROLLING, WHEEL, cone, hollow_wheel, round_rail
from wheelset.profiles import EN_15302, ProfileError, Setup, contact_geometry, packaged
from wheelset.profiles.curves import PiecewiseCurve
from wheelset.profiles.errors import ContactOutcome, ProfileEnds

Y = np.linspace(-0.008, 0.008, 33)


def test_a_hollow_wheel_on_a_round_rail_touches_on_the_line_of_centres():
    contact = contact_geometry(hollow_wheel(), round_rail(), LEVEL, Y)
    lean = -Y / (WHEEL - RAIL)  # sine of the angle of the line of centres
    assert contact.left.rail_y == pytest.approx(RAIL * lean, abs=1e-11)
    assert contact.left.wheel_y == pytest.approx(WHEEL * lean, abs=1e-11)
    assert contact.left.delta == pytest.approx(-np.arcsin(lean), abs=1e-10)
    assert contact.left.rho == pytest.approx(np.full(len(Y), 1 / RAIL - 1 / WHEEL), rel=1e-9)
    assert contact.left.r == pytest.approx(LEVEL.r0 + WHEEL * (1 - np.sqrt(1 - lean**2)), abs=1e-12)


def test_a_cone_keeps_its_place_on_the_rail():
    contact = contact_geometry(cone(), round_rail(), LEVEL, Y)
    assert np.ptp(contact.left.rail_y) < 1e-11
    assert contact.dr == pytest.approx(2 * CONE * Y, abs=1e-12)
    assert contact.roll == pytest.approx(np.zeros(len(Y)))


def test_a_rolling_cone_leans_so_that_both_wheels_touch():
    contact = contact_geometry(cone(), round_rail(), ROLLING, Y)
    for k in (0, 12, 30):
        assert contact.roll[k] == pytest.approx(rolled_until_both_touch(cone(), Y[k]), abs=2e-9)


def rolled_until_both_touch(wheel, y):
    """Roll by bisection over heights from a bare search among 4e5 points, curves interpolated."""
    u = np.linspace(-0.025, 0.025, 400_001)
    z = wheel.z(u)

    def height(side, phi):
        across = (0.75 + u) * np.cos(phi) + side * z * np.sin(phi) + side * y - 0.75
        return np.min(round_rail().z(across) - z * np.cos(phi) + side * (0.75 + u) * np.sin(phi))

    return brentq(lambda phi: height(1, phi) - height(-1, phi), -0.01, 0.01, xtol=1e-12)


@pytest.mark.parametrize("setup", [Setup(), Setup(roll=False)])
def test_left_and_right_are_mirror_images(setup):
    contact = contact_geometry(
        packaged("LMB10"), packaged("CHN60"), setup, np.linspace(-6e-3, 6e-3, 61)
    )
    assert contact.left.r == pytest.approx(contact.right.r[::-1], abs=1e-9)
    assert contact.left.delta == pytest.approx(contact.right.delta[::-1], abs=1e-8)
    assert contact.roll == pytest.approx(-contact.roll[::-1], abs=1e-9)


@pytest.mark.parametrize("y", [-0.0071, -0.0029, 0.0011, 0.0042, 0.0085])
def test_the_contact_is_the_lowest_point_of_the_gap(y):
    wheel, rail = packaged("S1002"), packaged("60E1").canted(1 / 40)
    setup = Setup(roll=False)
    contact = contact_geometry(packaged("S1002"), packaged("60E1"), setup, [y, 0.009])
    u = np.linspace(-0.045, 0.04, 850_001)
    across = setup.wheel_at + u + y - setup.rail_at(rail)
    inside = (across > rail.domain[0]) & (across < rail.domain[1])
    gap = rail.z(across[inside]) - wheel.z(u[inside])
    # the samples lie 1e-7 m apart; the lowest gap of them is met to that squared over the radius
    assert contact.left.wheel_y[0] == pytest.approx(u[inside][gap.argmin()], abs=2e-6)


def test_jumps_are_where_two_points_touch_at_once():
    wheel, rail = packaged("EN15302-B"), packaged("EN15302-RailA")
    contact = contact_geometry(wheel, rail, EN_15302, np.linspace(-0.006, 0.006, 121))
    (right, left) = contact.jumps
    assert (right.side, left.side) == ("right", "left")
    assert left.y == pytest.approx(-right.y, abs=2e-6)

    def gap(u, y):
        return float(rail.z(u + y) - wheel.z(u))

    def lowest(between, y):
        u = np.linspace(*between, 200_001)
        return np.min(rail.z(u + y) - wheel.z(u))

    def unequal(y):
        return lowest((left.u_to - 2e-3, left.u_to + 2e-3), y) - lowest(
            (left.u_from - 2e-3, left.u_from + 2e-3), y
        )

    assert left.y == pytest.approx(brentq(unequal, 0.0025, 0.0035), abs=1e-6)
    at = np.flatnonzero(abs(contact.y - left.y) <= 1e-6)
    # within 1e-6 m of the jump, where the gaps part by a slope of 0.3
    assert contact.left.rival_gap[at].max() < 1e-6
    assert gap(left.u_from, left.y) == pytest.approx(gap(left.u_to, left.y), abs=1e-6)


def test_the_grid_does_not_move_a_jump():
    wheel, rail = packaged("S1002"), packaged("60E1")
    places = [
        [jump.y for jump in contact_geometry(wheel, rail, Setup(), y).jumps]
        for y in (np.linspace(-0.007, 0.007, 57), np.linspace(-0.007, 0.007, 281))
    ]
    assert places[0] == pytest.approx(places[1], abs=2e-6)
    assert len(places[0]) == 2


def test_checks_known_of_chinese_wheels():
    contact = contact_geometry(packaged("LMB10"), packaged("CHN60"), y=[-0.001, 0.0, 0.001])
    left = contact.left
    assert left.delta[1] == pytest.approx(0.066, abs=5e-4)
    # the printed -2.88 is the second derivative; R350 is -2.857
    assert left.wheel_curvature[1] == pytest.approx(-2.88, abs=0.03)
    # R300 ends at a slope of 10/300; 0.066 - 1/40 lies beyond it, on R80
    assert left.rail_curvature[1] == pytest.approx(1 / 0.08, rel=1e-9)
    contact = contact_geometry(packaged("LMA"), packaged("CHN60"), y=[0.0])
    assert contact.left.delta[0] == pytest.approx(0.025, abs=5e-4)


def test_different_wheels_shift_the_middle():
    contact = contact_geometry(
        hollow_wheel(1e-3), round_rail(), LEVEL, Y, wheel_right=hollow_wheel(-1e-3)
    )
    alike = contact_geometry(hollow_wheel(), round_rail(), LEVEL, Y + 1e-3)
    assert contact.dr == pytest.approx(alike.dr, abs=1e-11)


def test_unequal_radii_add_to_the_difference():
    setup = replace(LEVEL, r0_right=0.459)
    contact = contact_geometry(cone(), round_rail(), setup, Y)
    assert contact.dr == pytest.approx(2 * CONE * Y + 1e-3, abs=1e-12)


def test_a_profile_that_ends_is_named_or_left_out():
    whole = packaged("LMB10").curve
    cut = PiecewiseCurve((-0.030, *whole.joints[5:]), whole.pieces[4:])
    wheel = replace(packaged("LMB10"), curve=cut)
    with pytest.raises(ProfileEnds, match=r"right wheel reaches the end .* y = -"):
        contact_geometry(wheel, packaged("CHN60"), Setup(), np.linspace(-0.012, 0.012, 241))
    contact = contact_geometry(
        wheel, packaged("CHN60"), Setup(), np.linspace(-0.012, 0.012, 241), trim=True
    )
    assert len(contact.ended) == 2
    assert contact.y[-1] < 0.012
    full = contact_geometry(packaged("LMB10"), packaged("CHN60"), Setup(), contact.y[contact.asked])
    assert contact.dr[contact.asked] == pytest.approx(full.dr[full.asked], abs=1e-9)


@pytest.mark.parametrize("roll", [True, False])
def test_a_wheelset_beside_its_rails_is_an_outcome(roll):
    with pytest.raises(ContactOutcome, match="y = "):
        contact_geometry(packaged("LMB10"), packaged("CHN60"), Setup(gauge=1.8, roll=roll), [0.0])
    with pytest.raises(ContactOutcome):
        contact_geometry(packaged("LMB10"), packaged("CHN60"), Setup(gauge=1.2, roll=roll), [0.0])


def test_tables_hold_what_was_asked_for():
    contact = contact_geometry(packaged("EN15302-B"), packaged("EN15302-RailA"), EN_15302)
    frame = contact.to_frame()
    assert len(frame) == 401
    assert frame.index.name == "y"
    assert {"dr", "roll", "delta_left", "rho_right", "wheel_y_left", "rail_y_right"} <= set(frame)
    assert len(contact.y) > 401


@pytest.mark.parametrize(
    ("values", "said"),
    [({"gauge": 1435.0}, "gauge"), ({"cant": -0.1}, "cant"), ({"r0": 0.01}, "r0")],
)
def test_a_setup_out_of_range_names_the_field(values, said):
    with pytest.raises(ValueError, match=f"{said} = .* lies between"):
        Setup(**values)


def test_wheels_and_rails_are_not_confused():
    with pytest.raises(ProfileError, match="CHN60 is a rail, a wheel is wanted"):
        contact_geometry(packaged("CHN60"), packaged("LMB10"))
    with pytest.raises(ValueError, match="ascending"):
        contact_geometry(packaged("LMB10"), packaged("CHN60"), y=[0.001, 0.0])


def test_the_axle_moves_back_as_it_rolls():
    contact = contact_geometry(packaged("LMB10"), packaged("CHN60"), Setup(), [0.0, 0.003])
    assert contact.axle_y[1] == pytest.approx(0.003 - 0.46 * np.sin(contact.roll[1]), abs=1e-15)
    assert contact.roll[1] > 0
