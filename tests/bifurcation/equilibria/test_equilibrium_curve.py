"""Equilibrium curves of normal forms, whose special points and coefficients are exact."""

from __future__ import annotations

import logging
import math
import pickle
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace

import numpy as np
import pytest
import sympy as sp

from tests.exact_systems import BogdanovTakens, HopfHopf, StaticForm
from tests.systems import TOY_HOPF, toy_wheelset
from wheelset.bifurcation.curves.branch import Branch, SpecialPoint
from wheelset.bifurcation.curves.steps import StepControl
from wheelset.bifurcation.equilibria.equilibrium_curve import branch_from_bp, equilibrium_curve
from wheelset.bifurcation.fields.field import Condition, VectorField
from wheelset.bifurcation.outcomes import NoConvergence
from wheelset.bifurcation.system import System

#: A located point is off by 1e-11 of a step; a fold's parameter by the square of it.
EXACT = 1e-10


@dataclass(frozen=True)
class Known:
    """A curve with everything on it: (letters, parameter, state, coefficients) of its special
    points in the order in which the parameter or the curve brings them.
    """

    name: str
    system: System
    parameter: str
    window: tuple[float, float]
    guess: tuple[float, ...]
    special: tuple[tuple[str, float, tuple[float, ...], Mapping[str, float]], ...]
    on_curve: Callable[[np.ndarray, float], float]  # zero on the curve
    unstable: Callable[[np.ndarray, float], int]
    artefacts: int = 0
    scales: tuple[float, ...] = field(default=())


def fold() -> Known:
    """x' = p1 + x^2, y' = -y + x^2 - ...: stable for x < 0."""
    return Known(
        "fold", StaticForm(p1=-1.0, a=1.0).system, "p1", (-2.0, 1.0), (-1.0, 1.0),
        (("LP", 0.0, (0.0, 0.0), {"a": 1.0}),),
        lambda x, p: p + x[0] ** 2, lambda x, p: int(x[0] > 0),
    )  # fmt: skip


def two_folds() -> Known:
    """The cusp's section p2 = 0.6: folds where 27 p1^2 = 4 p2^3, x^2 = p2/3.

    With the null vectors q = (1, 2 x)/sqrt(1 + 4 x^2) and p = (1, x/2): a = -3 x/(1 + x^2)/|..|.
    """
    x, p = math.sqrt(0.2), math.sqrt(4 * 0.6**3 / 27)
    a = 3 * x / (1 + x**2) / math.sqrt(1 + 4 * x**2)
    folds = [("LP", side * p, (-side * x, 0.2), {"a": side * a}) for side in (1, -1)]
    return Known(
        "cusp", StaticForm(p1=-0.5, p2=0.6, c=-1.0).system, "p1", (-1.0, 1.0), (-1.0, 1.0),
        tuple(folds), lambda x, p: p + 0.6 * x[0] - x[0] ** 3,
        lambda x, p: int(0.6 - 3 * x[0] ** 2 > 0),
    )  # fmt: skip


def transcritical() -> Known:
    return Known(
        "transcritical", StaticForm(p2=-0.7, a=-1.0).system, "p2", (-1.0, 1.5), (0.0, 0.0),
        (("BP", 0.0, (0.0, 0.0), {}), ("NSE", 1.0, (0.0, 0.0), {"a": 1.0})),
        lambda x, p: x[0], lambda x, p: int(p > 0),
    )  # fmt: skip


def pitchfork() -> Known:
    return Known(
        "pitchfork", StaticForm(p2=-0.7, c=-1.0).system, "p2", (-1.0, 1.5), (0.0, 0.0),
        (("BP", 0.0, (0.0, 0.0), {}), ("NSE", 1.0, (0.0, 0.0), {"a": 1.0})),
        lambda x, p: x[0], lambda x, p: int(p > 0),
    )  # fmt: skip


def upright() -> Known:
    """The pitchfork's other curve x^2 = p2 turns at the branch point, which is no fold."""
    return Known(
        "upright", StaticForm(p2=0.5, c=-1.0).system, "p2", (-1.0, 1.5), (0.7, 0.5),
        (("BP", 0.0, (0.0, 0.0), {}),), lambda x, p: p - x[0] ** 2, lambda x, p: 0, 1,
    )  # fmt: skip


def hopf() -> Known:
    """z1' = (b1 + i w1 - R1) z1: |q| = 1 makes FLC = -2; the second pair is stable."""
    return Known(
        "hopf", HopfHopf(b1=-0.4, b2=-0.3).system, "b1", (-1.0, 1.0), (0.0,) * 4,
        (("H", 0.0, (0.0,) * 4, {"frequency": 2.0, "FLC": -2.0}),),
        lambda x, p: float(np.abs(x).max()), lambda x, p: 2 * int(p > 0),
    )  # fmt: skip


