"""Functions of y for the model: their derivatives, what they fit, what the model makes of them."""

from __future__ import annotations

import math

import mpmath
import numpy as np
import pytest
import sympy as sp

from tests.profiles.shapes import CONE, LEVEL, cone, round_rail
from wheelset.profiles import PolynomialFit, SineFit, SplineGeometry, contact_geometry, packaged
from wheelset.profiles.functions import (
    Polynomial,
    SineSeries,
    fit_polynomial,
    fit_sines,
    fit_spline,
    smooth_spline,
)
from wheelset.vehicle.geometry import ExpandedGeometry

Y = np.linspace(-0.005, 0.005, 201)
WAVE = 2e-4 * np.sin(310 * Y) + 0.03 * Y


@pytest.fixture(scope="module")
def contact():
    return contact_geometry(packaged("LMB10"), packaged("CHN60"))


def test_polynomials_expand_as_sympy_does():
    y = sp.Symbol("y")
    c = (1e-4, 0.08, -3.0, 500.0)
    expected = sp.Poly(sum(ck * (y + sp.Rational(1, 500)) ** k for k, ck in enumerate(c)), y)
    found = Polynomial(c).taylor(np.array([0.002]), 5)
    assert found[0] == pytest.approx([float(v) for v in expected.all_coeffs()[::-1]] + [0, 0])


def test_sines_expand_as_mpmath_does():
    series = SineSeries(300.0, (0.1, 0.2, -0.3), (0.0, 0.5, 0.7))

    def f(y):
        return sum(
            a * mpmath.cos(300 * k * y) + b * mpmath.sin(300 * k * y)
            for k, (a, b) in enumerate(zip(series.a, series.b, strict=True))
        )

    expected = [float(c) for c in mpmath.taylor(f, 0.0013, 5)]
    assert series.taylor(0.0013, 5) == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("y", [-0.0071, -0.0033, 0.0012, 0.0049, 0.0064])
def test_splines_expand_to_their_own_differences(y):
    spline = fit_spline(Y, WAVE, tolerance=1e-9)
    c = spline.taylor(np.array([y]), 5)[0]
    h = np.array([-2e-5, 1e-5, 3e-5])
    values = spline.taylor(y + h, 0)[:, 0]
    # the remainder is zero: a spline of degree 5 inside one piece, a straight line beyond
    assert values == pytest.approx(sum(ck * h**k for k, ck in enumerate(c)), abs=1e-13)
    assert spline.taylor(np.zeros((2, 3)), 7).shape == (2, 3, 8)


def test_fits_return_what_they_are_made_of():
    cubic = fit_polynomial(Y, 0.1 * Y - 500 * Y**3, 3)
    assert cubic.coefficients == pytest.approx((0, 0.1, 0, -500), abs=1e-8)
    q = math.pi / 2 / 0.005
    sines = fit_sines(Y, 0.3 + 2 * np.sin(q * Y) - 0.5 * np.cos(2 * q * Y), 3)
    assert sines.a == pytest.approx((0.3, 0, -0.5, 0), abs=1e-9)
    assert sines.b == pytest.approx((0, 2, 0, 0), abs=1e-9)
    quintic = fit_spline(Y, Y**5)
    assert quintic.taylor(Y, 0)[:, 0] == pytest.approx(Y**5, abs=1e-22)


@pytest.mark.parametrize("width", [2e-4, 5e-4, 1e-3])
def test_an_average_of_a_sine_is_a_smaller_sine(width):
    wide = np.linspace(-0.012, 0.012, 4801)
    spline = smooth_spline(wide, np.sin(400 * wide), 0.005, width)
    shrunk = np.exp(-0.5 * (400 * width) ** 2)
    expected = [
        shrunk * 400**j * np.sin(400 * Y + j * np.pi / 2) / math.factorial(j) for j in range(6)
    ]
    found = spline.taylor(Y, 5)
    inner = abs(Y) < 0.004
    # the spline's own error grows with the derivative, as (spacing of knots)^(6 - j)
    for j, tolerance in enumerate((1e-5, 1e-5, 1e-4, 1e-3, 1e-2, 0.1)):
        scale = shrunk * 400**j / math.factorial(j)
        assert found[inner, j] == pytest.approx(expected[j][inner], abs=tolerance * scale)


