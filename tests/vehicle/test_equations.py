"""The equations of motion: independent model, symmetries, limits, domain."""

from __future__ import annotations

import math
import types
from itertools import product

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests import independent_model
from tests.vehicle.readings import M1, OPTIONS, reading
from wheelset.bifurcation.outcomes import DomainLeft, NumericalOutcome
from wheelset.hunting import hunting_system
from wheelset.vehicle.flange import FLANGE_LAWS, flange_force
from wheelset.vehicle.options import ModelOptions, allowed_values
from wheelset.vehicle.parameters import BY_NAME

SCALE = np.array([4e-3, 4e-3, 0.2, 0.2])
ASYMMETRIC = {
    "a2": 1.5, "c2": 20.0, "e2": 900.0, "f2": -400.0, "Cpx": 2e3, "Cpy": 3e3,
    "da0": 1e-4, "da1": 0.01, "da2": 0.3, "da3": 40.0, "dc0": 2e-3, "dc1": 0.5, "dc2": -4.0,
    "dc3": 500.0, "dh0": 0.4, "dh1": 12.0, "dh2": -300.0, "dh3": 1e4,
}  # fmt: skip
READINGS = {
    "reversed, linear": ({}, {}),
    "physical, exponential flange": (
        {"contact_angle_sign": "physical", "flange_law": "exponential"}, {},
    ),
    "M2's choices, quintic flange twice": (
        {"lateral_creepage_cosine": "omitted", "flange_law": "quintic", "flange_wheels": 2},
        {"spin_cosine_exponent": -0.473896},
    ),
    "constant normal force, full curvature": (
        {"normal_force": "constant", "transverse_curvature": "full"}, {},
    ),
    "shape factor outside, spin moment turned round": (
        {"shape_exponent": "outside", "lateral_spin_moment": "minus", "spin_moment": "fit"}, {},
    ),
    "saturated, spin moment, reciprocal": (
        {"creep_law": "shen_hedrick_elkins", "spin_moment": "fit", "flange_law": "reciprocal"},
        {"mu": 0.3},
    ),
    "asymmetric, damped": ({"contact_angle_sign": "physical"}, ASYMMETRIC),
}  # fmt: skip


def random_states(count, seed=20210403):
    return np.random.default_rng(seed).uniform(-1, 1, (count, 4)) * SCALE


def independent(vehicle, v=50.0):
    options = vehicle.options.model_dump()
    values = {name: mp.mpf(value) for name, value in vehicle.values.items()}
    return lambda x: independent_model.derivative(x, mp.mpf(v), values, options)


class TestIndependentModel:
    @pytest.mark.parametrize("name", READINGS)
    def test_right_hand_side_at_100_states(self, name):
        vehicle = reading(*READINGS[name])
        system, other = hunting_system(vehicle), independent(vehicle)
        X = random_states(100)
        expected = np.array([[float(f) for f in other([mp.mpf(xi) for xi in x])] for x in X])
        scale = np.abs(expected).max(axis=0)
        np.testing.assert_allclose(system.rhs(X) / scale, expected / scale, atol=1e-12)

    @pytest.mark.parametrize("name", READINGS)
    def test_jacobian_at_100_states(self, name):
        vehicle = reading(*READINGS[name])
        other = independent(vehicle)
        X = random_states(100 if name == "reversed, linear" else 10)
        J = hunting_system(vehicle).jacobian(X)
        for x, jacobian in zip(X, J, strict=True):
            expected = np.transpose([form(other, x, e) for e in np.eye(4)])
            weight = np.outer(1 / np.abs(expected).max(axis=1), np.ones(4))
            np.testing.assert_allclose(jacobian * weight, expected * weight, atol=1e-11)

    @pytest.mark.parametrize("order", [2, 3, 4, 5])
    @pytest.mark.parametrize("name", ["reversed, linear", "asymmetric, damped"])
    def test_multilinear_forms_at_100_states(self, name, order):
        vehicle = reading(*READINGS[name])
        system, other = hunting_system(vehicle), independent(vehicle)
        rng = np.random.default_rng(order)
        for x in random_states(100 if name == "reversed, linear" else 10):
            directions = rng.uniform(-1, 1, (order, 4)) * SCALE
            expected = form(other, x, *directions)
            weight = np.abs(expected).max()
            got = system.form(x, None, *directions)
            np.testing.assert_allclose(got / weight, expected / weight, atol=1e-10)

    @pytest.mark.parametrize("order", [2, 3, 5])
    def test_forms_of_the_saturated_law(self, order):
        vehicle = reading(*READINGS["saturated, spin moment, reciprocal"])
        system, other = hunting_system(vehicle), independent(vehicle)
        rng = np.random.default_rng(order)
        for x in random_states(5):
            directions = rng.uniform(-1, 1, (order, 4)) * SCALE
            expected = form(other, x, *directions)
            weight = np.abs(expected).max()
            np.testing.assert_allclose(
                system.form(x, None, *directions) / weight, expected / weight, atol=1e-9
            )


