"""Time integration against closed forms, Taylor series at high precision, and itself."""

from __future__ import annotations

import itertools
import math

import mpmath
import numpy as np
import pytest
import sympy as sp
from scipy.integrate import solve_ivp

from tests.systems import hopf_normal_form, toy_wheelset
from wheelset.bifurcation.fields.field import Condition, Switch, VectorField
from wheelset.bifurcation.integration import integrate as module
from wheelset.bifurcation.integration.endings import (
    BecameNotFinite,
    LeftDomain,
    ReachedEnd,
    SettledToCycle,
    SettledToEquilibrium,
    Sliding,
    SolverFailed,
    StepBelowMinimum,
)
from wheelset.bifurcation.integration.events import Crossing, ThresholdPair
from wheelset.bifurcation.integration.integrate import extend, integrate
from wheelset.bifurcation.integration.plan import METHODS, typical_size
from wheelset.bifurcation.system import System

VAN_DER_POL_PERIOD = 6.663286859323130189  # mu = 1; known to 18 digits
x, y, u, s = sp.symbols("x y u s", real=True)
c, k, r = sp.symbols("c k r", real=True)


def oscillator(w: float = 1.0) -> System:
    return System.from_function(lambda x, p: [x[1], -(p[0] ** 2) * x[0]], ("q", "v"), {"w": w})


def van_der_pol(mu: float = 1.0) -> System:
    return System.from_function(
        lambda x, p: [x[1], p[0] * (1 - x[0] ** 2) * x[1] - x[0]], ("q", "v"), {"mu": mu}
    )


def bilinear(gap: float = 0.5, stiffness: float = 99.0) -> System:
    """y'' = -y, and -stiffness (y - gap) more above the gap."""
    field = VectorField(
        (y, u), (k, c, r), (u, -y - k * r * (y - c)), switch=Switch(r, y, (c,), (0.0, 1.0))
    )
    return System(field, {"k": stiffness, "c": gap})


class Bilinear:
    """Closed form of ``bilinear()`` from y = 0, u = 1: a sine joined to a faster one."""

    t_in = math.asin(0.5)
    speed = math.cos(t_in)
    middle = 0.495  # -100 y + 49.5 vanishes here
    amplitude = math.hypot(0.5 - middle, speed / 10)
    inside = 2 * math.acos((0.5 - middle) / amplitude) / 10
    period = inside + 2 * t_in + math.pi

    def at(self, t: float) -> np.ndarray:
        t %= self.period
        if t <= self.t_in:
            return np.array([math.sin(t), math.cos(t)])
        if t <= self.t_in + self.inside:
            phase = 10 * (t - self.t_in - self.inside / 2)
            return np.array([
                self.middle + self.amplitude * math.cos(phase),
                -10 * self.amplitude * math.sin(phase),
            ])  # fmt: skip
        back = math.pi - self.t_in + (t - self.t_in - self.inside)
        return np.array([math.sin(back), math.cos(back)])

    def corner_times(self, count: int) -> np.ndarray:
        turns = np.arange(count) // 2 * self.period
        return turns + self.t_in + np.arange(count) % 2 * self.inside


def wall(slow: bool = True) -> System:
    """A gap s = c - x closes; y' = sqrt(s) x', so y ends at 2/3. Slow: x' = 1/(1 - log s)."""
    speed = 1 / (1 - sp.log(s)) if slow else sp.Integer(1)
    field = VectorField(
        (x, y), (c,), (speed, sp.sqrt(s) * speed),
        assignments=((s, c - x),), domain=(Condition(s, "gap", "front wall", "m"),),
    )  # fmt: skip
    return System(field, {"c": 1.0})


# --- accuracy ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("method", "bound"),
    [("DOP853", 3e-8), ("RK45", 1e-7), ("Radau", 1e-7), ("BDF", 2e-4), ("LSODA", 1e-5)],
)
def test_harmonic_oscillator_in_every_method(method, bound):
    w, t_end = 3.0, 20.0
    trajectory = integrate(oscillator(w), [2.0, 0.0], t_end, method=method, rtol=1e-8)
    exact = [2 * math.cos(w * t_end), -2 * w * math.sin(w * t_end)]
    assert isinstance(trajectory.outcome, ReachedEnd)
    assert trajectory.t[-1] == t_end
    assert np.abs(trajectory.x[-1] - exact).max() < bound * w * t_end


