"""Hopf curves that are known in closed form, and the points of codimension two on them."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
import sympy as sp

from tests.exact_systems import BogdanovTakens, HopfHopf, ZeroHopf, bautin
from tests.systems import TOY, TOY_HOPF, closed_form_critical_speed, toy_wheelset
from wheelset.bifurcation.curves.branch import Branch
from wheelset.bifurcation.curves.steps import StepControl
from wheelset.bifurcation.curves.zero_problem import SingularSystem
from wheelset.bifurcation.equilibria.hopf import hopf_point
from wheelset.bifurcation.equilibria.hopf_borders import borders_at, condition
from wheelset.bifurcation.equilibria.hopf_curve import gh_point, hopf_curve, hopf_problem
from wheelset.bifurcation.fields.field import Condition, VectorField
from wheelset.bifurcation.outcomes import NoConvergence
from wheelset.bifurcation.system import System

#: A located point is off by 1e-11 of a step, with what rounding makes of an eigenvalue beside it.
EXACT = 1e-9
TOY_A3, TOY_SLC = 0.0234438188506, -0.130504562189


def origin(n: int, frequency: float, **values: float):
    return np.zeros(n), frequency, values


class TestToyWheelset:
    system = toy_wheelset(100.0)
    hopf = (np.zeros(4), TOY_HOPF["frequency"], {"v": TOY_HOPF["v"]})

    @pytest.mark.parametrize(
        ("other", "window"), [("a1", (0.05, 0.9)), ("Kx", (1e4, 3e6)), ("wp", (0.5, 2.0))]
    )
    def test_speed_and_frequency_along_the_curve(self, other, window):
        """Against the closed form, with the flange's stiffness in it."""
        branch = hopf_curve(self.system, self.hopf, ("v", other), {"v": (5, 300), other: window})
        assert {branch.began.kind, branch.ended.kind} == {"window"}
        assert len(branch) > 15
        for point in branch.points:
            v, w = closed_form_critical_speed(
                {**TOY, other: point.values[1]}, 2 * TOY["p1"] * TOY["q"]
            )
            assert point.values[0] == pytest.approx(v, rel=1e-11)
            assert point.solution.frequency == pytest.approx(w, rel=1e-11)

    def test_first_lyapunov_coefficient_along_the_curve(self):
        """As each point by itself has it."""
        windows = {"v": (5, 300), "a1": (0.1, 0.5)}
        branch = hopf_curve(self.system, self.hopf, ("v", "a1"), windows)
        for point in branch.points[::5]:
            v, a1 = point.values
            alone = hopf_point(self.system.with_values(a1=a1), "v", v)
            assert point.solution.lyapunov == pytest.approx(alone.lyapunov, rel=1e-8)
            assert point.solution.unstable == 0

    def test_generalized_hopf_point(self):
        windows = {"v": (10, 100), "a3": (-200.0, 300.0)}
        branch = hopf_curve(self.system, self.hopf, ("v", "a3"), windows)
        (gh,) = branch.special
        assert gh.kind == "GH"
        np.testing.assert_allclose(gh.values, [TOY_HOPF["v"], TOY_A3], rtol=1e-10)
        assert gh.coefficients["SLC"] == pytest.approx(TOY_SLC, rel=1e-9)
        assert "outer cycles are stable" in gh.words

    def test_newton_to_the_generalized_hopf_point(self):
        hopf = hopf_point(self.system, "v", 45.0)
        gh = gh_point(self.system, ("v", "a3"), hopf)
        np.testing.assert_allclose(gh.values, [TOY_HOPF["v"], TOY_A3], rtol=1e-11)
        assert gh.frequency == pytest.approx(TOY_HOPF["frequency"], rel=1e-12)
        assert abs(gh.lyapunov) < 1e-11
        assert gh.second_lyapunov == pytest.approx(TOY_SLC, rel=1e-10)

    def test_the_table(self):
        windows = {"v": (10, 100), "a3": (-200.0, 300.0)}
        branch = hopf_curve(self.system, self.hopf, ("v", "a3"), windows, steps=5)
        table = branch.table()
        assert list(table.columns) == ["v", "a3", "frequency", "FLC", "unstable", "point"]
        assert list(branch.table(["psi", "k"]).columns)[2:4] == ["psi", "k"]
        with pytest.raises(ValueError, match="unknown measure 'T'; there are frequency, FLC, k, y"):
            branch.table(["T"])


