"""Branches of limit cycles against exact ones: points found, named and located, and switching."""

import numpy as np
import pytest

from tests.exact_systems import (
    ADAPTIVE_CONTROL_PD,
    OddPitchfork,
    TorusBirth,
    TwistedBand,
    adaptive_control,
    bautin,
    hopf,
    sheared,
)
from tests.systems import TOY_LPC, toy_wheelset
from wheelset.bifurcation.curves.continuation import follow
from wheelset.bifurcation.cycles.cycle_start import (
    Discretisation,
    Start,
    cycle_from_crossing,
    cycle_from_cycle,
    cycle_from_flip,
    cycle_from_guess,
    cycle_from_hopf,
    cycle_from_orbit,
)
from wheelset.bifurcation.cycles.symmetry import NotSymmetric
from wheelset.bifurcation.equilibria.hopf import hopf_point
from wheelset.bifurcation.integration.integrate import integrate

HALVES = pytest.mark.parametrize("half", [False, True], ids=["full", "half"])
SHAPES = pytest.mark.parametrize("shape", [lambda c: c, sheared], ids=["circle", "sheared"])


def walked(start: Start, window, steps=200, direction=None):
    """The branch of a start with its parameter in a window."""
    way = start.tangent if direction is None else direction
    [name] = start.problem.parameters
    return follow(start.problem, start.u, direction=way, windows={name: window}, steps=steps)


def from_exact(cycle, parameter, half, intervals=20):
    how = Discretisation(intervals, half)
    return cycle_from_guess(cycle.system, parameter, cycle.state, cycle.period, 1.0, how)


@HALVES
def test_the_branch_from_a_hopf_point_is_the_exact_one(half):
    system = bautin(b2=0.5).system
    start = cycle_from_hopf(
        system, hopf_point(system, "b1", 0.01), 1.0, discretisation=Discretisation(20, half)
    )
    branch = walked(start, (-1.0, 0.5))
    for point in branch.points[::7]:
        exact = bautin(b1=float(point.values[0]), b2=0.5)
        R = point.solution.measure("rms x1") ** 2 * 2
        assert min(abs(R - r) for r in exact.squared_radii()) < 1e-8
        cycle = exact.cycle(min(exact.squared_radii(), key=lambda r: abs(R - r)))
        assert point.solution.period == pytest.approx(cycle.period, rel=1e-9)
        found = np.sort(np.abs(point.solution.multipliers))
        assert found == pytest.approx(np.sort([1.0, abs(cycle.multipliers[0])]), abs=2e-6)


@HALVES
def test_a_fold_of_cycles_is_located_with_its_coefficient(half):
    system = bautin(b2=0.5).system
    start = cycle_from_hopf(
        system, hopf_point(system, "b1", 0.01), 1.0, discretisation=Discretisation(20, half)
    )
    [fold] = walked(start, (-1.0, 0.5)).of_kind("LPC")
    exact = bautin(b2=0.5).at_fold(0.25)
    assert fold.values[0] == pytest.approx(-(0.5**2) / 4, abs=1e-10)
    assert fold.solution.period == pytest.approx(exact.cycle(0.25).period, rel=1e-9)
    assert fold.coefficients["b"] == pytest.approx(exact.lpc_coefficient(0.25), rel=1e-6)


@HALVES
@pytest.mark.parametrize("a3", [100.0, 50.0])
def test_the_toy_wheelset_turns_where_matcont_and_auto_say(a3, half):
    system = toy_wheelset(a3)
    start = cycle_from_hopf(
        system, hopf_point(system, "v", 50.0), 10.0,
        discretisation=Discretisation(20 if half else 40, half),
    )  # fmt: skip
    [fold] = walked(start, (40.0, 60.0)).of_kind("LPC")
    v, period, b = TOY_LPC[a3]
    assert fold.values[0] == pytest.approx(v, rel=2e-10)
    assert fold.solution.period == pytest.approx(period, rel=1e-9)
    assert fold.coefficients["b"] == pytest.approx(b, rel=1e-7)


@SHAPES
def test_period_doubling_and_the_doubled_cycle(shape):
    exact = TwistedBand(half_twists=1, mu=-0.2)
    branch = walked(from_exact(shape(exact.cycle()), "mu", False), (-0.3, 0.2))
    [doubling] = branch.of_kind("PD")
    assert doubling.values[0] == pytest.approx(0.0, abs=1e-9)
    assert doubling.coefficients["c"] == pytest.approx(shape(exact.cycle()).coefficient, rel=1e-7)
    system = shape(exact.cycle()).system
    start = cycle_from_flip(system, doubling.solution, "mu", 1.0)
    doubled = walked(start, (-0.3, 0.1))
    end = doubled.points[-1]
    assert end.values[0] == pytest.approx(0.1)
    exact = TwistedBand(half_twists=1, mu=0.1)
    assert end.solution.period == pytest.approx(exact.bifurcated().period, rel=1e-8)
    assert _nontrivial(end.solution) == pytest.approx(
        np.sort(np.abs(exact.bifurcated().multipliers)), rel=1e-6
    )


def _nontrivial(cycle):
    return np.sort(np.abs(np.delete(cycle.multipliers, np.abs(cycle.multipliers - 1).argmin())))