def test_energy_drift_over_a_hundred_periods():
    trajectory = integrate(oscillator(), [1.0, 0.0], 200 * math.pi)
    energy = (trajectory.x**2).sum(axis=1)
    assert 0 < np.abs(energy - 1).max() < 2e-7


def test_error_falls_with_the_tolerance():
    system, exact = oscillator(), np.array([math.cos(30.0), -math.sin(30.0)])
    errors = [
        np.abs(integrate(system, [1.0, 0.0], 30.0, rtol=rtol).x[-1] - exact).max()
        for rtol in (1e-4, 1e-6, 1e-8, 1e-10, 1e-12)
    ]
    orders = np.log10(np.array(errors[:-1]) / errors[1:])
    assert errors[0] < 1e-2
    assert errors[-1] < 1e-11
    assert np.all((orders > 1.2) & (orders < 2.8))


def test_van_der_pol_against_taylor_series_of_thirty_digits():
    with mpmath.workdps(30):
        solution = mpmath.odefun(lambda _t, z: [z[1], (1 - z[0] ** 2) * z[1] - z[0]], 0, [2, 0.5])
        exact = np.array([float(v) for v in solution(3)])
    trajectory = integrate(van_der_pol(), [2.0, 0.5], 3.0, rtol=1e-12)
    np.testing.assert_allclose(trajectory.x[-1], exact, rtol=2e-11)


def test_dense_output_between_points_and_its_shapes():
    trajectory = integrate(oscillator(), [0.0, 1.0], 5.0)
    times = np.linspace(0, 5, 501)
    np.testing.assert_allclose(trajectory(times)[:, 0], np.sin(times), atol=5e-8)
    assert trajectory(1.0).shape == (2,)
    assert trajectory(np.ones((3, 4))).shape == (3, 4, 2)
    np.testing.assert_allclose(trajectory(trajectory.t), trajectory.x, rtol=0, atol=1e-15)
    for outside in (-1e-9, 5.0 + 1e-9, math.nan):
        with pytest.raises(ValueError, match=r"outside 0 \.\. 5 s.*extend"):
            trajectory(outside)


def test_absolute_tolerance_follows_the_units_of_each_state():
    size = typical_size(oscillator(1e3), np.array([1e3]), np.array([1e-6, 0.0]))
    np.testing.assert_allclose(size, [1e-6, 1e-3], rtol=0.5)
    assert integrate(oscillator(), [0.0, 0.0], 1.0).plan.atol.min() > 0


def test_frame_and_states_by_name():
    trajectory = integrate(oscillator(), [0.0, 1.0], 5.0)
    frame = trajectory.to_frame()
    assert list(frame.columns) == ["q", "v"]
    np.testing.assert_array_equal(frame["v"], trajectory.state("v"))
    assert trajectory.to_frame([0.0, 1.0])["q"].loc[1.0] == pytest.approx(math.sin(1), abs=1e-8)


def test_extended_trajectory_equals_one_made_in_one_go():
    events = (Crossing("zero", "q", 0.0, "both"),)
    whole = integrate(oscillator(), [1.0, 0.0], 20.0, events=events)
    parts = extend(integrate(oscillator(), [1.0, 0.0], 7.0, events=events), 20.0)
    np.testing.assert_allclose(
        parts(np.linspace(0, 20, 99)), whole(np.linspace(0, 20, 99)), atol=1e-7
    )
    assert len(parts.events) == len(whole.events) == 6
    assert np.all(np.diff(parts.t) > 0)
    with pytest.raises(ValueError, match="cannot be extended: domain left"):
        extend(integrate(wall(), [0.0, 0.0], 5.0), 6.0)


# --- events --------------------------------------------------------------------------------------


@pytest.mark.parametrize("method", ["DOP853", "RK45", "LSODA"])
def test_crossings_are_located_in_both_directions(method):
    events = (Crossing("up", "q", 0.3, "up"), Crossing("down", "q", 0.3, "down"))
    trajectory = integrate(oscillator(), [0.0, 1.0], 20.0, events=events, rtol=1e-12, method=method)
    up = [e.t for e in trajectory.events if e.what == "up"]
    down = [e.t for e in trajectory.events if e.what == "down"]
    turns = 2 * math.pi * np.arange(4)
    np.testing.assert_allclose(up, turns + math.asin(0.3), rtol=1e-9)
    np.testing.assert_allclose(down, turns[:3] + math.pi - math.asin(0.3), rtol=1e-9)
    assert all(abs(e.state[0] - 0.3) < 1e-12 for e in trajectory.events)
    assert [e.t for e in trajectory.events] == sorted(e.t for e in trajectory.events)