def test_bautin():
    """The Hopf curve b1 = 0, FLC = 2 b2 along it, GH at the origin with SLC = -4."""
    exact = bautin(b1=0.3, b2=0.5)
    branch = hopf_curve(
        exact.system, origin(2, 1.9, b1=0.1), ("b1", "b2"), {"b1": (-1, 1), "b2": (-1, 1)}
    )
    for point in branch.points:
        assert point.values[0] == pytest.approx(0.0, abs=1e-13)
        assert point.solution.lyapunov == pytest.approx(2 * point.values[1], abs=1e-12)
        assert point.solution.frequency == pytest.approx(exact.w, rel=1e-12)
    (gh,) = branch.special
    np.testing.assert_allclose(gh.values, 0.0, atol=EXACT)
    assert gh.coefficients == {"frequency": pytest.approx(2), "SLC": pytest.approx(-4, rel=EXACT)}
    found = gh_point(exact.system, ("b1", "b2"), origin(2, 2.0, b1=0.0))
    np.testing.assert_allclose(found.values, 0.0, atol=1e-14)


@cache
def through_takens() -> Branch:
    system = BogdanovTakens(b1=0.0, b2=-1.0).system
    return hopf_curve(system, origin(2, 1.0), ("b1", "b2"), {"b1": (-1, 1), "b2": (-2, 1.5)})


class TestBogdanovTakens:
    def test_it_is_passed_and_named(self):
        (bt,) = through_takens().special
        assert bt.kind == "BT"
        np.testing.assert_allclose(bt.u, 0.0, atol=EXACT)
        assert "goes on as neutral saddles" in bt.words

    def test_the_curve_is_straight_through_it(self):
        """b1 = 0 and k = -b2, frequencies and eigenvalues +-a alike."""
        branch = through_takens()
        for point in branch.points:
            (b1, b2), solution = point.values, point.solution
            assert b1 == pytest.approx(0.0, abs=1e-13)
            assert solution.k == pytest.approx(-b2, abs=1e-12)
            assert solution.kind == ("Hopf" if b2 < 0 else "neutral saddle")
        assert sorted({branch.began.kind, branch.ended.kind}) == ["window"]

    def test_first_lyapunov_coefficient_on_the_hopf_side(self):
        for point in through_takens().points:
            b2, solution = point.values[1], point.solution
            if b2 < 0:
                exact = BogdanovTakens(b2=b2).flc
                assert solution.lyapunov == pytest.approx(exact, rel=1e-9)
                assert solution.frequency == pytest.approx(math.sqrt(-b2), rel=1e-9)
            else:
                assert (solution.lyapunov, solution.reason) == (None, "no oscillating pair")
                assert math.isnan(solution.measure("FLC"))

    def test_the_condition_is_regular_there(self):
        """Borders at a nilpotent A, the derivative of g by (-k, trace) in the plane: det != 0."""
        A = np.array([[0.0, 1.0], [0.0, 0.0]])
        borders = borders_at(A, 0.0)
        step = 1e-6
        by_k = (condition(A, step, borders).g - condition(A, -step, borders).g) / (2 * step)
        turned = step * np.array([[0.0, 0.0], [0.0, 1.0]])
        by_trace = (condition(A + turned, 0, borders).g - condition(A - turned, 0, borders).g) / (
            2 * step
        )
        assert abs(np.linalg.det([by_k, by_trace])) > 0.1