def form(field, x, *directions):
    result = independent_model.multilinear_form(field, list(x), *directions, digits=40)
    return np.array([float(value) for value in result])


class TestSymmetry:
    @pytest.mark.parametrize("law", list(FLANGE_LAWS))
    def test_alike_wheels_make_the_field_odd(self, law):
        """Even coefficients alike on both wheels included: the mirror image is still a solution."""
        even = {"a2": 1.5, "c2": 20.0, "e2": 900.0, "f2": -400.0}
        system = hunting_system(reading({"flange_law": law}, even))
        X = random_states(50) * np.array([2.5, 1, 1, 1])  # up to 10 mm: past the flange clearance
        np.testing.assert_allclose(system.rhs(-X), -system.rhs(X), atol=1e-9)

    @pytest.mark.parametrize("name", [n for n in ASYMMETRIC if n.startswith("d")])
    def test_every_difference_of_the_wheels_breaks_it(self, name):
        system = hunting_system(reading({}, {name: ASYMMETRIC[name]}))
        x = np.array([3e-3, 2e-3, 0.05, -0.03])
        assert np.abs(system.rhs(-x) + system.rhs(x)).max() > 1e-8

    @pytest.mark.parametrize(
        "quantity", ["N", "Fx", "Fy", "Mz", "Fyn", "xi_x", "xi_y", "xi_s", "r"]
    )
    def test_left_wheel_is_the_mirror_image_of_the_right(self, quantity):
        """Under (y, psi) -> -(y, psi): vertical and longitudinal quantities keep their sign."""
        system = hunting_system(
            reading({"contact_angle_sign": "physical"}, {"a2": 1.5, "e2": 900.0})
        )
        x = dict(zip(("y", "psi", "yd", "psid"), (3e-3, 2e-3, 0.05, -0.03), strict=True))
        mirrored = {name: -value for name, value in x.items()}
        left = system.quantities([f"{quantity}_left"], **x)[f"{quantity}_left"]
        right = system.quantities([f"{quantity}_right"], **mirrored)[f"{quantity}_right"]
        sign = 1 if quantity in ("N", "Fx", "xi_x", "r") else -1
        assert left == pytest.approx(sign * right, rel=1e-13)