def test_events_lie_on_the_dense_output_to_rounding():
    trajectory = integrate(oscillator(), [0.0, 1.0], 20.0, events=(Crossing("", "q", 0.3),))
    for event in trajectory.events:
        across = trajectory(event.t * (1 + np.array([-1e-12, 1e-12])))[:, 0] - 0.3
        assert across[0] * across[1] < 0


def test_several_events_and_a_grazing_pair_in_one_step():
    """The top of the sine pokes 1e-9 through a level, for 1e-4 of time within a step of 0.2."""
    events = (Crossing("graze", "q", 1 - 1e-9), Crossing("mid", "q", 0.9999))
    tight = integrate(oscillator(), [0.0, 1.0], 3.0, events=events, rtol=1e-12)
    times = {name: [e.t for e in tight.events if e.what == name] for name in ("graze", "mid")}
    for name, below in (("graze", 1e-9), ("mid", 1e-4)):
        exact = math.pi / 2 + np.array([-1, 1]) * math.acos(1 - below)
        np.testing.assert_allclose(times[name], exact, rtol=0, atol=1e-7)
    first, last = np.searchsorted(tight.t, [times["mid"][0], times["mid"][1]])
    assert first == last  # all four in one step


def test_a_top_below_the_level_is_no_event():
    events = (Crossing("graze", "q", 1 + 1e-9),)
    assert not integrate(oscillator(), [0.0, 1.0], 20.0, events=events, rtol=1e-12).events


def test_function_of_the_state_as_an_event():
    events = (Crossing("diagonal", lambda z: z[0] - z[1], 0.0, "up"),)
    found = integrate(oscillator(), [0.0, 1.0], 8.0, events=events, rtol=1e-12).events
    np.testing.assert_allclose([e.t for e in found], math.pi / 4 + np.array([0, 2 * math.pi]))


def test_threshold_pair_says_entered_and_left_on_both_sides():
    pair = ThresholdPair("q", 0.5, "touching", "free")
    events = integrate(oscillator(), [0.0, 1.0], 2 * math.pi, events=(pair,), rtol=1e-12).events
    assert [e.kind for e in events] == ["entered", "left", "entered", "left"]
    assert [e.what for e in events] == ["touching", "free", "touching", "free"]
    np.testing.assert_allclose([e.t for e in events], np.array([1, 5, 7, 11]) * math.pi / 6)


def test_starting_on_a_level_is_not_crossing_it():
    events = (Crossing("zero", "q", 0.0, "both"),)
    found = integrate(oscillator(), [0.0, 1.0], 4.0, events=events).events
    np.testing.assert_allclose([e.t for e in found], [math.pi], rtol=1e-7)


# --- corners -------------------------------------------------------------------------------------


@pytest.mark.parametrize("method", METHODS)
def test_bilinear_oscillator_against_its_closed_form(method):
    trajectory = integrate(bilinear(), [0.0, 1.0], 20.0, rtol=1e-8, method=method)
    bound = {"DOP853": 2e-7, "RK45": 2e-6, "Radau": 1e-9, "BDF": 5e-5, "LSODA": 1e-5}[method]
    assert np.abs(trajectory.x[-1] - Bilinear().at(20.0)).max() < bound
    corners = [e for e in trajectory.events if e.kind == "corner"]
    np.testing.assert_allclose(
        [e.t for e in corners], Bilinear().corner_times(10), rtol=0, atol=bound
    )
    assert all(e.state[0] == 0.5 for e in corners)
    assert corners[0].what == "y = 0.5 crossed upward"
    assert corners[1].what == "y = 0.5 crossed downward"


def test_order_is_kept_across_corners_and_lost_where_they_are_smeared():
    tolerances = (1e-6, 1e-8, 1e-10, 1e-12)
    system, exact = bilinear(), Bilinear().at(20.0)
    runs = [integrate(system, [0.0, 1.0], 20.0, rtol=rtol) for rtol in tolerances]
    errors = np.array([np.abs(run.x[-1] - exact).max() for run in runs])
    orders = np.log(errors[:-1] / errors[1:]) / np.log(
        [len(b.t) / len(a.t) for a, b in itertools.pairwise(runs)]
    )
    assert np.all(errors < 10 * np.array(tolerances))
    assert np.all(orders > 6)  # accuracy over number of points: order 8 to some noise
    for run, error in list(zip(runs, errors, strict=True))[1:3]:
        smeared = solve_ivp(
            lambda t, z: system.rhs(z), (0, 20), [0.0, 1.0], "DOP853",
            rtol=run.plan.rtol, atol=run.plan.atol,
        )  # fmt: skip
        assert smeared.t.size > 1.5 * len(run.t)
        assert np.abs(smeared.y[:, -1] - exact).max() > 3 * error