def test_the_period_doubling_of_matconts_tutorial():
    system = adaptive_control()
    start = cycle_from_hopf(system, hopf_point(system, "alpha", 1.0), 1.0)
    branch = walked(start, (0.6, 1.5), steps=60)
    [doubling] = branch.of_kind("PD")
    assert doubling.values[0] == pytest.approx(ADAPTIVE_CONTROL_PD.parameter, abs=2e-10)
    assert doubling.solution.period == pytest.approx(ADAPTIVE_CONTROL_PD.period, rel=1e-9)
    assert doubling.coefficients["c"] == pytest.approx(-0.3051281, abs=2e-7)
    assert doubling.coefficients["c MATCONT"] == pytest.approx(-0.0427, abs=5e-5)


@SHAPES
@pytest.mark.parametrize("make", [OddPitchfork, lambda mu: TwistedBand(2, mu=mu)])
def test_symmetry_breaking_and_the_asymmetric_cycle(make, shape):
    exact = shape(make(mu=-0.2).cycle())
    branch = walked(from_exact(exact, "mu", True), (-0.3, 0.2))
    [breaking] = branch.of_kind("BPC")
    assert breaking.values[0] == pytest.approx(0.0, abs=1e-9)
    assert breaking.solution.symmetric and not branch.of_kind("PD")
    start = cycle_from_flip(exact.system, breaking.solution, "mu", 1.0)
    end = walked(start, (-0.3, 0.1)).points[-1]
    assert not end.solution.symmetric
    broken = make(mu=0.1).bifurcated()
    assert end.solution.period == pytest.approx(broken.period, rel=1e-8)
    assert _nontrivial(end.solution) == pytest.approx(np.sort(np.abs(broken.multipliers)), rel=1e-6)


@SHAPES
@HALVES
def test_a_torus_is_born_at_the_exact_value(half, shape):
    exact = shape(TorusBirth(mu=-0.2).cycle())
    branch = walked(from_exact(exact, "mu", half), (-0.3, 0.2))
    [birth] = branch.of_kind("NS")
    assert birth.values[0] == pytest.approx(0.0, abs=1e-9)
    assert birth.coefficients["Re d"] == pytest.approx(exact.coefficient.real, rel=1e-7)
    assert branch.points[0].solution.unstable == 0
    assert branch.points[-1].solution.unstable == 2


def test_a_branch_point_inside_the_symmetric_family_and_its_other_branch():
    exact = OddPitchfork(winding=1, mu=-0.2)
    branch = walked(from_exact(exact.cycle(), "mu", True), (-0.3, 0.2))
    [crossing] = branch.of_kind("BPC")
    assert crossing.values[0] == pytest.approx(0.0, abs=1e-7)
    assert not branch.of_kind("LPC")
    start = cycle_from_crossing(exact.system, crossing.solution, crossing.tangent, "mu", 1.0)
    end = walked(start, (-0.3, 0.1)).points[-1]
    other = OddPitchfork(winding=1, mu=float(end.values[0])).bifurcated()
    assert end.solution.period == pytest.approx(other.period, rel=1e-8)


def test_half_and_full_period_agree_point_by_point():
    system = toy_wheelset(100.0)
    point = hopf_point(system, "v", 50.0)
    ends = []
    for half in (True, False):
        how = Discretisation(20 if half else 40, half)
        branch = walked(cycle_from_hopf(system, point, 10.0, discretisation=how), (49.0, 55.0))
        ends.append(branch.points[-1].solution)
    assert ends[0].period == pytest.approx(ends[1].period, rel=1e-10)
    assert ends[0].measure("amplitude y") == pytest.approx(ends[1].measure("amplitude y"), rel=1e-7)
    assert np.abs(ends[0].multipliers[:3]) == pytest.approx(np.abs(ends[1].multipliers[:3]), 1e-6)


def test_integration_lands_on_the_stable_cycle_and_the_branch_starts_from_there():
    exact = hopf(mu=0.3)
    run = integrate(exact.system, [0.2, 0.1], 60.0)
    start = cycle_from_orbit(exact.system, "b1", run)
    [R] = exact.squared_radii()
    cycle = walked(start, (0.1, 0.5), steps=2).points[0].solution
    assert cycle.symmetric
    assert cycle.measure("amplitude x1") == pytest.approx(np.sqrt(R), rel=1e-7)
    assert cycle.period == pytest.approx(exact.cycle(R).period, rel=1e-10)


def test_a_known_cycle_is_followed_in_another_parameter():
    exact = bautin()
    branch = walked(from_exact(exact.cycle(exact.squared_radii()[-1]), "b1", None), (-1, 1), 1)
    other = cycle_from_cycle(exact.system, branch.points[0].solution, "w", 1.0)
    end = walked(other, (1.0, 3.0), direction=1).points[-1].solution
    assert end.period == pytest.approx(2 * np.pi / (3.0 + 0.4 * 0.4), rel=1e-9)


def test_a_branch_that_shrinks_to_an_equilibrium_ends_there():
    exact = hopf(mu=0.3)
    start = from_exact(exact.cycle(0.3), "b1", True)
    branch = walked(start, (-1.0, 1.0), direction=-1)
    assert branch.ended.kind == "problem" and "Hopf" in branch.ended.words
    [birth] = branch.of_kind("H")
    assert birth.values[0] == pytest.approx(0.0, abs=1e-8)


def test_half_a_period_is_refused_where_the_field_is_not_symmetric():
    system = adaptive_control()
    with pytest.raises(NotSymmetric, match="use the full period"):
        cycle_from_hopf(
            system, hopf_point(system, "alpha", 1.0), discretisation=Discretisation(20, True)
        )
    start = cycle_from_hopf(system, hopf_point(system, "alpha", 1.0))
    assert not start.problem.space.half
