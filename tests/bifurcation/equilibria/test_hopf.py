"""Hopf points and first Lyapunov coefficients against closed forms and normal forms."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sp
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from tests.systems import (
    TOY,
    TOY_HOPF,
    closed_form_critical_speed,
    hopf_normal_form,
    toy_wheelset,
)
from wheelset.bifurcation.equilibria.equilibrium import eigenvalue_loci, equilibrium
from wheelset.bifurcation.equilibria.hopf import HopfPoint, StaticPoint, hopf_point, instabilities
from wheelset.bifurcation.equilibria.lyapunov import critical_pair
from wheelset.bifurcation.outcomes import NoConvergence
from wheelset.bifurcation.system import System


class TestToyWheelset:
    def test_hopf_point_to_ten_digits(self):
        (hopf,) = instabilities(toy_wheelset(), "v", (5.0, 500.0))
        assert hopf.value == pytest.approx(TOY_HOPF["v"], abs=1e-10)
        assert hopf.frequency == pytest.approx(TOY_HOPF["frequency"], abs=1e-10)

    def test_first_lyapunov_coefficient_at_a3_100(self):
        (hopf,) = instabilities(toy_wheelset(100.0), "v", (5.0, 500.0))
        assert hopf.lyapunov == pytest.approx(TOY_HOPF["flc_at_a3_100"], rel=1e-9)
        assert hopf.kind == "H+"

    @pytest.mark.parametrize("a3", [-300.0, 0.0, 1000.0])
    def test_hopf_point_does_not_depend_on_a3(self, a3):
        assert hopf_point(toy_wheelset(a3), "v", 45.0).value == pytest.approx(
            TOY_HOPF["v"], abs=1e-10
        )

    def test_closed_form_with_the_flange_stiffness(self):
        v, w = closed_form_critical_speed(TOY, flange_stiffness=2 * TOY["p1"] * TOY["q"])
        hopf = hopf_point(toy_wheelset(), "v", 45.0)
        assert hopf.value == pytest.approx(v, rel=1e-12)
        assert hopf.frequency == pytest.approx(w, rel=1e-12)

    @settings(max_examples=200, deadline=None)
    @given(
        scale=st.fixed_dictionaries(
            {name: st.floats(0.3, 3.0) for name in ("m", "I", "Ky", "Kx", "f11", "f22", "a1", "b")}
        )
    )
    def test_closed_form_over_parameter_sets(self, scale):
        values = {**TOY, **{name: TOY[name] * s for name, s in scale.items()}, "p1": 0.0}
        v, w = closed_form_critical_speed(values)
        assume(v > 0)
        system = toy_wheelset().with_values(**values)
        found = instabilities(system, "v", (0.7 * v, 1.4 * v))
        assert [p.value for p in found] == [pytest.approx(v, rel=1e-9)]
        assert found[0].frequency == pytest.approx(w, rel=1e-9)

    def test_window_without_a_hopf_point(self):
        assert instabilities(toy_wheelset(), "v", (5.0, 45.0)) == ()

    def test_hopf_in_another_parameter(self):
        system = toy_wheelset(v=TOY_HOPF["v"])
        (hopf,) = instabilities(system, "a1", (0.1, 0.5))
        assert hopf.value == pytest.approx(0.23, abs=1e-11)


class TestNormalForms:
    @pytest.mark.parametrize(("a", "b"), [(-1.0, 0.5), (2.0, -3.0)])
    def test_lyapunov_coefficient_of_the_hopf_normal_form(self, a, b):
        """x = z q + conj with |q| = 1 makes r = sqrt(2) |z|: r' = a r^3 becomes FLC = 2 a."""
        (hopf,) = instabilities(hopf_normal_form(a=a, b=b), "mu", (-1.0, 1.5))
        assert hopf.value == pytest.approx(0.0, abs=1e-12)
        assert hopf.frequency == pytest.approx(2.0, rel=1e-12)
        assert hopf.lyapunov == pytest.approx(2 * a, rel=1e-12)

    def test_quadratic_terms_enter_the_coefficient(self):
        """B(q,h11) and B(q-,h20) against the formula for planar fields in real coordinates."""
        rng = np.random.default_rng(5)
        c = dict(zip([f"c{i}" for i in range(14)], rng.normal(size=14), strict=True))
        w = 1.7

        def f(x, p):
            (u, v), (mu, *k) = x, p
            quadratic = [
                k[0] * u**2 + k[1] * u * v + k[2] * v**2,
                k[3] * u**2 + k[4] * u * v + k[5] * v**2,
            ]
            cubic = [
                k[6] * u**3 + k[7] * u**2 * v + k[8] * u * v**2 + k[9] * v**3,
                k[10] * u**3 + k[11] * u**2 * v + k[12] * u * v**2 + k[13] * v**3,
            ]
            return [
                mu * u - w * v + quadratic[0] + cubic[0],
                w * u + mu * v + quadratic[1] + cubic[1],
            ]

        system = System.from_function(f, ("u", "v"), {"mu": 0.0, **c})
        hopf = hopf_point(system, "mu", 0.01)
        assert hopf.lyapunov == pytest.approx(guckenheimer_holmes(f, c, w), rel=1e-10)

    def test_every_crossing_in_the_window_and_its_direction(self):
        """Real part (mu - 1)(mu - 2)(3 - mu): stability is lost, gained and lost."""

        def f(x, p):
            real = -(p[0] - 1) * (p[0] - 2) * (p[0] - 3)
            r2 = x[0] ** 2 + x[1] ** 2
            return [-real * x[0] - 5 * x[1] - x[0] * r2, 5 * x[0] - real * x[1] - x[1] * r2]

        points = instabilities(System.from_function(f, ("x", "y"), {"mu": 0.0}), "mu", (0.0, 4.0))
        assert [p.value for p in points] == [pytest.approx(m, abs=1e-11) for m in (1, 2, 3)]
        assert [p.unstable for p in points] == [(2, 0), (0, 2), (2, 0)] or [
            p.unstable for p in points
        ] == [(0, 2), (2, 0), (0, 2)]

    def test_static_divergence_is_told_apart(self):
        system = System.from_function(
            lambda x, p: [x[1], p[0] * x[0] - x[1] - x[0] ** 3], ("x", "xd"), {"mu": -1.0}
        )
        (point,) = instabilities(system, "mu", (-2.0, 1.0))
        assert isinstance(point, StaticPoint)
        assert point.value == pytest.approx(0.0, abs=1e-13)
        assert point.unstable == (0, 1)
        assert "static divergence" in point.words

    def test_neutral_saddle_is_no_instability(self):
        system = System.from_function(
            lambda x, p: [x[0] * (1 + p[0]), -x[1] + x[0] * x[1]], ("x", "y"), {"mu": 0.0}
        )
        assert instabilities(system, "mu", (-0.5, 0.5)) == ()

    def test_equilibrium_away_from_the_origin_is_followed(self):
        """The Brusselator: equilibrium (A, B/A), Hopf at B = 1 + A^2, w = A."""

        def f(x, p):
            (u, v), (a, b) = x, p
            return [a - (b + 1) * u + u**2 * v, b * u - u**2 * v]

        system = System.from_function(f, ("u", "v"), {"A": 1.5, "B": 2.0})
        (hopf,) = instabilities(system, "B", (2.0, 5.0), guess=[1.4, 1.5])
        assert hopf.value == pytest.approx(1 + 1.5**2, rel=1e-11)
        assert hopf.frequency == pytest.approx(1.5, rel=1e-11)
        np.testing.assert_allclose(hopf.state, [1.5, hopf.value / 1.5], rtol=1e-11)
        assert hopf.kind == "H-"