def test_pieces_are_smooth_so_no_step_holds_a_corner():
    trajectory = integrate(bilinear(), [0.0, 1.0], 20.0)
    inside = trajectory.x[:, 0] - 0.5
    assert not np.any(inside[:-1] * inside[1:] < -1e-30)


@pytest.mark.parametrize("excess", [0.0, 1e-15, 1e-12, 1e-9, 1e-6, -1e-15, -1e-9])
def test_grazing_a_corner_neither_hangs_nor_disturbs(excess):
    trajectory = integrate(bilinear(1.0 - excess), [0.0, 1.0], 20.0, max_steps=1000)
    assert isinstance(trajectory.outcome, ReachedEnd)
    exact = [math.sin(20), math.cos(20)]
    assert np.abs(trajectory.x[-1] - exact).max() < 5e-8 + abs(excess)


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_start_on_a_corner_goes_where_the_field_points(way):
    field = VectorField((x, y), (c, r), (c, r), switch=Switch(r, x, (sp.Integer(0),), (-1.0, 1.0)))
    trajectory = integrate(System(field, {"c": way}), [0.0, 0.0], 2.0)
    np.testing.assert_allclose(trajectory.x[-1], [2 * way, 2 * way], rtol=1e-12)


def test_field_that_holds_the_state_on_a_corner_is_named():
    """x' = cos t - 2 sign x: x reaches 0 where sin t + 1 = 2 t and cannot leave it."""
    field = VectorField(
        (x, y), (r,), (sp.cos(y) - 2 * r, sp.Integer(1)),
        switch=Switch(r, x, (sp.Integer(0),), (-1.0, 1.0)),
    )  # fmt: skip
    outcome = integrate(System(field, {}), [1.0, 0.0], 10.0).outcome
    assert isinstance(outcome, Sliding)
    assert outcome.t == pytest.approx(0.887862211571, rel=1e-9)
    assert "x = 0" in str(outcome)


# --- endings -------------------------------------------------------------------------------------


@pytest.mark.parametrize("method", METHODS)
def test_boundary_of_the_domain_is_reached_and_named(method):
    """Time to the wall is the integral of 1 - log s, which is 2."""
    trajectory = integrate(wall(), [0.0, 0.0], 5.0, method=method)
    outcome = trajectory.outcome
    assert isinstance(outcome, LeftDomain)
    accuracy = 1e-6 if method in ("BDF", "LSODA") else 1e-8
    assert outcome.t == trajectory.t[-1] == pytest.approx(2.0, rel=accuracy)
    assert trajectory.x[-1] == pytest.approx([1.0, 2 / 3], rel=accuracy)
    assert 0 < 1 - trajectory.x[-1, 0] < 1e-9
    assert outcome.cause.quantity == "gap"
    assert "domain left at t = 2 s: gap, front wall" in str(outcome)
    assert trajectory.events[-1].kind == "domain left"
    assert np.isfinite(trajectory.x).all()


def test_boundary_crossed_at_full_speed_is_located_by_shrinking_steps():
    trajectory = integrate(wall(slow=False), [0.0, 0.0], 5.0)
    assert 0 < 1 - trajectory.t[-1] < 1e-9
    assert trajectory.x[-1, 1] == pytest.approx(2 / 3, rel=1e-8)
    assert len(trajectory.t) < 100


def test_trial_steps_outside_the_domain_are_not_the_end():
    """s' = -20 (s - 0.001) stays positive; long explicit steps at a loose tolerance do not."""
    field = VectorField(
        (x,),
        (c,),
        (20 * (s - sp.Rational(1, 1000)),),
        assignments=((s, c - x),),
        domain=(Condition(s, "gap"),),
    )
    trajectory = integrate(System(field, {"c": 1.0}), [0.0], 100.0, rtol=1e-3, atol=1e-3)
    assert isinstance(trajectory.outcome, ReachedEnd)
    assert 1 - trajectory.x[-1, 0] == pytest.approx(1e-3, rel=1e-2)
    assert 100 < len(trajectory.t) < 1000  # steps were cut, and allowed to grow again