def test_an_average_keeps_lines_and_does_not_swing_beside_a_kink():
    line = smooth_spline(Y, 0.3 + 2 * Y, 0.005, 5e-4)
    assert line.taylor(Y, 1) == pytest.approx(np.stack([0.3 + 2 * Y, 0 * Y + 2], -1), abs=1e-9)
    kink = smooth_spline(Y, np.maximum(Y, 0), 0.005, 2e-4)
    slope = kink.taylor(np.linspace(-0.005, 0.005, 1001), 1)[:, 1]
    assert slope.min() > -1e-4 and slope.max() < 1 + 1e-4
    assert abs(slope[:300]).max() < 1e-4


def test_a_tolerance_takes_the_coarsest_spline_that_meets_it():
    coarse, fine = (fit_spline(Y, WAVE, tolerance=t) for t in (1e-6, 1e-10))
    assert coarse.intervals < fine.intervals
    assert abs(coarse.taylor(Y, 0)[:, 0] - WAVE).max() <= 1e-6


@pytest.mark.parametrize("kind", [SplineGeometry, PolynomialFit, SineFit])
def test_the_model_takes_every_geometry(kind, contact):
    geometry = kind.of(contact, 0.004)
    expanded = ExpandedGeometry(geometry.functions)
    assert str(expanded.expression("dr", "left")) == "dr_left(y)"
    left, right = (geometry.functions[f"dr_{side}"].taylor(Y, 1) for side in ("left", "right"))
    assert left[:, 0] == pytest.approx(right[::-1, 0], abs=1e-9)
    # contacts are found to 1e-9 m; a spline's slope divides that by 0.1 mm
    assert left[:, 1] == pytest.approx(-right[::-1, 1], abs=1e-5)
    # nominal radius: the mean of the centred wheels
    assert abs(geometry.functions["dr_left"].taylor(0.0, 0)[0]) < 2e-5


def test_errors_are_the_distance_from_the_contacts(contact):
    spline = SplineGeometry.by_validation(contact, 0.005)
    cubic = PolynomialFit.of(contact, 0.005)
    inside = contact.asked & (abs(contact.y) <= 0.005 + 1e-12)
    y, dr = contact.y[inside], contact.left.r[inside] - contact.left.r[abs(contact.y).argmin()]
    for fit in (spline, cubic):
        off = abs(fit.functions["dr_left"].taylor(y, 0)[:, 0] - dr)
        assert fit.errors["dr_left"].largest == pytest.approx(off.max(), rel=1e-9)
        assert fit.errors["dr_left"].rms == pytest.approx(np.sqrt(np.mean(off**2)), rel=1e-9)
    assert spline.errors["dr_left"].rms < 0.2 * cubic.errors["dr_left"].rms


def test_a_cone_has_one_coefficient():
    fit = PolynomialFit.of(contact_geometry(cone(), round_rail(), LEVEL), 0.005)
    common, difference = fit.coefficients("dr")
    assert common == pytest.approx([0, CONE, 0, 0], abs=1e-5)
    assert difference == pytest.approx(np.zeros(4), abs=1e-5)
    assert fit.coefficients("delta")[0][0] == pytest.approx(np.arctan(CONE), rel=1e-9)


def test_jumps_inside_are_named():
    contact = contact_geometry(packaged("S1002"), packaged("60E1"))
    assert len(SplineGeometry.of(contact, 0.006).jumps) == 2
    assert SplineGeometry.of(contact, 0.003).jumps == ()


def test_a_reach_beyond_the_contacts_is_refused(contact):
    with pytest.raises(ValueError, match=r"reach = 0\.02 m is out of range"):
        SplineGeometry.of(contact, 0.02)
    with pytest.raises(ValueError, match="width"):
        SplineGeometry.of(contact, 0.004, width=0.1)
    with pytest.raises(ValueError, match="degree"):
        PolynomialFit.of(contact, 0.004, degree=0)
    with pytest.raises(ValueError, match="terms"):
        SineFit.of(contact, 0.004, terms=99)