class TestLimits:
    def test_conical_wheel_gives_klingels_wavelength(self):
        """No mass forces, no suspension, no gravity stiffness: L = 2 pi sqrt(b r0 / a1)."""
        gone = [
            "a3",
            "c0",
            "c1",
            "c3",
            "e1",
            "e3",
            "f1",
            "f3",
            "radius_offset",
            "Kpx",
            "Kpy",
            "f23_factor",
        ]
        # Creep forces fall with the load to 2/3, gravity with the load: a small one leaves rolling.
        light = {**dict.fromkeys(gone, 0.0), "mw": 1e-6, "Iwz": 1e-6, "p0": 1e-3}
        system = hunting_system(reading({"contact_angle_sign": "physical"}, light))
        loci = np.linalg.eigvals(system.jacobian(np.zeros(4), system.p(v=1.0)))
        slow = loci[np.argsort(np.abs(loci))[:2]]
        wavelength = 2 * math.pi * 1.0 / abs(slow[0].imag)
        q = {**M1, **light}
        klingel = 2 * math.pi * math.sqrt(q["b"] * q["r0"] / q["a1"])
        assert wavelength == pytest.approx(klingel, rel=1e-4)

    def test_zero_creep_gives_zero_force(self):
        """Rolling without sliding: psi = yd/v, psid = -v dr/(r0 b), no spin."""
        flat = dict.fromkeys(("a3", "c0", "c1", "c3", "radius_offset", "a1"), 0.0)
        system = hunting_system(reading({}, flat))
        forces = system.quantities(
            [f"{f}_{side}" for f, side in product(("Fx", "Fy", "Mz"), ("left", "right"))],
            y=2e-3, psi=0.05 / 50.0, yd=0.05, psid=0.0, v=50.0,
        )  # fmt: skip
        assert all(abs(f) < 1e-9 for f in forces.values())

    def test_undamped_suspension_conserves_energy_at_its_rate(self):
        """m yd ydd + I psid psidd = work of contact and flange - d/dt of the spring energy."""
        system = hunting_system(reading({"flange_law": "exponential"}, {}))
        q = M1
        for y, psi, yd, psid in random_states(20):
            names = ["dyd/dt", "dpsid/dt", "Fyc", "Mzc", "Ft"]
            out = system.quantities(names, y=y, psi=psi, yd=yd, psid=psid)
            kinetic = q["mw"] * yd * out["dyd/dt"] + q["Iwz"] * psid * out["dpsid/dt"]
            spring = 2 * q["Kpy"] * y * yd + 2 * q["wp"] ** 2 * q["Kpx"] * psi * psid
            contact = (out["Fyc"] + out["Ft"]) * yd + out["Mzc"] * psid
            assert kinetic == pytest.approx(contact - spring, rel=1e-10)

    def test_large_creep_saturates_at_friction(self):
        system = hunting_system(reading({"creep_law": "shen_hedrick_elkins"}, {"mu": 0.3}))
        names = ["Fx_left", "Fy_left", "N_left"]
        out = system.quantities(names, y=1e-3, yd=5.0, v=5.0)
        assert math.hypot(out["Fx_left"], out["Fy_left"]) == pytest.approx(
            0.3 * out["N_left"], rel=1e-12
        )

    @pytest.mark.parametrize("mu", [1e6, 1e8])
    def test_high_friction_tends_to_kalker(self, mu):
        saturated = hunting_system(reading({"creep_law": "shen_hedrick_elkins"}, {"mu": mu}))
        linear = hunting_system(reading())
        X = random_states(20)
        difference = np.abs(saturated.rhs(X) - linear.rhs(X)).max()
        assert 0 < difference < 3e3 / mu * np.abs(linear.rhs(X)).max()

    @settings(max_examples=100, deadline=None)
    @given(st.floats(-0.5, 0.5), st.floats(-0.05, 0.05))
    def test_creep_force_never_exceeds_friction(self, yd, psi):
        system = hunting_system(reading({"creep_law": "shen_hedrick_elkins"}, {"mu": 0.2}))
        out = system.quantities(["Fx_right", "Fy_right", "N_right"], yd=yd, psi=psi, v=20.0)
        assert math.hypot(out["Fx_right"], out["Fy_right"]) <= 0.2 * out["N_right"] * (1 + 1e-12)


class TestFlangeLaws:
    """Over the registry: a new law is tested by being appended to it."""

    ETA, OUTSIDE = M1["eta"], np.linspace(M1["eta"] + 1e-4, 0.0111, 50)

    def force(self, law, y):
        return flange_force(law, y, M1)

    def test_registry_options_and_coefficients_name_the_same_laws(self):
        assert set(allowed_values("flange_law")) == set(FLANGE_LAWS)
        for law in FLANGE_LAWS.values():
            for name in law.parameters:
                assert BY_NAME[name].needed_by == ("flange_law", law.name)

    @pytest.mark.parametrize("law", FLANGE_LAWS.values(), ids=str)
    def test_odd(self, law):
        y = np.linspace(-0.011, 0.011, 101)
        np.testing.assert_allclose(self.force(law, -y), -self.force(law, y), rtol=1e-12, atol=1e-20)

    @pytest.mark.parametrize("law", [w for n, w in FLANGE_LAWS.items() if n != "none"], ids=str)
    def test_restoring_beyond_its_clearance(self, law):
        start = float(
            law.restoring_from.subs({s: M1[s.name] for s in law.restoring_from.free_symbols})
        )
        y = np.linspace(start + 1e-5, max(start + 1e-3, 0.0111), 50)
        assert (self.force(law, y) < 0).all()
        assert (np.diff(self.force(law, y)) < 0).all()

    def test_quintic_pushes_outward_below_10_mm_as_the_paper_says(self):
        quintic = FLANGE_LAWS["quintic"]
        assert (self.force(quintic, np.linspace(1e-4, 0.0099, 50)) > 0).all()
        assert self.force(quintic, np.array([0.010])) == pytest.approx(0.0, abs=1e-6)

    def test_piecewise_and_exponential_agree_at_11_mm(self):
        at = np.array([0.011])
        assert self.force(FLANGE_LAWS["piecewise_linear"], at) == pytest.approx(-28.6e3, rel=2e-3)
        assert self.force(FLANGE_LAWS["exponential"], at) == pytest.approx(-28.2e3, rel=2e-3)

    def test_reciprocal_stiffness_at_the_centre(self):
        h = 1e-7
        slope = self.force(FLANGE_LAWS["reciprocal"], np.array([h]))[0] / h
        assert slope == pytest.approx(-1.59e4, rel=5e-3)

    @pytest.mark.parametrize("law", FLANGE_LAWS.values(), ids=str)
    def test_the_model_uses_the_same_force(self, law):
        y = np.linspace(-0.011, 0.011, 23)
        system = hunting_system(reading({"flange_law": law.name, "flange_wheels": 2}))
        out = system.quantities(["Ft"], y=y)["Ft"]
        np.testing.assert_allclose(out, 2 * self.force(law, y), rtol=1e-12, atol=1e-9)


