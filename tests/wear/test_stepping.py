"""Steps over the distance: against an equation whose solution is known."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest

from wheelset.wear.errors import StepTooSmall
from wheelset.wear.stepping import Stepping, begin, go, next_state, reach_depth

K, LIMIT = np.array([1.0, 0.4]) * 1e-10, 1e-3


def rate(depth):
    """d' = k (1 - d/limit): d = limit (1 - exp(-k s/limit))."""
    return K * (1 - depth / LIMIT)


def exact(distance):
    return LIMIT * (1 - np.exp(-K * distance / LIMIT))


def run(stop, stepping):
    states = [begin(rate, np.zeros(2))]
    while states[-1].distance < stop:
        states.append(next_state(rate, states[-1], stop, stepping))
    return states


def test_the_solution_is_met_and_the_stop_is_exact():
    states = run(1e7, Stepping(3e-5, 1e-7))
    assert states[-1].distance == 1e7
    # 35 steps of an error that the second order leaves far below the first's 1e-7
    assert states[-1].depth == pytest.approx(exact(1e7), abs=1e-7)


def test_steps_obey_both_bounds():
    stepping = Stepping(3e-5, 1e-7)
    states = run(1e7, stepping)
    assert max(state.error for state in states) <= 1e-7
    grown = [b.greatest - a.greatest for a, b in pairwise(states)]
    assert max(grown) <= 3e-5
    assert [s.number for s in states] == list(range(len(states)))


def test_halved_steps_quarter_the_error():
    errors = []
    for largest in (4e-5, 2e-5):
        last = run(5e6, Stepping(largest, 1e-4))[-1]
        errors.append(abs(last.depth - exact(5e6)).max())
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.25)


def test_a_depth_is_reached_between_two_states():
    states = run(1e7, Stepping(1e-5, 1e-7))
    target = 0.5 * (states[4].greatest + states[5].greatest)
    found = reach_depth(rate, states[4], states[5], target)
    assert found.greatest == pytest.approx(target, rel=1e-10)
    assert found.distance == pytest.approx(-LIMIT / K[0] * math.log(1 - target / LIMIT), rel=1e-4)


def test_one_step_goes_to_a_distance_exactly():
    states = run(1e7, Stepping(1e-5, 1e-7))
    found = go(rate, states[3], 0.5 * (states[3].distance + states[4].distance))
    assert found.depth == pytest.approx(exact(found.distance), abs=1e-9)


def test_a_rate_that_no_step_resolves_is_an_outcome():
    def jumpy(depth):
        return np.array([1e-10 if depth[0] == 0 else 1e-7])

    with pytest.raises(StepTooSmall, match="loosen the tolerance"):
        next_state(jumpy, begin(jumpy, np.zeros(1)), math.inf, Stepping(1e-5, 1e-9))


def test_out_of_range_is_named():
    with pytest.raises(ValueError, match="largest = 1 is out of range"):
        Stepping(largest=1.0)
