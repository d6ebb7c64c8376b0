"""Motions of a vehicle's wheelset: what theory says about them, and contact with the flange."""

from __future__ import annotations

import math

import numpy as np
import pytest

from wheelset.bifurcation.integration.endings import (
    LeftDomain,
    SettledToCycle,
    SettledToEquilibrium,
)
from wheelset.bifurcation.integration.events import Crossing, ThresholdPair
from wheelset.bifurcation.integration.integrate import integrate
from wheelset.bifurcation.system import System
from wheelset.hunting import hunting_system
from wheelset.vehicle import load_vehicle

ETA = 0.00923
CONTACT = ThresholdPair("y", ETA, "flange contact entered", "flange contact left")
START = [0.003, 0.0, 0.0, 0.0]


def system(*overrides: str) -> System:
    return hunting_system(load_vehicle("guo2021", overrides=list(overrides)))


def test_small_motion_at_the_hopf_point_has_its_frequency():
    """Set M1: v = 51.70606841 m/s, w = 40.97664584 rad/s; at 1 nm the motion is linear."""
    s = system()
    events = (Crossing("up", "y", 0.0, "up"),)
    p = s.p(v=51.70606841)
    found = integrate(s, [1e-9, 0, 0, 0], 3.0, p=p, events=events, rtol=1e-11).events
    period = np.diff([e.t for e in found])[-10:]
    np.testing.assert_allclose(period, 2 * math.pi / 40.97664584, rtol=1e-8)
    heights = np.array([e.state[2] for e in found])[-10:]
    np.testing.assert_allclose(heights, heights[0], rtol=1e-6)


def test_below_the_hopf_speed_the_motion_dies_at_the_rate_of_its_eigenvalue():
    s = system()
    outcome = integrate(s, START, 60.0, p=s.p(v=40.0), stop_when_settled=True).outcome
    assert isinstance(outcome, SettledToEquilibrium)
    rate = -np.linalg.eigvals(s.jacobian(np.zeros(4), s.p(v=40.0))).real.max()
    assert outcome.decay_rate == pytest.approx(rate, rel=1e-6)
    np.testing.assert_allclose(outcome.equilibrium, 0.0, atol=1e-12)


def test_supercritical_set_hunts_with_the_amplitude_of_its_normal_form():
    """a^2 = -Re lambda / FLC near the Hopf point, amplitude 2 a |q| (FLC = -23.255255)."""
    s = system()
    p = s.p(v=52.1)
    values, vectors = np.linalg.eig(s.jacobian(np.zeros(4), p))
    leading = np.argmax(values.real)
    q = np.abs(vectors[:, leading]) / np.linalg.norm(vectors[:, leading])
    predicted = 2 * math.sqrt(values[leading].real / 23.255255) * q
    start = predicted * [1.02, 0, 0, 0]
    outcome = integrate(
        s, start, 60.0, p=p, rtol=1e-8, settle_tol=3e-3, stop_when_settled=True
    ).outcome
    assert isinstance(outcome, SettledToCycle)
    np.testing.assert_allclose(outcome.amplitude, predicted, rtol=0.03)


def test_without_a_flange_the_curvature_sum_ends_the_motion():
    """e1 + f1 and e3 + f3 of set M1 bound |y| at 11.65 mm."""
    s = system("a3=200", "flange_law=none")
    trajectory = integrate(s, START, 20.0, p=s.p(v=53.0))
    outcome = trajectory.outcome
    assert isinstance(outcome, LeftDomain)
    assert "curvature" in outcome.cause.quantity
    assert outcome.cause.where in ("left wheel", "right wheel")
    assert abs(trajectory.x[-1, 0]) == pytest.approx(0.01165, abs=1e-5)
    assert "right wheel" in str(outcome) if outcome.state[0] > 0 else "left wheel" in str(outcome)


@pytest.fixture(scope="module")
def against_the_flange():
    s = system("a3=200", "flange_law=piecewise_linear")
    return integrate(s, [0.008, 0, 0, 0], 1.0, p=s.p(v=55.0), events=(CONTACT,))


def test_contact_is_entered_and_left_in_turn_at_the_clearance(against_the_flange):
    contact = [e for e in against_the_flange.events if e.kind in ("entered", "left")]
    assert len(contact) >= 8
    assert [e.kind for e in contact] == ["entered", "left"] * (len(contact) // 2)
    assert all(abs(e.state[0]) == ETA for e in contact)
    assert all(e.state[0] * e.state[2] > 0 for e in contact if e.kind == "entered")
    assert {np.sign(e.state[0]) for e in contact} == {-1.0, 1.0}


def test_every_corner_of_the_law_is_an_event_and_a_point(against_the_flange):
    corners = [e for e in against_the_flange.events if e.kind == "corner"]
    contact = [e for e in against_the_flange.events if e.kind in ("entered", "left")]
    assert [e.t for e in corners] == [e.t for e in contact]
    assert {e.t for e in corners} <= set(against_the_flange.t.tolist())


@pytest.mark.parametrize("method", ["LSODA", "RK45"])
def test_corners_do_not_depend_on_the_method(against_the_flange, method):
    plan = against_the_flange.plan
    other = integrate(
        plan.system, against_the_flange.x[0], 1.0, p=plan.p, events=(CONTACT,), method=method
    )
    np.testing.assert_allclose(
        [e.t for e in other.events], [e.t for e in against_the_flange.events], atol=1e-6
    )
    np.testing.assert_allclose(other.x[-1], against_the_flange.x[-1], rtol=1e-4)


@pytest.mark.parametrize("law", ["none", "piecewise_linear", "exponential"])
def test_the_mirrored_start_gives_the_mirrored_motion(law):
    s = system("a3=200", f"flange_law={law}")
    start = np.array([0.008, 0.001, 0.0, 0.0])
    left = integrate(s, start, 0.6, p=s.p(v=53.0), events=(CONTACT,))
    right = integrate(s, -start, 0.6, p=s.p(v=53.0), events=(CONTACT,))
    times = np.linspace(0.0, 0.6, 200)
    size = np.abs(left.x).max(axis=0)
    np.testing.assert_allclose(left(times) / size, -right(times) / size, atol=3e-7)
    assert [e.kind for e in left.events] == [e.kind for e in right.events]
    np.testing.assert_allclose([e.t for e in left.events], [e.t for e in right.events], rtol=1e-6)
