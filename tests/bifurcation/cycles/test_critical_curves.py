"""Folds and flips of cycles along two parameters, against exact ones and against each other."""

import dataclasses

import numpy as np
import pytest

from tests.exact_systems import TwistedBand, adaptive_control, bautin, cusp_of_cycles
from tests.systems import TOY_GH, TOY_HOPF, TOY_LPC, toy_wheelset
from wheelset.bifurcation.curves.branch import Ending
from wheelset.bifurcation.curves.continuation import both_ways, follow
from wheelset.bifurcation.cycles.critical_start import (
    lpc_from_cycle,
    lpc_from_gh,
    pd_from_cycle,
    with_gh_ends,
)
from wheelset.bifurcation.cycles.cycle_start import (
    Discretisation,
    cycle_from_guess,
    cycle_from_hopf,
)
from wheelset.bifurcation.equilibria.hopf import hopf_point
from wheelset.bifurcation.equilibria.hopf_curve import GHPoint

HALVES = pytest.mark.parametrize("half", [False, True], ids=["full", "half"])


def fold_of(system, parameter, near, half, width=1.0, window=None):
    """The first fold of the cycles born at a Hopf point."""
    how = Discretisation(20, half)
    start = cycle_from_hopf(system, hopf_point(system, parameter, near), width, discretisation=how)
    branch = follow(start.problem, start.u, direction=start.tangent, windows=window or {})
    return branch.of_kind("LPC")[0]


def walked(start, windows, steps=150, ways=follow):
    return ways(start.problem, start.u, direction=start.tangent, windows=windows, steps=steps)


@HALVES
def test_the_fold_curve_of_bautins_normal_form_is_the_parabola(half):
    system = bautin(b2=0.5).system
    fold = fold_of(system, "b1", 0.01, half, window={"b1": (-1.0, 0.5)})
    curve = walked(
        lpc_from_cycle(system, fold.solution, ("b1", "b2"), (1.0, 1.0)),
        {"b2": (0.1, 1.0)}, ways=both_ways,
    )  # fmt: skip
    b1, b2 = curve.values.T
    assert b2.min() == pytest.approx(0.1) and b2.max() == pytest.approx(1.0)
    assert np.abs(b2**2 + 4 * b1).max() < 1e-8


@HALVES
def test_the_fold_curve_of_bautins_form_begins_at_the_generalised_hopf_point(half):
    system = bautin(b1=0.0, b2=0.0).system
    gh = GHPoint(("b1", "b2"), (0.0, 0.0), (0.0, 0.0), 2.0, 0.0, bautin().slc)
    start = lpc_from_gh(system, gh, (1.0, 1.0), discretisation=Discretisation(20, half))
    curve = walked(start, {"b2": (-1.0, 1.0)})
    b1, b2 = curve.values.T
    assert b2[-1] == pytest.approx(1.0)
    assert np.abs(b2**2 + 4 * b1).max() < 1e-8


def test_the_fold_curve_ends_in_the_generalised_hopf_point():
    system = bautin(b2=0.5).system
    fold = fold_of(system, "b1", 0.01, True, window={"b1": (-1.0, 0.5)})
    start = lpc_from_cycle(system, fold.solution, ("b1", "b2"), (1.0, 1.0))
    curve = follow(start.problem, start.u, direction=-start.tangent, steps=150)
    assert curve.ended.kind == "problem" and "generalised Hopf" in curve.ended.words
    [end] = with_gh_ends(system, curve).of_kind("GH")
    assert end.values == pytest.approx([0.0, 0.0], abs=1e-8)
    assert end.coefficients["SLC"] == pytest.approx(bautin().slc, rel=1e-8)


def test_a_curve_that_stops_beside_a_generalised_hopf_point_ends_in_it_whatever_stopped_it():
    system = bautin(b2=0.5).system
    fold = fold_of(system, "b1", 0.01, True, window={"b1": (-1.0, 0.5)})
    start = lpc_from_cycle(system, fold.solution, ("b1", "b2"), (1.0, 1.0))
    curve = follow(start.problem, start.u, direction=-start.tangent, steps=150)
    stuck = dataclasses.replace(curve, ended=Ending("least step", "no convergence"))
    found = with_gh_ends(system, stuck)
    assert "generalised Hopf" in found.ended.words and len(found.of_kind("GH")) == 1
    far = dataclasses.replace(stuck, points=curve.points[:3])
    assert with_gh_ends(system, far).ended.words == "no convergence"


