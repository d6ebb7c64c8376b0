"""The continuer on curves in the plane that are known exactly, and every way a walk can end."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from types import SimpleNamespace

import numpy as np
import pytest

from tests.exact_systems import cusp
from wheelset.bifurcation.curves import continuation
from wheelset.bifurcation.curves.branch import Branch
from wheelset.bifurcation.curves.continuation import both_ways, extend, follow, resume
from wheelset.bifurcation.curves.locate import LOCATED
from wheelset.bifurcation.curves.steps import StepControl, cubic
from wheelset.bifurcation.curves.zero_problem import (
    DenseLinearisation,
    Finding,
    Point,
    Renewal,
    SingularSystem,
)
from wheelset.bifurcation.equilibria.equilibrium_problem import EquilibriumProblem
from wheelset.bifurcation.outcomes import DomainLeft, NoConvergence, NotFinite

Value = Callable[[float, float], tuple[float, float, float]]  # F, dF/dx, dF/dp


def circle(x, p):
    return x * x + p * p - 1, 2 * x, 2 * p


def line(x, p):
    return x - p / 2, 1.0, -0.5


def parabola(x, p):
    return x * x - p, 2 * x, -1.0


@dataclass(frozen=True)
class Plane:
    """F(x, p) = 0 with u = (x, p) / unit; ``unit`` changes at every renewal if ``units`` say so."""

    F: Value
    watched: Mapping[str, Callable[[float, float], float]] = field(default_factory=dict)
    last: float = math.inf
    unit: float = 1.0
    units: tuple[float, ...] = ()
    finding: Callable[[str], Finding] = lambda test: Finding(test, "found")
    branching: bool = False

    parameters = ("p",)

    @property
    def metric(self):
        return np.full(2, self.unit**2)

    def values(self, u):
        return u[1:] * self.unit

    def residual(self, u):
        return self.linearised(u).residual

    def linearised(self, u):
        F, Fx, Fp = self.F(*(u * self.unit))
        return DenseLinearisation(np.array([F]), np.array([[Fx, Fp]]) * self.unit)

    def renewed(self, point):
        if not self.units:
            return Renewal(self)
        following = self.units[(self.units.index(self.unit) + 1) % len(self.units)]
        return Renewal(replace(self, unit=following), lambda v: v * self.unit / following)

    def tests(self, point):
        found = {name: f(*(point.u * self.unit)) for name, f in self.watched.items()}
        return found | {"BP": point.determinant} if self.branching else found

    def classify(self, test, point):
        return self.finding(test)

    def solution(self, point):
        x, p = point.u * self.unit
        return SimpleNamespace(x=x, p=p, measures=("x",), measure=lambda name: x, unstable=0)

    def ended(self, point):
        p = point.u[1] * self.unit
        return f"far enough: p = {p:.3f}" if p > self.last else ""


def places(branch: Branch) -> np.ndarray:
    return np.array([(point.solution.x, point.solution.p) for point in branch.points])


class TestTheCurve:
    def test_every_point_lies_on_it(self):
        """Corrections of 1e-7 or less, squared by the last Newton step."""
        branch = follow(Plane(circle), [1.0, 0.0], steps=30)
        assert np.abs(np.hypot(*places(branch).T) - 1).max() < 1e-13

    def test_tangents_have_length_one_and_keep_their_sense(self):
        branch = follow(Plane(circle), [1.0, 0.0], steps=30)
        across = places(branch)
        along = np.array([point.tangent for point in branch.points])
        np.testing.assert_allclose((along * across).sum(axis=1), 0.0, atol=1e-7)
        turning = along[:, 1] * across[:, 0] - along[:, 0] * across[:, 1]
        np.testing.assert_allclose(turning, 1.0, atol=1e-12)

    def test_arclength_of_a_circle(self):
        """A chord c stretched by its tangents is the arc to fifth order: h = 0.1, 63 steps."""
        branch = follow(Plane(circle), [1.0, 0.0])
        assert branch.points[-1].arclength == pytest.approx(2 * math.pi, abs=63 * 0.1**5)

    @pytest.mark.parametrize("direction", [1, -1])
    def test_direction_is_that_of_the_first_parameter(self, direction):
        branch = follow(Plane(line), [0.0, 0.0], direction=direction, steps=3)
        assert np.all(np.diff(places(branch)[:, 1]) * direction > 0)

    def test_direction_may_be_a_vector(self):
        branch = follow(Plane(circle), [0.0, 1.0], direction=[-1.0, 0.0], steps=3)
        assert np.all(np.diff(places(branch)[:, 0]) < 0)

    def test_both_ways_is_one_curve_in_one_sense(self):
        branch = both_ways(Plane(line), [0.0, 0.0], windows={"p": (-1.0, 2.0)})
        p, s = places(branch)[:, 1], [point.arclength for point in branch.points]
        assert (p[0], p[-1]) == (pytest.approx(-1, abs=1e-14), pytest.approx(2, abs=1e-14))
        assert np.all(np.diff(p) > 0)
        np.testing.assert_allclose(s, p * math.hypot(1, 0.5), atol=1e-13)
        assert all(point.tangent[1] > 0 for point in branch.points)

    def test_a_changing_mesh_changes_no_point(self):
        """Unknowns in other units after every step, the predictor's data carried along."""
        plain = follow(Plane(circle), [1.0, 0.0])
        other = follow(Plane(circle, unit=2.0, units=(2.0, 3.0, 0.5)), [0.5, 0.0])
        assert other.ended.kind == "closed"
        # the step aims at an error relative to 1 + |u|, the same in every unit
        np.testing.assert_allclose(places(other), places(plain), atol=1e-9)