def guckenheimer_holmes(f, c, w):
    """2 a, where r' = a r^3 (Guckenheimer & Holmes, Eq. 3.4.11, for a field rotating by w)."""
    u, v = sp.symbols("u v")
    F, G = f((u, v), (0, *c.values()))

    def d(e, *by):
        return float(sp.diff(e, *by).subs({u: 0, v: 0}))

    a = d(F, u, u, u) + d(F, u, v, v) + d(G, u, u, v) + d(G, v, v, v)
    a += (
        d(F, u, v) * (d(F, u, u) + d(F, v, v))
        - d(G, u, v) * (d(G, u, u) + d(G, v, v))
        - d(F, u, u) * d(G, u, u)
        + d(F, v, v) * d(G, v, v)
    ) / w
    return a / 16 * 2


class TestFailures:
    def test_no_equilibrium_reports_the_residual_history(self):
        system = System.from_function(lambda x, p: [1 + x[0] ** 2 + p[0]], ("x",), {"c": 0.0})
        with pytest.raises(NoConvergence, match="equilibrium") as failure:
            equilibrium(system, system.p(), [0.7])
        assert len(failure.value.residuals) > 1

    def test_singular_jacobian(self):
        system = System.from_function(lambda x, p: [p[0] + 0 * x[0]], ("x",), {"c": 1.0})
        with pytest.raises(NoConvergence, match="singular"):
            equilibrium(system, system.p())

    def test_no_oscillating_pair(self):
        system = System.from_function(lambda x, p: [-p[0] * x[0]], ("x",), {"c": 1.0})
        with pytest.raises(NoConvergence, match="no oscillating pair"):
            hopf_point(system, "c", 1.0)

    def test_a_pair_that_never_reaches_the_axis(self):
        damped = System.from_function(
            lambda x, p: [x[1], -p[0] * x[0] - x[1]], ("x", "xd"), {"stiffness": 4.0}
        )
        with pytest.raises(NoConvergence, match="Hopf point in stiffness near 4") as failure:
            hopf_point(damped, "stiffness", 4.0)
        assert failure.value.residuals[:2] == pytest.approx((0.5, 0.5))

    @pytest.mark.parametrize("window", [(2.0, 1.0), (1.0, float("nan")), (1.0, 1.0)])
    def test_bad_window(self, window):
        with pytest.raises(ValueError, match="needs two finite numbers"):
            instabilities(toy_wheelset(), "v", window)