class TestZeroHopf:
    def test_a_fold_meets_the_curve(self):
        """Hopf where b2 = x - x^2, x^2 = -b1: through the fold x = 0, with an exact parabola."""
        exact = ZeroHopf().at_hopf(0.3)
        start = (exact.equilibria()[1], exact.w, {"b1": exact.b1, "b2": exact.b2})
        branch = hopf_curve(exact.system, start, ("b1", "b2"), {"b1": (-0.5, 0.5), "b2": (-1, 1)})
        for point in branch.points:
            x, (b1, b2) = point.solution.state[2], point.values
            np.testing.assert_allclose([b1, b2], [-(x**2), x - x**2], atol=1e-13)
            assert point.solution.unstable == int(x > 1e-9)
        (zh,) = branch.of_kind("ZH")
        np.testing.assert_allclose(zh.u, [0, 0, 0, 0, 0, exact.w**2], atol=EXACT)
        assert zh.coefficients["frequency"] == pytest.approx(exact.w, rel=EXACT)

    def test_the_pole_of_the_coefficient_is_no_generalized_hopf_point(self):
        """FLC changes its sign through infinity at the zero-Hopf point."""
        exact = ZeroHopf().at_hopf(0.3)
        start = (exact.equilibria()[1], exact.w, {"b1": exact.b1, "b2": exact.b2})
        branch = hopf_curve(exact.system, start, ("b1", "b2"), {"b1": (-0.5, 0.5), "b2": (-1, 1)})
        flc = {np.sign(point.solution.lyapunov) for point in branch.points}
        assert flc == {-1.0, 1.0}
        located = [np.abs(point.solution.state[2]) for point in branch.of_kind("GH")]
        assert all(x > 1e-3 for x in located)

    @pytest.mark.parametrize("shift", [0.0, 0.0117])
    def test_where_nothing_couples_there_is_no_pole_and_no_generalized_hopf_point(self, shift):
        """z' = (p2 - 0.3) z - z^3 beside a Hopf pair: FLC = -2 throughout."""

        def f(s, p):
            x, y, z = s
            r2 = x**2 + y**2
            return [
                p[0] * x - 2 * y - r2 * x,
                2 * x + p[0] * y - r2 * y,
                (p[1] - sp.Rational(3, 10)) * z - z**3,
            ]

        system = System.from_function(f, ("x", "y", "z"), {"p1": 0.0, "p2": -0.5 + shift})
        branch = hopf_curve(system, origin(3, 2.0), ("p1", "p2"), {"p1": (-1, 1), "p2": (-1, 1)})
        assert [point.kind for point in branch.special] == ["ZH"]
        assert branch.special[0].values[1] == pytest.approx(0.3, abs=EXACT)
        assert len(branch.artefacts) == 1  # FLC times the eigenvalue, which is zero there


class TestHopfHopf:
    exact = HopfHopf(b1=0.0, b2=-0.5)
    windows = {"b1": (-1.0, 1.0), "b2": (-1.0, 1.0)}  # noqa: RUF012

    def test_each_curve_is_followed_through_the_other(self):
        for number, w in ((0, self.exact.w1), (1, self.exact.w2)):
            values = {"b1": -0.5, "b2": -0.5} | {f"b{number + 1}": 0.0}
            branch = hopf_curve(
                self.exact.system, origin(4, w, **values), ("b1", "b2"), self.windows
            )
            np.testing.assert_allclose(branch.values[:, number], 0.0, atol=1e-13)
            (hh,) = branch.special
            assert hh.kind == "HH"
            np.testing.assert_allclose(hh.values, 0.0, atol=EXACT)
            both = sorted([hh.coefficients["frequency"], hh.coefficients["second frequency"]])
            assert both == pytest.approx([0.7, 2.0], rel=EXACT)
            assert {point.solution.unstable for point in branch.points} == {0, 2}

    def test_a_neutral_saddle_beside_the_pair_is_an_artefact(self):
        def f(s, p):
            x, y, z, u = s
            r2 = x**2 + y**2
            pair = [p[0] * x - 2 * y - r2 * x, 2 * x + p[0] * y - r2 * y]
            return [*pair, (1 + p[1]) * z, -u]

        system = System.from_function(f, ("x", "y", "z", "u"), {"p1": 0.0, "p2": -0.4})
        branch = hopf_curve(system, origin(4, 2.0), ("p1", "p2"), {"p1": (-1, 1), "p2": (-0.5, 1)})
        assert branch.special == ()
        (artefact,) = branch.artefacts
        assert "neutral saddle beside the Hopf pair" in artefact.words
        assert artefact.values[1] == pytest.approx(0.0, abs=EXACT)

    def test_pairs_of_one_frequency_are_a_named_failure(self):
        """A^2 + k then has four null vectors, and the borders two."""
        A = np.kron(np.eye(2), np.array([[0.0, -1.0], [1.0, 0.0]]))
        with pytest.raises(SingularSystem, match="another pair has the same frequency"):
            condition(A, 1.0, borders_at(A, 1.0))