class TestSteps:
    def test_cubic_through_a_circle_is_of_fourth_order(self):
        def error(h: float) -> float:
            def at(s: float) -> tuple[np.ndarray, np.ndarray]:
                return np.array([math.cos(s), math.sin(s)]), np.array([-math.sin(s), math.cos(s)])

            curve = cubic(*at(0.0), *at(h), np.ones(2))
            return float(np.linalg.norm(curve.at(2 * h)[0] - at(2 * h)[0]))

        assert error(0.1) / error(0.05) == pytest.approx(16, rel=0.02)

    def test_next_step_reaches_the_error_aimed_at(self):
        """An error K s^2 (s + h)^2 for the cubic extrapolated from a step h."""
        control = StepControl(error=1e-4, most=1.0)
        h, s, K = 0.1, 0.12, 0.3
        following = control.next_step(s, K * s**2 * (s + h) ** 2, 0.0, h)
        assert K * following**2 * (following + s) ** 2 == pytest.approx(1e-4, rel=1e-12)

    def test_steps_grow_with_the_fourth_root_of_the_error(self):
        def steps(error: float) -> int:
            return len(follow(Plane(circle), [1.0, 0.0], control=StepControl(most=1, error=error)))

        assert steps(1e-7) / steps(1.6e-6) == pytest.approx(2, rel=0.1)

    def test_two_corrections_a_step(self):
        counted = follow(Plane(circle), [1.0, 0.0], control=StepControl(most=1.0)).statistics
        assert counted["iterations"] <= 2.2 * counted["steps"]
        assert counted["steps"] == counted["grown"] + counted["kept"] + counted["shrunk"]

    @pytest.mark.parametrize("gap", [1e-1, 1e-2, 1e-3, 1e-4])
    def test_a_near_curve_is_not_jumped_to(self, gap):
        """The branches of a hyperbola come that near; det [J; t] is positive on one of them only,
        and where it changes its sign without a zero the step is refused.
        """

        def hyperbola(x, p):
            return x * x - p * p - (gap / 2) ** 2, 2 * x, -2 * p

        problem = Plane(hyperbola, branching=True)
        branch = follow(problem, [1.0, -1.0], steps=400, windows={"p": (-2.0, 1.0)})
        assert branch.ended.kind == "window"
        assert places(branch)[:, 0].min() > 0
        assert branch.special == branch.artefacts == ()

    def test_curves_that_cross_are_passed_straight(self):
        def crossing(x, p):
            return x * x - p * p, 2 * x, -2 * p

        problem = Plane(crossing, branching=True)
        branch = follow(problem, [1.0, -1.0], windows={"p": (-2.0, 1.0)})
        np.testing.assert_allclose(places(branch).sum(axis=1), 0.0, atol=1e-13)
        assert [special.kind for special in branch.special] == ["BP"]

    @pytest.mark.parametrize(
        ("wrong", "message"),
        [
            ({"first": 1.0}, "have to increase"),
            ({"least": 0.5}, "have to increase"),
            ({"tolerance": 0.0}, "tolerance = 0.0: has to be positive"),
            ({"error": math.nan}, "error = nan: has to be positive"),
        ],
    )
    def test_control_is_checked(self, wrong, message):
        with pytest.raises(ValueError, match=message):
            StepControl(**wrong)