def test_loci_are_continuous_and_cross_at_the_hopf_point():
    loci = eigenvalue_loci(toy_wheelset(), "v", np.linspace(30, 70, 81))
    assert np.abs(np.diff(loci.eigenvalues, axis=0)).max() < 20
    crossing = [c for c in loci.eigenvalues.T if c[0].real < 0 < c[-1].real]
    assert len(crossing) == 2
    at = np.interp(0.0, crossing[0].real, loci.values)
    assert at == pytest.approx(TOY_HOPF["v"], abs=0.02)


def test_adjoint_is_an_eigenvector_of_the_transpose():
    hopf = hopf_point(toy_wheelset(), "v", 50.0)
    A = toy_wheelset().jacobian(np.zeros(4), toy_wheelset().p(v=hopf.value))
    pair = critical_pair(A, hopf.frequency)
    scale = np.abs(A).max()
    np.testing.assert_allclose(A @ pair.q, 1j * hopf.frequency * pair.q, atol=1e-9 * scale)
    np.testing.assert_allclose(A.T @ pair.p, -1j * hopf.frequency * pair.p, atol=1e-9 * scale)
    assert np.vdot(pair.p, pair.q) == pytest.approx(1.0, rel=1e-12)
    assert np.linalg.norm(pair.q) == pytest.approx(1.0, rel=1e-12)


def test_words_name_what_happens():
    assert "subcritical" in hopf_point(toy_wheelset(), "v", 50.0).words
    assert isinstance(hopf_point(toy_wheelset(-500.0), "v", 50.0), HopfPoint)
    assert "supercritical" in hopf_point(toy_wheelset(-500.0), "v", 50.0).words