class TestProblem:
    def test_the_jacobian_is_exact(self):
        """Against central differences of the residual, whose error is 1e-10 of each column."""
        exact = ZeroHopf().at_hopf(0.3)
        start = (exact.equilibria()[1], exact.w, {"b1": exact.b1, "b2": exact.b2})
        problem, u = hopf_problem(exact.system, start, ("b1", "b2"))
        u = u + 0.01 * np.array([1.0, -0.4, 0.3, 0.2, -0.5, 2.0])
        J, h = problem.linearised(u).jacobian, 1e-6
        differences = [
            (problem.residual(u + h * e) - problem.residual(u - h * e)) / (2 * h) for e in np.eye(6)
        ]
        np.testing.assert_allclose(J, np.transpose(differences), atol=1e-8)

    def test_borders_do_not_move_the_curve(self):
        """Residuals vanish at the point whatever the borders, which a walk renews."""
        exact = BogdanovTakens(b1=0.0, b2=-0.7)
        problem, u = hopf_problem(exact.system, origin(2, exact.frequency), ("b1", "b2"))
        elsewhere, _ = hopf_problem(
            BogdanovTakens(b1=0.02, b2=-0.8, s=0.3).system, origin(2, 0.8), ("b1", "b2")
        )
        np.testing.assert_allclose(problem.residual(u), 0.0, atol=1e-15)
        other = replace(problem, borders=elsewhere.borders)
        np.testing.assert_allclose(other.residual(u), 0.0, atol=1e-15)


class TestFailures:
    system = bautin().system

    def test_a_coefficient_that_is_undefined_says_why(self):
        """The curve goes on; only the coefficient is missing."""
        x, y, mu, c, size = sp.symbols("x y mu c size", real=True)
        field = VectorField(
            (x, y), (mu, c), (mu * x - 2 * y - size * x, 2 * x + (mu + c) * y),
            ((size, x**2 + y**2),), (Condition(size, "radius squared", order=3, unit="m2"),),
        )  # fmt: skip
        system = System(field, {"mu": 0.0, "c": 0.0})
        windows = {"mu": (-0.5, 0.5), "c": (-1.0, 1.0)}
        branch = hopf_curve(system, origin(2, 2.0), ("mu", "c"), windows)
        assert branch.ended.kind == "window"
        for point in branch.points:
            assert point.solution.lyapunov is None
            assert "radius squared" in point.solution.reason
        with pytest.raises(NoConvergence, match="no first Lyapunov coefficient: domain left"):
            gh_point(system, ("mu", "c"), origin(2, 2.0))

    def test_no_generalized_hopf_point(self):
        """FLC = -2 everywhere: the history says so."""
        with pytest.raises(NoConvergence, match="generalized Hopf point in b1 and b2") as failure:
            gh_point(HopfHopf().system, ("b1", "b2"), origin(4, 2.0, b1=0.0, b2=-0.5))
        assert failure.value.residuals[:2] == pytest.approx((2, 2))

    def test_no_hopf_point_near(self):
        """x'' = -x + p1 + p2: frequency one, and no damping that a parameter could take away."""
        damped = System.from_function(
            lambda x, p: [x[1], p[0] + p[1] - x[0] - x[1]], ("x", "y"), {"p1": 0.0, "p2": 0.0}
        )
        with pytest.raises((NoConvergence, SingularSystem)):
            hopf_curve(damped, origin(2, 1.0), ("p1", "p2"))

    def test_the_window_may_be_left_at_the_start(self):
        branch = hopf_curve(self.system, origin(2, 2.0, b1=0.0), ("b1", "b2"), {"b2": (1.0, 2.0)})
        assert (len(branch), branch.ended.kind) == (1, "window")

    def test_a_walk_is_ended_by_its_steps(self):
        branch = hopf_curve(
            self.system, origin(2, 2.0, b1=0.0), ("b1", "b2"), steps=4, control=StepControl()
        )
        assert (len(branch), branch.began.kind, branch.ended.kind) == (9, "steps", "steps")

    @pytest.mark.parametrize(
        ("hopf", "parameters", "message"),
        [
            (origin(2, 2.0), ("b1", "b1"), "needs two different ones"),
            (origin(2, -2.0), ("b1", "b2"), r"frequency = -2.0 rad/s: has to be positive"),
            (origin(2, 2.0), ("b1", "c"), "unknown parameter 'c'"),
            (origin(2, 2.0, c=1.0), ("b1", "b2"), "unknown parameter 'c'"),
        ],
    )
    def test_bad_input_is_named(self, hopf, parameters, message):
        with pytest.raises(ValueError, match=message):
            hopf_curve(self.system, hopf, parameters)