class TestEndings:
    def test_the_last_point_lies_on_the_bound(self):
        branch = follow(Plane(parabola), [0.5, 0.25], windows={"p": (0.0, 2.0)})
        assert branch.ended.kind == "window"
        assert branch.ended.words == "the window of p is left at 2"
        assert branch.values[-1, 0] == pytest.approx(2, rel=1e-11)
        assert places(branch)[-1, 0] == pytest.approx(math.sqrt(2), rel=1e-11)

    def test_a_fold_before_the_bound_is_passed(self):
        branch = follow(Plane(parabola), [0.5, 0.25], direction=-1, windows={"p": (-1.0, 2.0)})
        assert places(branch)[-1, 0] == pytest.approx(-math.sqrt(2), rel=1e-11)

    def test_a_window_left_already_at_the_start(self):
        branch = follow(Plane(line), [1.0, 2.0], windows={"p": (3.0, 4.0)})
        assert len(branch) == 1
        assert branch.ended.kind == "window"
        assert "left at 3 already at the start" in branch.ended.words

    def test_outward_from_the_bound_there_is_nothing(self):
        branch = both_ways(Plane(line), [1.0, 2.0], windows={"p": (0.0, 2.0)})
        assert branch.values[-1] == pytest.approx(2.0)
        assert branch.values[0] == pytest.approx(0.0, abs=1e-13)
        assert branch.ended.kind == "window"
        assert branch.points[-1].arclength == 0.0

    def test_the_number_of_steps(self):
        branch = follow(Plane(line), [0.0, 0.0], steps=7)
        assert len(branch) == 8
        assert (branch.ended.kind, branch.ended.words) == (
            "steps",
            "7 steps done, as many as asked for",
        )

    def test_a_closed_curve_is_walked_once(self):
        branch = both_ways(Plane(circle), [0.6, 0.8])
        assert branch.ended.kind == "closed"
        np.testing.assert_allclose(places(branch)[-1], places(branch)[0], atol=1e-10)

    def test_a_spiral_that_only_passes_its_start_is_not_closed(self):
        """x = cos s / (1 + s/20), p alike: after one turn it is 0.24 away."""

        def spiral(u, v):
            s = math.atan2(v, u) % (2 * math.pi)
            r = math.hypot(u, v)
            turns = round((20 * (1 / r - 1) - s) / (2 * math.pi))
            s += 2 * math.pi * turns
            return r * (1 + s / 20) - 1, *_gradient(u, v, r, s)

        def _gradient(u, v, r, s):
            return u / r * (1 + s / 20) - v / r / 20, v / r * (1 + s / 20) + u / r / 20

        start = [math.cos(0.1) / 1.005, math.sin(0.1) / 1.005]
        branch = follow(Plane(spiral), start, steps=150)
        assert branch.ended.kind == "steps"
        assert branch.points[-1].arclength > 2 * math.pi

    def test_the_problem_s_own_reason(self):
        branch = follow(Plane(line, last=0.3), [0.0, 0.0])
        assert (branch.ended.kind, branch.ended.words[:10]) == ("problem", "far enough")
        assert branch.values[-2, 0] <= 0.3 < branch.values[-1, 0]

    @pytest.mark.parametrize(
        ("outcome", "kind"),
        [
            (DomainLeft("radius", "left", -1.0, 0.0, "m", (1.0,), ("x",)), "domain"),
            (NotFinite("the force", (1.0,), ("x",)), "not finite"),
            (SingularSystem("the force's matrix"), "least step"),
            (NoConvergence("the force", (1.0, 2.0)), "least step"),
        ],
    )
    def test_an_outcome_that_persists(self, outcome, kind):
        """The walk goes on, in shorter steps, until the border of what can be computed."""

        def bounded(x, p):
            if p > 0.7:
                raise outcome
            return line(x, p)

        control = StepControl(least=1e-6)
        branch = follow(Plane(bounded), [0.0, 0.0], control=control)
        assert branch.ended.kind == kind
        assert str(outcome) in branch.ended.words
        assert "below 1.0e-06" in branch.ended.words
        assert 0 <= 0.7 - branch.values[-1, 0] < 2e-6

    def test_a_model_that_returns_nan(self):
        """Newton's method sees it, and does not carry it on."""

        def undefined(x, p):
            return (math.nan,) * 3 if p > 0.7 else line(x, p)

        branch = follow(Plane(undefined), [0.0, 0.0], control=StepControl(least=1e-6))
        assert branch.ended.kind == "least step"
        assert np.all(np.isfinite(branch.values))

    def test_a_start_that_cannot_be_computed_raises(self):
        with pytest.raises(NoConvergence, match="point of the curve") as failure:
            follow(Plane(lambda x, p: (x * x + p * p + 1, 2 * x, 2 * p)), [0.5, 0.5])
        assert len(failure.value.residuals) > 1

    @pytest.mark.parametrize(
        ("wrong", "message"),
        [
            ({"direction": 2}, r"direction = 2: \+1, -1 or a tangent vector"),
            ({"windows": {"q": (0, 1)}}, "window of 'q': the free parameters are p"),
            ({"windows": {"p": (1, 0)}}, "needs the lower bound first"),
        ],
    )
    def test_bad_input_is_named(self, wrong, message):
        with pytest.raises(ValueError, match=message):
            follow(Plane(line), [0.0, 0.0], **wrong)