def takens() -> Known:
    """b2 = -1 of the Bogdanov-Takens form: Hopf at b1 = 0, fold at b1 = 1/4; on the saddle's side
    eigenvalues (-x +- sqrt(x^2 + 4 (2x - 1)))/2 add up to zero at x = 0 only, the Hopf point.
    """
    exact = BogdanovTakens(b2=-1.0)
    return Known(
        "takens", BogdanovTakens(b1=-0.5, b2=-1.0).system, "b1", (-1.0, 0.5), (-0.36, 0.0),
        (("H", 0.0, (0.0, 0.0), {"frequency": 1.0, "FLC": exact.flc}),
         ("LP", 0.25, (0.5, 0.0), {})),
        lambda x, p: p - x[0] + x[0] ** 2,
        lambda x, p: 2 * int(x[0] < 0) + int(x[0] > 0.5),
    )  # fmt: skip


def saddle() -> Known:
    """x' = (1 + p) x, y' = -y: the eigenvalues add up to zero at p = 0, and nothing happens."""

    def f(x, p):
        return [x[0] * (1 + p[0]), -x[1] + x[0] * x[1]]

    return Known(
        "saddle", System.from_function(f, ("x", "y"), {"p": -0.4}), "p", (-0.5, 0.5), (0.0, 0.0),
        (("NSE", 0.0, (0.0, 0.0), {"a": 1.0}),),
        lambda x, p: float(np.abs(x).max()), lambda x, p: 1,
    )  # fmt: skip


def wheelset() -> Known:
    v, w, flc = TOY_HOPF.values()
    return Known(
        "wheelset", toy_wheelset(100.0), "v", (20.0, 80.0), (0.0,) * 4,
        (("H", v, (0.0,) * 4, {"frequency": w, "FLC": flc}),),
        lambda x, p: float(np.abs(x).max()), lambda x, p: 2 * int(p > v), 0, (1e-3,) * 4,
    )  # fmt: skip


KNOWN = [f() for f in (fold, two_folds, transcritical, pitchfork, upright, hopf, takens, saddle)]
KNOWN.append(wheelset())
BRANCHES: dict[str, Branch] = {}


def branch_of(known: Known) -> Branch:
    if known.name not in BRANCHES:
        BRANCHES[known.name] = equilibrium_curve(
            known.system, known.parameter, known.window, known.guess, scales=known.scales or None
        )
    return BRANCHES[known.name]


@pytest.mark.parametrize("known", KNOWN, ids=lambda known: known.name)
class TestKnownCurves:
    def test_every_point_is_an_equilibrium(self, known):
        solutions = [point.solution for point in branch_of(known).points]
        assert max(abs(known.on_curve(s.state, s.value)) for s in solutions) < 1e-13

    def test_it_fills_its_window(self, known):
        branch = branch_of(known)
        assert {branch.began.kind, branch.ended.kind} == {"window"}
        for value in branch.values[[0, -1], 0]:
            assert min(abs(value - bound) for bound in known.window) < EXACT * known.window[1]

    def test_special_points(self, known):
        found = branch_of(known).special
        if len(found) > 1 and found[0].kind != known.special[0][0]:
            found = found[::-1]  # the curve was walked from its other end
        assert [point.kind for point in found] == [kind for kind, *_ in known.special]
        for point, (_, value, state, coefficients) in zip(found, known.special, strict=True):
            assert point.values[0] == pytest.approx(value, abs=EXACT, rel=1e-12)
            np.testing.assert_allclose(point.solution.state, state, atol=EXACT)
            for name, exact in coefficients.items():
                sign = np.sign(point.coefficients[name] * exact) if name == "a" else 1.0
                assert sign * point.coefficients[name] == pytest.approx(exact, rel=1e-9)
        assert len(branch_of(known).artefacts) == known.artefacts

    def test_stability(self, known):
        for point in branch_of(known).points:
            s = point.solution
            if all(abs(s.value - value) > 1e-6 for _, value, *_ in known.special):
                assert s.unstable == known.unstable(s.state, s.value)

    def test_table(self, known):
        branch = branch_of(known)
        table = branch.table()
        assert len(table) == len(branch) + len(branch.special)
        assert list(table.columns[:2]) == [known.parameter, known.system.state_names[0]]
        assert [kind for kind in table["point"] if kind] == [p.kind for p in branch.special]
        growth = branch.table(["growth"])["growth"]
        regular = table["point"] == ""
        assert growth[regular].gt(0).equals(table["unstable"][regular].gt(0))


