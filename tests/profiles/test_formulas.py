"""Formulas: continuous, tangent, of the heights that the standards name."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import brentq

from wheelset.profiles import ProfileError, packaged
from wheelset.profiles.catalogue import CATALOGUE
from wheelset.profiles.curves import PiecewiseCurve, SplineCurve, polynomial

#: Corners that the profiles have on purpose, mm: the field side of a wheel.
CORNERS = {30.0, 60.0}


def joints(name):
    curve = packaged(name).curve
    for k, y in enumerate(curve.joints[1:-1]):
        yield y, *(PiecewiseCurve((y - 1, y + 1), (curve.pieces[k + m],)) for m in (0, 1))


@pytest.mark.parametrize("name", CATALOGUE)
def test_pieces_meet_to_a_micrometre_and_are_tangent(name):
    for y, before, after in joints(name):
        # 1e-3 mm is what formulas printed to 1e-4 mm allow on a 70 degree flank
        assert abs(before(y) - after(y)) < 1e-6
        if round(y * 1e3, 3) not in CORNERS:
            assert abs(np.arctan(before(y, 1)) - np.arctan(after(y, 1))) < 1e-4


@pytest.mark.parametrize("name", CATALOGUE)
def test_derivatives_are_those_of_the_heights(name):
    profile = packaged(name)
    ends = np.array(profile.curve.joints)
    y = 0.5 * (ends[1:] + ends[:-1])
    h = 1e-6
    slope = (profile.z(y + h) - profile.z(y - h)) / (2 * h)
    bend = (profile.slope(y + h) - profile.slope(y - h)) / (2 * h)
    # central differences: h^2 times third derivatives of up to 1e4, and rounding / h
    assert profile.slope(y) == pytest.approx(slope, abs=1e-7)
    assert profile.curve(y, 2) == pytest.approx(bend, rel=1e-6, abs=1e-6)


@pytest.mark.parametrize(
    ("name", "y", "z"),
    [
        ("LMB10", -55, 28), ("LMB10", 0, 0), ("LMA", -54, 28), ("LMA", 0, 0),
        ("S1002", -55, 28), ("S1002", -37.5, 10), ("S1002", 0, 0),
        ("EN15302-A", 0, 0), ("EN15302-B", 0, 0), ("EN15302-B", -55, 28),
        ("60E1", 35.9998, 14.3), ("60E1", 0, 0), ("CHN60", -35.3996, 14.1928),
        ("EN15302-RailA", 0, 0),
    ],
)  # fmt: skip
def test_known_heights(name, y, z):
    assert packaged(name).z(y * 1e-3) * 1e3 == pytest.approx(z, abs=1e-3)


@pytest.mark.parametrize(("name", "y", "radius"), [("LMB10", -5, -350), ("60E1", 3, 300)])
def test_curvature_is_positive_where_the_body_is_convex(name, y, radius):
    assert packaged(name).curvature(y * 1e-3) == pytest.approx(1e3 / radius, rel=1e-12)


def test_curvatures_of_the_flange_are_those_of_its_arcs():
    assert packaged("LMB10").curvature([-0.055, -0.045, -0.03]) == pytest.approx(
        [1 / 0.012, 1 / 0.020, -1 / 0.015], rel=1e-9
    )


@pytest.mark.parametrize("name", ["60E1", "EN15302-RailA"])
def test_a_rotated_head_is_made_of_its_rotated_points(name):
    profile, angle = packaged(name), 0.03
    y = np.linspace(-0.03, 0.03, 41)
    z = profile.z(y)
    turned = profile.curve.rotated(angle)
    c, s = np.cos(angle), np.sin(angle)
    assert turned(y * c + z * s) == pytest.approx(z * c - y * s, abs=1e-12)
    assert turned.rotated(-angle)(y) == pytest.approx(z, abs=1e-12)


def test_curves_of_polynomials_and_splines_rotate_too():
    quadratic = PiecewiseCurve((-0.03, 0.03), (polynomial(0.0, 0.1, 2.0),))
    spline = SplineCurve.through(y := np.linspace(-0.03, 0.03, 601), quadratic(y))
    expected = quadratic(0.01) * np.cos(0.02) - 0.01 * np.sin(0.02)
    at = 0.01 * np.cos(0.02) + quadratic(0.01) * np.sin(0.02)
    for curve in (quadratic, spline):
        assert curve.rotated(0.02)(at) == pytest.approx(expected, abs=1e-11)
        assert curve.moved(0.001, 0.002)(0.011) == pytest.approx(quadratic(0.01) + 0.002, abs=1e-12)


def test_the_gauge_point_lies_14_mm_below_the_top():
    rail = packaged("60E1")
    exact = brentq(lambda y: float(rail.z(y)) - 0.014, -0.037, -0.03)
    assert rail.gauge_point() == pytest.approx(exact, abs=1e-10)
    assert rail.canted(0.05).gauge_point() > rail.gauge_point()


def test_a_rail_too_low_for_the_gauge_says_so():
    with pytest.raises(ValueError, match="gauge"):
        packaged("60E1").gauge_point(0.05)


def test_an_unknown_name_gets_a_hint():
    assert packaged("lmb10").name == "LMB10"
    with pytest.raises(ProfileError, match='did you mean "S1002"'):
        packaged("S1020")


def test_a_flank_that_leans_over_is_left_out():
    leaning = packaged("60E1").canted(1 / 20)
    low, high = leaning.domain
    y = np.linspace(low, high, 4001)
    assert np.all(np.isfinite(leaning.slope(y)))
    assert leaning.z(low) > 0.013 and leaning.z(high) > 0.03
    assert leaning.z(y).min() == pytest.approx(0.0, abs=1e-8)