class TestSpecialPoints:
    def test_zeros_are_located(self):
        """To 1e-11 of the step, and the tests' curvature does not matter."""
        watched = {"A": lambda x, p: p - 0.3, "B": lambda x, p: math.expm1(3 * (x - 0.9))}
        branch = follow(Plane(line, watched), [0.0, 0.0], windows={"p": (-1.0, 3.0)})
        found = {point.kind: point.values[0] for point in branch.special}
        assert found == {
            "A": pytest.approx(0.3, abs=LOCATED),
            "B": pytest.approx(1.8, abs=LOCATED),
        }

    def test_a_zero_is_on_the_curve_and_between_its_points(self):
        branch = follow(Plane(circle, {"A": lambda x, p: x + p}), [1.0, 0.0])
        first, second = branch.special
        np.testing.assert_allclose(first.u, [-(0.5**0.5), 0.5**0.5], atol=1e-11)
        np.testing.assert_allclose(second.u, [0.5**0.5, -(0.5**0.5)], atol=1e-11)
        before, after = (branch.points[math.floor(first.index) + k].u for k in (0, 1))
        assert before[0] > first.u[0] > after[0]

    @pytest.mark.parametrize(
        ("test", "words"),
        [
            (lambda x, p: 1 / (p - 0.31), "through a pole or a jump"),
            (lambda x, p: math.copysign(1, p - 0.31), "through a pole or a jump"),
        ],
    )
    def test_poles_and_jumps_are_artefacts(self, test, words):
        branch = follow(Plane(line, {"A": test}), [0.0, 0.0], steps=20)
        assert branch.special == ()
        (artefact,) = branch.artefacts
        assert words in artefact.words
        assert artefact.values[0] == pytest.approx(0.31, abs=1e-9)

    def test_what_cannot_be_located_or_named_says_so(self):
        def gap(x, p):
            if abs(p - 0.31) < 0.002:
                raise NoConvergence("an eigenvalue", ())
            return p - 0.31

        def unnamed(test):
            raise NoConvergence("its normal form", ())

        watched = {"A": gap, "B": lambda x, p: p - 0.5}
        branch = follow(Plane(line, watched, finding=unnamed), [0.0, 0.0], steps=20)
        first, second = (artefact.words for artefact in branch.artefacts)
        assert first.startswith("the change of sign of A could not be located: no convergence: an")
        assert second.startswith(
            "the zero of B could not be classified: no convergence: its normal"
        )

    def test_the_problem_decides_what_an_artefact_is(self):
        def nothing(test):
            return Finding("", "nothing happens here")

        branch = follow(Plane(line, {"A": lambda x, p: p - 0.3}, finding=nothing), [0.0, 0.0])
        assert [artefact.words for artefact in branch.artefacts] == ["nothing happens here"]
        assert branch.special == ()

    def test_a_zero_at_the_start_is_found_once(self):
        watched = {"A": lambda x, p: p}
        branch = both_ways(Plane(line, watched), [0.0, 0.0], windows={"p": (-1.0, 1.0)})
        (special,) = branch.special
        assert branch.points[int(special.index)].arclength == 0.0

    def test_the_table_shows_points_and_special_points_in_order(self):
        watched = {"A": lambda x, p: p - 0.3}
        branch = both_ways(Plane(line, watched), [0.0, 0.0], windows={"p": (-1.0, 1.0)})
        table = branch.table()
        assert list(table.columns) == ["p", "x", "unstable", "point"]
        assert len(table) == len(branch) + 1
        assert table["p"].is_monotonic_increasing
        assert table.loc[table["point"] == "A", "x"].item() == pytest.approx(0.15, abs=1e-11)