def test_steps_grow_again_after_a_false_alarm():
    """s' = -s log(1 + s)/(1 + s): s falls as 1/t, so the steps grow with t."""
    field = VectorField(
        (x,),
        (c,),
        (s * sp.log(1 + s) / (1 + s),),
        assignments=((s, c - x),),
        domain=(Condition(s, "gap"),),
    )
    trajectory = integrate(System(field, {"c": 1.0}), [0.0], 1e4, rtol=1e-3, method="RK45")
    assert isinstance(trajectory.outcome, ReachedEnd)
    assert 1 - trajectory.x[-1, 0] == pytest.approx(1e-4, rel=0.1)
    assert len(trajectory.t) < 60


def test_start_outside_the_domain_is_an_outcome_of_one_point():
    trajectory = integrate(wall(), [2.0, 0.0], 5.0)
    assert isinstance(trajectory.outcome, LeftDomain)
    assert trajectory.t.tolist() == [0.0]
    assert trajectory(0.0).tolist() == [2.0, 0.0]


def test_blow_up_ends_with_words():
    square = System.from_function(lambda z, p: [p[0] * z[0] ** 2], ("q",), {"c": 1.0})
    trajectory = integrate(square, [1.0], 5.0)
    assert isinstance(trajectory.outcome, StepBelowMinimum)
    assert trajectory.t[-1] == pytest.approx(1.0, abs=1e-8)
    overflow = integrate(square, [1.0], 5.0, method="LSODA")
    assert isinstance(overflow.outcome, BecameNotFinite | StepBelowMinimum)
    assert np.isfinite(overflow.x).all()


def test_guard_on_the_number_of_steps():
    outcome = integrate(oscillator(), [1.0, 0.0], 1e6, max_steps=20).outcome
    assert isinstance(outcome, SolverFailed)
    assert "max_steps = 20" in str(outcome)


# --- settling ------------------------------------------------------------------------------------


def test_van_der_pol_settles_to_its_cycle():
    outcome = integrate(van_der_pol(), [0.1, 0.0], 500.0, stop_when_settled=True).outcome
    assert isinstance(outcome, SettledToCycle)
    assert outcome.t < 100
    assert outcome.period == pytest.approx(VAN_DER_POL_PERIOD, rel=1e-8)
    assert outcome.amplitude[0] == pytest.approx(2.008619860874, rel=1e-7)
    assert outcome.error < 1e-6


@pytest.mark.parametrize("mu", [0.25, 0.04])
def test_cycle_of_the_hopf_normal_form_and_its_honest_error(mu):
    """r = sqrt(mu), frequency omega + b mu, contraction exp(-2 mu T): all exact."""
    system = hopf_normal_form(mu)
    outcome = integrate(system, [1.0, 0.0], 3000.0, stop_when_settled=True).outcome
    assert isinstance(outcome, SettledToCycle)
    period = 2 * math.pi / (2.0 + 0.5 * mu)
    assert outcome.contraction == pytest.approx(math.exp(-2 * mu * period), rel=2e-2)
    assert outcome.period == pytest.approx(period, rel=1e-6)
    off = abs(np.hypot(*outcome.state) / math.sqrt(mu) - 1)
    assert off < 3 * outcome.error + 1e-8
    np.testing.assert_allclose(outcome.amplitude, math.sqrt(mu), rtol=3e-6)


def test_slow_spiral_is_an_equilibrium_and_not_a_cycle():
    trajectory = integrate(hopf_normal_form(-0.05), [1.0, 0.0], 3000.0, stop_when_settled=True)
    outcome = trajectory.outcome
    assert isinstance(outcome, SettledToEquilibrium)
    assert outcome.decay_rate == pytest.approx(0.05, rel=1e-6)
    np.testing.assert_allclose(outcome.equilibrium, 0.0, atol=1e-9)
    assert trajectory.events[-1].kind == "settled"