class TestDomain:
    def test_curvature_sum_names_wheel_and_displacement(self):
        system = hunting_system(reading())
        with pytest.raises(DomainLeft) as left:
            system.rhs([0.0118, 0, 0, 0])
        assert left.value.where == "right wheel"
        assert "sum of curvatures" in left.value.quantity
        assert left.value.state[0] == 0.0118

    def test_bound_of_m1_is_11_65_mm(self):
        """The spec: positivity of the curvature sum bounds |y| to 11.65 mm."""
        system = hunting_system(reading())
        system.rhs([0.01164, 0, 0, 0])
        with pytest.raises(DomainLeft):
            system.rhs([0.01166, 0, 0, 0])

    def test_reciprocal_pole(self):
        system = hunting_system(reading({"flange_law": "reciprocal"}))
        with pytest.raises(DomainLeft, match="pole of the reciprocal flange law at y = -q2"):
            system.rhs([-0.01125, 0, 0, 0])

    def test_rolling_radius(self):
        flat = {"e1": 0.0, "e3": 0.0, "f1": 0.0, "f3": 0.0, "a3": 0.0, "c1": 0.0, "c3": 0.0}
        system = hunting_system(reading({}, flat))
        with pytest.raises(DomainLeft, match="rolling radius"):
            system.rhs([2.1, 0, 0, 0])

    def test_contact_slope_near_a_right_angle(self):
        system = hunting_system(reading({}, {"c0": 1.55}))
        with pytest.raises(DomainLeft, match="cosine of the contact slope"):
            system.rhs([5e-3, 0, 0, 0])

    def test_speed_has_to_be_positive(self):
        system = hunting_system(reading())
        with pytest.raises(DomainLeft, match="speed"):
            system.rhs(np.zeros(4), system.p(v=0.0))

    def test_saturated_law_is_not_smooth_without_creep(self):
        flat = {"mu": 0.3, "c0": 0.0, "radius_offset": 0.0}
        system = hunting_system(reading({"creep_law": "shen_hedrick_elkins"}, flat))
        assert np.isfinite(system.jacobian(np.zeros(4))).all()
        with pytest.raises(DomainLeft, match="not smooth at zero"):
            system.form(np.zeros(4), None, np.ones(4), np.ones(4))


FINITE = st.floats(-1.0, 1.0)


@settings(max_examples=1500, deadline=None)
@given(
    x=st.tuples(FINITE, FINITE, FINITE, FINITE),
    speed=st.floats(-5.0, 400.0),
    factors=st.fixed_dictionaries(
        {n: st.floats(-3.0, 3.0) for n in ("a1", "a3", "c0", "c1", "c3", "e0", "e1", "f3", "p0")}
    ),
    options=st.sampled_from(list(READINGS)),
)
def test_a_number_or_a_named_outcome(x, speed, factors, options):
    """Thousands of states and parameter sets, most of them absurd: never a NaN."""
    system = SYSTEMS[options]
    values = {name: M1[name] * factor for name, factor in factors.items()}
    p = system.p(v=speed, **values)
    said = ""
    try:
        f, jacobian = system.evaluate(np.array(x) * [0.03, 0.5, 5.0, 5.0], p)
    except NumericalOutcome as outcome:
        said = str(outcome)
    else:
        assert np.isfinite(f).all()
        assert np.isfinite(jacobian).all()
    assert not said or ("y = " in said and said.startswith(("domain left", "not finite")))


SYSTEMS = {name: hunting_system(reading(*choice)) for name, choice in READINGS.items()}


def test_options_are_the_only_structural_choices():
    assert set(OPTIONS) == set(ModelOptions.model_fields)
    assert isinstance(reading(), types.SimpleNamespace)