def same(one: Branch, other: Branch) -> None:
    """Bit by bit, special points and decisions included."""
    for a, b in zip(one.points, other.points, strict=True):
        assert np.array_equal(a.u, b.u)
        assert np.array_equal(a.tangent, b.tangent)
        assert (a.arclength, a.step) == (b.arclength, b.step)
    for a, b in zip(one.special, other.special, strict=True):
        assert (a.kind, dict(a.coefficients)) == (b.kind, dict(b.coefficients))
        assert np.array_equal(a.u, b.u)
        assert a.index == pytest.approx(b.index, abs=1e-13)  # counted from the other end and back
    assert one.statistics == other.statistics
    assert (one.began, one.ended) == (other.began, other.ended)


class Killed(Exception):
    """Thrown in the middle of a walk."""


class TestInterruption:
    """The cusp's equilibria p1 = x^3 - p2 x, with two folds, on a system as users have them."""

    problem = EquilibriumProblem(cusp(p2=0.5).system, "p1", np.ones(3))
    windows = {"p1": (-1.0, 1.0)}  # noqa: RUF012

    def walk(self, walker, steps=60, **options):
        start = [0.0, 0.0, 0.0]
        return walker(self.problem, start, windows=self.windows, steps=steps, **options)

    @pytest.mark.parametrize("walker", [follow, both_ways])
    def test_an_extended_branch_is_the_uninterrupted_one(self, walker):
        whole = self.walk(walker, steps=25)
        assert len(whole.special) > 0
        same(extend(extend(self.walk(walker, steps=7), 12), 6), whole)

    def test_both_ends_go_on_only_where_their_steps_were_done(self):
        whole = self.walk(both_ways, steps=100)
        assert whole.ended.kind == whole.began.kind == "window"
        same(extend(self.walk(both_ways, steps=20), 80), whole)

    def test_what_ended_otherwise_does_not_go_on(self):
        with pytest.raises(ValueError, match="the branch ended: window"):
            extend(self.walk(follow, steps=100), 10)

    @pytest.mark.parametrize(("walker", "after"), [(follow, 3), (both_ways, 9), (both_ways, 31)])
    def test_a_killed_walk_is_resumed(self, walker, after, tmp_path, monkeypatch):
        monkeypatch.setattr(continuation, "CHECKPOINT_EVERY", -1.0)
        file, seen = tmp_path / "walk", []

        def killing(point):
            seen.append(point)
            if len(seen) == after:
                raise Killed

        with pytest.raises(Killed):
            self.walk(walker, progress=killing, checkpoint=file)
        same(resume(file), self.walk(walker))
        assert list(tmp_path.iterdir()) == [file]  # nothing half written is left

    def test_resuming_what_is_finished_changes_nothing(self, tmp_path):
        whole = self.walk(follow, checkpoint=tmp_path / "walk")
        same(resume(tmp_path / "walk"), whole)

    def test_progress_sees_every_accepted_point(self):
        seen = []
        branch = self.walk(follow, progress=seen.append)
        assert [point.arclength for point in seen] == [p.arclength for p in branch.points[1:]]


class TestDenseLinearisation:
    rng = np.random.default_rng(2)
    J, F, row = rng.normal(size=(4, 5)), rng.normal(size=4), rng.normal(size=5)

    def test_newton(self):
        x, t = DenseLinearisation(self.F, self.J).newton(self.row)
        bordered = np.vstack([self.J, self.row])
        np.testing.assert_allclose(bordered @ x, [*self.F, 0.0], atol=1e-13)
        np.testing.assert_allclose(bordered @ t, np.eye(5)[-1], atol=1e-13)

    @pytest.mark.parametrize("order", [(0, 1, 2, 3), (1, 0, 2, 3), (2, 0, 3, 1)])
    def test_determinant_with_its_sign(self, order):
        J = self.J[list(order)]
        exact = np.linalg.det(np.vstack([J, self.row]))
        found = DenseLinearisation(self.F, J).determinant(self.row)
        assert found == pytest.approx(exact, rel=1e-12)

    def test_a_singular_system_is_named(self):
        J = np.array([[1.0, 2.0, 3.0], [2.0, 4.0, 6.0]])
        with pytest.raises(SingularSystem, match="bordered by a row"):
            DenseLinearisation(np.zeros(2), J).newton(np.ones(3))

    def test_a_point_knows_its_determinant(self):
        """On the circle det [J; t] = 2 (x t_p - p t_x) = 2 everywhere, folds included."""
        problem = Plane(circle)
        for angle in (0.3, math.pi / 2, 4.0):
            u = np.array([math.cos(angle), math.sin(angle)])
            tangent = np.array([-u[1], u[0]])
            point = Point(problem, u, tangent, problem.linearised(u))
            assert point.determinant == pytest.approx(2.0, rel=1e-14)
