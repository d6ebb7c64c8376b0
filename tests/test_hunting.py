"""The door: reference evaluations of the spec, and geometries that are not polynomials."""

from __future__ import annotations

import math

import numpy as np
import pytest
import sympy as sp
from numpy.polynomial import Polynomial
from scipy.interpolate import CubicSpline

from tests.vehicle.readings import M1, reading
from wheelset.bifurcation.equilibria.hopf import hopf_point, instabilities
from wheelset.bifurcation.outcomes import NotFinite
from wheelset.hunting import hunting_system
from wheelset.vehicle import load_vehicle
from wheelset.vehicle.geometry import ExpandedGeometry

STATE = [0.003, 0.002, 0.05, -0.03]


class TestReferenceEvaluations:
    """Values of an independent code for set M1 at 50 m/s, all digits."""

    @pytest.mark.parametrize(
        ("sign", "expected"),
        [
            ("reversed", (0.05, -0.03, -1.31997941176, -6.9067249432)),
            ("physical", (0.05, -0.03, -1.35450898455, -6.90663066338)),
        ],
    )
    def test_right_hand_side(self, sign, expected):
        vehicle = load_vehicle("guo2021", overrides=[f"contact_angle_sign={sign}"])
        np.testing.assert_allclose(hunting_system(vehicle).rhs(STATE), expected, rtol=1e-11)

    def test_jacobian_at_the_centre(self):
        J = hunting_system(load_vehicle("guo2021")).jacobian(np.zeros(4))
        expected = [
            (-1284.476021, 2530.874021, -50.555442, -0.064907),
            (-1417.404280, -2025.306379, 0.101622, -43.471223),
        ]
        np.testing.assert_allclose(J[2:], expected, atol=5.1e-7)

    def test_hopf_point(self):
        (hopf,) = instabilities(hunting_system(load_vehicle("guo2021")), "v", (5.0, 200.0))
        assert hopf.value == pytest.approx(51.70606841, abs=5e-9)
        assert hopf.frequency == pytest.approx(40.97664584, abs=5e-9)
        assert hopf.lyapunov == pytest.approx(-23.255255, abs=5e-7)

    def test_first_lyapunov_coefficient_at_a3_200(self):
        system = hunting_system(load_vehicle("guo2021", overrides=["a3=200"]))
        assert hopf_point(system, "v", 50.0).lyapunov == pytest.approx(7.405071, abs=5e-7)

    def test_packaged_vehicle_is_set_m1(self):
        vehicle = load_vehicle("guo2021", overrides=["flange_law=piecewise_linear"])
        assert {name: vehicle.values[name] for name in M1 if name in vehicle.values} == {
            name: value for name, value in M1.items() if name in vehicle.values
        }


class Expanded:
    """A polynomial or spline given only by its Taylor coefficients."""

    def __init__(self, derivatives):
        self.derivatives = derivatives

    def taylor(self, y, order):
        terms = [self.derivatives(np.asarray(y), k) / math.factorial(k) for k in range(order + 1)]
        return np.stack(terms, axis=-1)


def expanded_polynomial(*coefficients):
    f = Polynomial(coefficients)
    return Expanded(lambda y, k: f.deriv(k)(y) if k else f(y))


def expanded_sine(offset, slope, length):
    """offset + slope L sin(y/L), slope at 0 and wavelength 2 pi L."""

    def derivative(y, k):
        wave = slope * length * np.sin(y / length + k * np.pi / 2) / length**k
        return wave + (offset if k == 0 else 0.0)

    return Expanded(derivative)


@pytest.fixture(scope="module")
def polynomials_expanded():
    q = M1
    return ExpandedGeometry.mirrored(
        dr=expanded_polynomial(0.0, q["a1"], q["a2"], q["a3"]),
        delta=expanded_polynomial(q["c0"], q["c1"], q["c2"], q["c3"]),
        rho=expanded_polynomial(q["e0"], q["e1"] + q["f1"], 0.0, q["e3"] + q["f3"]),
    )