def test_a_cusp_of_cycles_is_located():
    fold = cusp_of_cycles().at_fold(0.6)
    beside = dataclasses.replace(fold, b1=fold.b1 - 0.02)
    [R, *_] = beside.squared_radii()
    cycle = beside.cycle(R)
    start = cycle_from_guess(
        beside.system, "b1", cycle.state, cycle.period, 1.0, Discretisation(20, True)
    )
    branch = follow(start.problem, start.u, windows={"b1": (fold.b1 - 1, fold.b1 + 1)})
    turn = branch.of_kind("LPC")[0]
    assert turn.values[0] == pytest.approx(fold.b1, abs=1e-9)
    curve = walked(
        lpc_from_cycle(beside.system, turn.solution, ("b1", "b2"), (1.0, 1.0)),
        {"b1": (-3.0, 3.0), "b2": (-5.0, 0.0)}, ways=both_ways,
    )  # fmt: skip
    [cusp] = curve.of_kind("CPC")
    assert cusp.values == pytest.approx([1.0, -3.0], abs=1e-8)


def test_the_toy_wheelsets_curve_from_its_generalised_hopf_point_meets_the_one_from_its_fold():
    a3, slc = TOY_GH
    system = toy_wheelset(a3)
    gh = GHPoint(("v", "a3"), (TOY_HOPF["v"], a3), (0.0,) * 4, TOY_HOPF["frequency"], 0.0, slc)
    from_gh = walked(lpc_from_gh(system, gh, (50.0, 100.0)), {"a3": (-1.0, 100.0)}, 400)
    v, period, _ = TOY_LPC[100.0]
    end = from_gh.points[-1]
    assert not from_gh.special  # no cusp where the numerator of b is rounding
    assert end.values == pytest.approx([v, 100.0], rel=1e-9)
    assert end.solution.period == pytest.approx(period, rel=1e-9)
    system = toy_wheelset(50.0)
    fold = fold_of(system, "v", 50.0, True, 50.0, {"v": (40.0, 60.0)})
    start = lpc_from_cycle(system, fold.solution, ("v", "a3"), (50.0, 100.0))
    assert start.u[-2] == pytest.approx(fold.values[0], rel=1e-10)
    end = walked(start, {"a3": (0.0, 100.0)}).points[-1]
    assert end.values == pytest.approx([v, 100.0], rel=1e-9)


def test_half_and_full_period_follow_one_curve():
    system = toy_wheelset(100.0)
    ends = []
    for half in (True, False):
        fold = fold_of(system, "v", 50.0, half, 50.0, {"v": (40.0, 60.0)})
        start = lpc_from_cycle(system, fold.solution, ("v", "a1"), (50.0, 0.2))
        ends.append(walked(start, {"a1": (0.1, 0.3)}).points[-1].values)
    assert ends[0] == pytest.approx(ends[1], rel=1e-9)


def test_a_curve_of_period_doublings_is_the_exact_one():
    exact = TwistedBand(half_twists=1, mu=-0.1)
    start = cycle_from_guess(
        exact.system, "mu", exact.cycle().state, exact.cycle().period, 1.0,
        Discretisation(20, False),
    )  # fmt: skip
    branch = follow(start.problem, start.u, windows={"mu": (-0.2, 0.2)})
    [doubling] = branch.of_kind("PD")
    curve = walked(
        pd_from_cycle(exact.system, doubling.solution, ("mu", "omega"), (1.0, 1.0)),
        {"omega": (1.0, 3.0)},
    )
    mu, omega = curve.values.T
    assert np.abs(mu).max() < 1e-9
    assert omega[-1] == pytest.approx(3.0)


def test_the_period_doubling_curve_of_the_tutorial_goes_through_known_multipliers():
    system = adaptive_control()
    start = cycle_from_hopf(system, hopf_point(system, "alpha", 1.0), 1.0)
    branch = follow(start.problem, start.u, direction=start.tangent, steps=60)
    doubling = branch.of_kind("PD")[0]
    start = pd_from_cycle(system, doubling.solution, ("alpha", "beta"), (1.0, 1.0))
    curve = walked(start, {"beta": (0.9, 1.2)}, 40)
    for point in curve.points[::5]:
        assert np.abs(point.solution.multipliers + 1).min() < 1e-7


def test_the_gradient_of_g_is_the_difference_of_g():
    system = toy_wheelset(100.0)
    fold = fold_of(system, "v", 50.0, True, 50.0, {"v": (40.0, 60.0)})
    start = lpc_from_cycle(system, fold.solution, ("v", "a3"), (50.0, 100.0))
    problem, u = start.problem, start.u
    linearisation = problem.linearised(u)
    sizes = np.concatenate(
        [np.tile(system.state_scales, len(u) // 4)[: len(u) - 3], [0.15, 50, 90]]
    )
    step = 1e-5 * sizes * np.random.default_rng(1).standard_normal(len(u))
    change = problem.space.split(step)
    stages = change.stages.reshape(linearisation.rows[1].shape)
    scalars = np.concatenate([[change.period], change.free])
    exact = (linearisation.rows[1] * stages).sum() + linearisation.scalars[1] @ scalars
    ahead, behind = (problem.linearised(u + sign * step).mode.g for sign in (1, -1))
    assert exact == pytest.approx((ahead - behind) / 2, rel=1e-6)