def test_cycle_with_two_maxima_a_period():
    """q = cos t + cos 2t has two maxima in 2 pi; the phase makes it a cycle of four states."""
    system = System.from_function(
        lambda z, p: [
            -z[2] - 2 * z[4],
            z[1] * (1 - z[1] ** 2 - z[2] ** 2) - z[2],
            z[2] * (1 - z[1] ** 2 - z[2] ** 2) + z[1],
            z[3] * (1 - z[3] ** 2 - z[4] ** 2) - 2 * z[4],
            p[0] * z[4] * (1 - z[3] ** 2 - z[4] ** 2) + 2 * z[3],
        ],
        ("q", "a", "b", "c", "d"),
        {"one": 1.0},
    )  # fmt: skip
    outcome = integrate(system, [2.0, 1.0, 0.0, 1.0, 0.0], 200.0, stop_when_settled=True).outcome
    assert isinstance(outcome, SettledToCycle)
    assert outcome.turns == 2
    assert outcome.period == pytest.approx(2 * math.pi, rel=1e-8)


def test_rest_at_an_unstable_equilibrium_and_away_from_zero():
    resting = integrate(van_der_pol(), [0.0, 0.0], 10.0, stop_when_settled=True).outcome
    assert isinstance(resting, SettledToEquilibrium)
    assert resting.decay_rate == pytest.approx(-0.5)
    offset = System.from_function(lambda z, p: [p[0] - z[0]], ("q",), {"c": 5.0})
    outcome = integrate(offset, [0.0], 100.0, stop_when_settled=True).outcome
    assert isinstance(outcome, SettledToEquilibrium)
    assert outcome.equilibrium[0] == pytest.approx(5.0, rel=1e-12)


def test_toy_wheelset_above_and_below_its_limit_point_of_cycles():
    """LPC at a3 = 100: v = 49.744661 (MATCONT, AUTO-07p); the large cycle exists only above."""
    start = [0.010, 0.0, 0.0, 0.0]
    system = toy_wheelset(v=50.1)
    above = integrate(system, start, 60.0, stop_when_settled=True)
    below = integrate(toy_wheelset(v=45.0), start, 60.0, stop_when_settled=True)
    small = integrate(system, [1e-3, 0.0, 0.0, 0.0], 1.0)
    assert isinstance(above.outcome, SettledToCycle)
    assert isinstance(below.outcome, SettledToEquilibrium)
    assert np.abs(small.x[-1, 0]) < 1e-3
    cycle = above.outcome
    again = solve_ivp(
        lambda t, z: system.rhs(z), (0, cycle.period), cycle.state, "LSODA",
        rtol=1e-11, atol=1e-15,
    )  # fmt: skip
    np.testing.assert_allclose(again.y[:, -1], cycle.state, atol=3e-6 * cycle.amplitude.max())
    assert 0.150 < cycle.period < 0.15308
    assert 0.008 < cycle.amplitude[0] < 0.011


# --- bad input -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"x0": [1.0]}, r"x0 has shape \(1,\).*q, v"),
        ({"x0": [1.0, math.nan]}, "x0 of v.*finite"),
        ({"t_end": 0.0}, "t_end = 0.0.*after t_start = 0"),
        ({"t_end": math.inf}, "t_end = inf"),
        ({"method": "Euler"}, "method = 'Euler'.*DOP853, RK45, Radau, BDF, LSODA"),
        ({"rtol": 0.0}, "rtol = 0.0.*1e-13"),
        ({"atol": [1e-9] * 3}, "atol = .*2 of them"),
        ({"atol": -1.0}, "atol = -1.0.*positive"),
        ({"max_step": 0.0}, "max_step = 0.0.*positive"),
        ({"settle_tol": 2.0}, "settle_tol = 2.0"),
        ({"section": "z"}, "section = 'z'.*q, v"),
        ({"p": [1.0, 2.0]}, r"p has shape \(2,\)"),
        ({"p": [math.inf]}, "p of w"),
        ({"events": (Crossing("a", "z"),)}, "state 'z'.*q, v"),
        ({"events": (ThresholdPair("q", 0.0, "in", "out"),)}, "level = 0.0.*positive"),
        ({"events": (Crossing("a", "q", 0.0, "sideways"),)}, "direction = 'sideways'"),
    ],
)
def test_bad_input_names_field_value_and_remedy(changes, words):
    arguments = {"x0": [1.0, 0.0], "t_end": 1.0, **changes}
    with pytest.raises(ValueError, match=words):
        integrate(oscillator(), arguments.pop("x0"), arguments.pop("t_end"), **arguments)


def test_progress_is_told():
    told: list[float] = []
    module.integrate(oscillator(), [1.0, 0.0], 5.0, progress=told.append)
    assert told == sorted(told)
    assert told[-1] == 1.0