class TestExpandedGeometry:
    def test_the_same_polynomials_through_their_taylor_series(self, polynomials_expanded):
        symbolic = hunting_system(reading())
        expanded = hunting_system(reading(), polynomials_expanded)
        rng = np.random.default_rng(3)
        X = rng.uniform(-1, 1, (20, 4)) * [4e-3, 4e-3, 0.2, 0.2]
        for x in X:
            np.testing.assert_allclose(expanded.rhs(x), symbolic.rhs(x), rtol=1e-10)
            np.testing.assert_allclose(
                expanded.jacobian(x), symbolic.jacobian(x), rtol=1e-9, atol=1e-9
            )
        for order in range(2, 6):
            v = rng.uniform(-1, 1, (order, 4))
            got, expected = expanded.form(X[0], None, *v), symbolic.form(X[0], None, *v)
            np.testing.assert_allclose(got, expected, rtol=1e-9, atol=1e-9 * np.abs(expected).max())

    def test_and_through_the_hopf_point(self, polynomials_expanded):
        (hopf,) = instabilities(hunting_system(reading(), polynomials_expanded), "v", (5.0, 200.0))
        assert hopf.value == pytest.approx(51.70606841, abs=5e-9)
        assert hopf.lyapunov == pytest.approx(-23.255255, abs=5e-7)

    def test_a_sine_goes_through_the_first_lyapunov_coefficient(self):
        """A sine's Taylor polynomial to third order has the same Hopf point and FLC."""
        length = 0.02
        q = M1
        waves = ExpandedGeometry.mirrored(
            dr=expanded_sine(0.0, q["a1"], length),
            delta=expanded_sine(q["c0"], q["c1"], length),
            rho=expanded_sine(q["e0"], q["e1"] + q["f1"], length),
        )
        cubic = -1 / (6 * length**2)
        matched = {
            "a3": q["a1"] * cubic, "c3": q["c1"] * cubic,
            "e3": (q["e1"] + q["f1"]) * cubic, "f3": 0.0,
        }  # fmt: skip
        sine = hopf_point(hunting_system(reading(), waves), "v", 50.0)
        polynomial = hopf_point(hunting_system(reading({}, matched)), "v", 50.0)
        assert sine.value == pytest.approx(polynomial.value, rel=1e-12)
        assert sine.lyapunov == pytest.approx(polynomial.lyapunov, rel=1e-10)

    def test_a_cubic_spline_of_samples(self):
        """A cubic spline through samples of the polynomials is the polynomials."""
        y, q = np.linspace(-0.012, 0.012, 25), M1

        def spline(*c):
            f = CubicSpline(y, Polynomial(c)(y))
            return Expanded(lambda at, k: f(at, k) if k <= 3 else np.zeros_like(at))

        geometry = ExpandedGeometry.mirrored(
            dr=spline(0.0, q["a1"], 0.0, q["a3"]),
            delta=spline(q["c0"], q["c1"], 0.0, q["c3"]),
            rho=spline(q["e0"], q["e1"] + q["f1"], 0.0, q["e3"] + q["f3"]),
        )
        hopf = hopf_point(hunting_system(reading(), geometry), "v", 50.0)
        assert hopf.value == pytest.approx(51.70606841, abs=1e-7)
        assert hopf.lyapunov == pytest.approx(-23.255255, rel=1e-4)

    def test_beyond_the_samples_is_a_named_outcome(self, polynomials_expanded):
        def short(f):
            return Expanded(lambda y, k: np.where(np.abs(y) < 5e-3, f.derivatives(y, k), np.nan))

        functions = dict(polynomials_expanded.functions)
        functions["delta_left"] = short(functions["delta_left"])
        system = hunting_system(reading(), ExpandedGeometry(functions))
        with pytest.raises(NotFinite, match="sampled function delta_left, outside its range at y"):
            system.rhs([6e-3, 0, 0, 0])

    def test_missing_functions_are_named(self):
        with pytest.raises(ValueError, match="lacks delta_left"):
            ExpandedGeometry({"dr_left": expanded_polynomial(0.0)})


def test_hopf_point_where_the_saturated_law_is_not_smooth():
    """Without creep at the centre the second derivatives do not exist: speed, no coefficient."""
    flat = {"mu": 0.3, "c0": 0.0, "radius_offset": 0.0}
    system = hunting_system(reading({"creep_law": "shen_hedrick_elkins"}, flat))
    (hopf,) = instabilities(system, "v", (20.0, 100.0))
    linear = hopf_point(hunting_system(reading({}, flat)), "v", 50.0)
    assert hopf.value == pytest.approx(linear.value, rel=1e-9)
    assert (hopf.kind, hopf.lyapunov) == ("H?", None)
    assert "not smooth at zero" in hopf.reason


def test_derivatives_by_parameters():
    """Compiled derivatives by parameters against the nilpotent ones."""
    system = hunting_system(reading({"flange_law": "exponential"}))
    names = ("v", "a1", "a3", "c1", "p0", "nu", "r0", "q1")
    _, by = system.evaluate(STATE, by=names)
    for i, name in enumerate(names):
        unit = np.eye(4 + len(system.parameter_names))[4 + system.index(name)]
        np.testing.assert_allclose(by[:, i], system.form(STATE, None, unit), rtol=1e-11, atol=1e-15)


def test_only_parameters_that_act_are_parameters():
    assert "mu" not in hunting_system(reading()).parameter_names
    assert "k0" not in hunting_system(reading({"flange_law": "quintic"})).parameter_names


def test_printed_equations_are_the_computed_ones():
    """The general form with s, written for each wheel, is what is evaluated."""
    from wheelset.vehicle.equations import equations_of_motion
    from wheelset.vehicle.options import ModelOptions
    from wheelset.vehicle.quantities import on_side

    equations = equations_of_motion(ModelOptions())
    computed = dict(equations.assignments)
    s = sp.Symbol("s", real=True)
    for equation in equations.wheel:
        wheel_symbols = {e.symbol for e in (*equations.geometry, *equations.wheel)}
        for side, sign in (("left", 1), ("right", -1)):
            renamed = {q: on_side(q, side) for q in wheel_symbols}
            written = equation.expression.xreplace({**renamed, s: sp.Integer(sign)})
            assert computed[on_side(equation.symbol, side)] == written


def test_gravity_stiffness_is_restoring_in_the_physical_reading_only():
    for sign, direction in (("physical", -1), ("reversed", 1)):
        system = hunting_system(reading({"contact_angle_sign": sign}))
        out = system.quantities(["Fyn_left", "Fyn_right"], y=1e-3)
        assert np.sign(out["Fyn_left"] + out["Fyn_right"]) == direction