def test_the_sign_of_a_says_on_which_side_the_fold_lies():
    """With q along the walk, p1 falls off on both sides as -a x^2: a > 0 for x' = p1 + x^2."""
    (point,) = branch_of(KNOWN[0]).special
    assert point.coefficients["a"] * np.sign(point.tangent[0]) == pytest.approx(1.0, rel=1e-9)


def test_a_closed_curve():
    """x^2 + p^2 = 1: two folds, and back at the start."""
    circle = System.from_function(lambda x, p: [x[0] ** 2 + p[0] ** 2 - 1], ("x",), {"p": 0.3})
    branch = equilibrium_curve(circle, "p", (-2.0, 2.0), [0.9])
    assert branch.ended.kind == "closed"
    np.testing.assert_allclose(branch.points[-1].u, branch.points[0].u, atol=1e-10)
    assert sorted(point.values[0] for point in branch.of_kind("LP")) == pytest.approx([-1, 1])


class TestSwitching:
    @pytest.mark.parametrize(
        ("known", "other"),
        [
            (transcritical(), lambda x, p: x[0] - p),
            (pitchfork(), lambda x, p: p - x[0] ** 2),
            (upright(), lambda x, p: x[0]),
        ],
        ids=["transcritical", "pitchfork", "back"],
    )
    def test_the_crossing_curve(self, known, other):
        branch = branch_of(known)
        (bp,) = branch.of_kind("BP")
        crossing = branch_from_bp(branch, bp)
        solutions = [point.solution for point in crossing.points]
        assert max(abs(other(s.state, s.value)) for s in solutions) < 1e-13
        assert {crossing.began.kind, crossing.ended.kind} == {"window"}
        (again,) = crossing.of_kind("BP")
        np.testing.assert_allclose(again.u, bp.u, atol=EXACT)

    def test_curves_that_cross_where_neither_is_trivial(self):
        """x = p^2 + 1 and x = sin p + 1.3 cross twice; y follows as x^2 and weighs most."""

        def f(x, p):
            return [(x[0] - p[0] ** 2 - 1) * (x[0] - sp.sin(p[0]) - 1.3), -x[1] + x[0] ** 2]

        system = System.from_function(f, ("x", "y"), {"p": -0.7})
        branch = equilibrium_curve(system, "p", (-1.0, 1.5), [1.49, 2.2])
        assert len(branch.of_kind("BP")) == 2
        for bp in branch.of_kind("BP"):
            p = bp.values[0]
            assert p**2 + 1 == pytest.approx(math.sin(p) + 1.3, abs=1e-9)
            crossing = branch_from_bp(branch, bp)
            x, p = np.array([(s.u[0], s.u[2]) for s in crossing.points]).T
            np.testing.assert_allclose(x, np.sin(p) + 1.3, atol=1e-10)

    def test_only_from_a_branch_point(self):
        branch = branch_of(KNOWN[0])
        with pytest.raises(ValueError, match="special point 'LP': has to be a BP"):
            branch_from_bp(branch, branch.special[0])

    def test_a_point_where_nothing_crosses_is_named(self):
        """At the fold of x' = p1 + x^2 taken for a branch point, the form is definite."""
        isola = System.from_function(lambda x, p: [x[0] ** 2 + p[0] ** 2], ("x",), {"p": 0.1})
        branch = branch_of(transcritical())
        (bp,) = branch.of_kind("BP")
        problem = type(branch.state[1].problem)(isola, "p", np.ones(2))
        alone = SpecialPoint("BP", "", {}, 0.0, np.zeros(2), np.array([1.0, 0.0]), bp.values, None)
        lonely = replace(branch, state=replace(branch.state[1], problem=problem))
        with pytest.raises(NoConvergence, match="no second curve crosses"):
            branch_from_bp(lonely, alone)


class TestHonesty:
    def test_two_pairs_that_cross_at_once_are_noted(self):
        """The product of pair sums keeps its sign there; the count of eigenvalues changes."""

        def f(x, p):
            mu = p[0]
            first = [mu * x[0] - 2 * x[1], 2 * x[0] + mu * x[1]]
            return [*first, mu * x[2] - 3 * x[3], 3 * x[2] + mu * x[3]]

        twice = System.from_function(f, ("a", "b", "c", "d"), {"mu": -0.3})
        branch = equilibrium_curve(twice, "mu", (-1.0, 1.0))
        assert branch.special == ()
        (note,) = branch.artefacts
        assert "unstable eigenvalues go from 0 to 4" in note.words

    def test_criticality_that_is_undefined_says_why(self):
        """A field with no third derivative where its radius vanishes."""
        x, y, mu, size = sp.symbols("x y mu size", real=True)
        field = VectorField(
            (x, y), (mu,), (mu * x - 2 * y - size * x, 2 * x + mu * y - size * y),
            ((size, x**2 + y**2),), (Condition(size, "radius squared", order=3, unit="m2"),),
        )  # fmt: skip
        branch = equilibrium_curve(System(field, {"mu": -0.3}), "mu", (-1.0, 1.0))
        (point,) = branch.special
        assert point.kind == "H"
        assert point.words.startswith("Hopf; criticality undefined: domain left: radius squared")
        assert set(point.coefficients) == {"frequency"}

    def test_a_double_zero_eigenvalue_at_a_fold_is_named(self):
        branch = equilibrium_curve(
            BogdanovTakens(b1=-0.25, b2=0.0).system, "b1", (-1.0, 1.0), [-0.5, 0.0]
        )
        folds = [point.words for point in branch.of_kind("LP")]
        assert folds == ["fold with a double zero eigenvalue (Bogdanov-Takens)"]


class TestFailures:
    def test_no_equilibrium_at_the_start(self):
        with pytest.raises(NoConvergence, match="equilibrium") as failure:
            equilibrium_curve(StaticForm(p1=1.0, a=1.0).system, "p1", (-2.0, 2.0), [0.3, 0.0])
        assert len(failure.value.residuals) > 1

    def test_a_model_that_is_left_in_the_middle(self):
        """x = sqrt(p) ends where the root does, however long the walk could go on."""
        root = System.from_function(lambda x, p: [sp.sqrt(p[0]) - x[0]], ("x",), {"p": 1.0})
        branch = equilibrium_curve(root, "p", (-1.0, 2.0), [1.0], control=StepControl(least=1e-5))
        assert branch.began.kind == "not finite"
        assert "the time derivative" in branch.began.words
        assert 0 < branch.values[0, 0] < 1e-4

    def test_a_declared_domain_that_is_left_in_the_middle(self):
        x, p, gap = sp.symbols("x p gap", real=True)
        field = VectorField(
            (x,), (p,), (p - x,), ((gap, 1 - x),), (Condition(gap, "gap", "left wheel", "m"),)
        )
        branch = equilibrium_curve(
            System(field, {"p": 0.0}), "p", (-1.0, 2.0), control=StepControl(least=1e-5)
        )
        assert branch.ended.kind == "domain"
        assert "domain left: gap, left wheel" in branch.ended.words
        assert 0 < 1 - branch.values[-1, 0] < 1e-4

    def test_the_window_may_be_left_at_the_start(self):
        branch = equilibrium_curve(StaticForm(p1=-1.0, a=1.0).system, "p1", (0.0, 1.0), [-1, 1])
        assert len(branch) == 1
        assert branch.ended.words == "the window of p1 is left at 0 already at the start"

    @pytest.mark.parametrize(
        ("wrong", "message"),
        [
            ({"window": (1.0, -1.0)}, "needs the lower bound first"),
            ({"scales": [1.0]}, "needs 2 positive numbers"),
            ({"scales": [1.0, -1.0]}, "needs 2 positive numbers"),
            ({"parameter": "q"}, "unknown parameter 'q'"),
        ],
    )
    def test_bad_input_is_named(self, wrong, message):
        given = {"parameter": "p1", "window": (-2.0, 1.0), "guess": [-1.0, 1.0], **wrong}
        with pytest.raises(ValueError, match=message):
            equilibrium_curve(StaticForm(p1=-1.0, a=1.0).system, **given)

    def test_an_unknown_measure_names_those_there_are(self):
        with pytest.raises(ValueError, match="unknown measure 'z'; there are x, y, growth"):
            branch_of(KNOWN[0]).table(["z"])


def test_what_a_branch_keeps_can_be_stored():
    """Plain arrays, numbers and words; a frozen dataclass of them for every solution."""
    branch = branch_of(KNOWN[0])
    again = pickle.loads(pickle.dumps(branch))  # noqa: S301
    assert again.table().equals(branch.table())


def test_decisions_are_in_the_log(caplog):
    with caplog.at_level(logging.DEBUG, logger="wheelset.bifurcation.curves.walk"):
        equilibrium_curve(StaticForm(p1=-1.0, a=1.0).system, "p1", (-2.0, 1.0), [-1.0, 1.0])
    assert "accepted, grown to" in caplog.text
    assert "LP: fold" in caplog.text
