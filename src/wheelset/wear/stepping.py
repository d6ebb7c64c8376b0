"""Steps over the distance run: from one worn shape to the next, and how long they may be.

One step of the whole length and two of half of it are compared: with ``k`` the rate of depth,

    whole = d + h k(d),    halves = d + h/2 k(d) + h/2 k(m),    m = d + h/2 k(d)

their difference is the error held below a bound, and ``2 halves - whole = d + h k(m)``, in which
the difference cancels to second order, is kept.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from scipy.optimize import brentq

from wheelset.wear.errors import StepTooSmall
from wheelset.wear.patch import Array
from wheelset.wear.ranges import within

#: Depth per distance [m/m] of a worn shape, from its depth [m].
Rate = Callable[[Array], Array]

#: Bounds of the growth of a step, its safety, and the least share of the step allowed by depth.
GROWTH, SAFETY, LEAST = (0.25, 2.0), 0.9, 1e-4


@dataclass(frozen=True)
class Stepping:
    """largest: greatest depth of a step, m. error: greatest difference between the two ways, m."""

    largest: float = 3e-5
    error: float = 1e-6

    def __post_init__(self) -> None:
        within("largest", self.largest, 1e-8, 1e-3, "m")
        within("error", self.error, 1e-9, 1e-4, "m")


@dataclass(frozen=True, eq=False)
class State:
    """A worn shape: depth [m] and its rate [m/m] over the wheel's y, at a distance [m].

    step: the next one the error allows, m. error: of the last step, m. number: of steps so far.
    """

    distance: float
    depth: Array
    rate: Array
    step: float
    error: float = 0.0
    number: int = 0

    @property
    def greatest(self) -> float:
        """Greatest depth, m."""
        return float(self.depth.max())


def begin(rate: Rate, depth: Array) -> State:
    """The state before the first step."""
    return State(0.0, depth, rate(depth), math.inf)


def next_state(rate: Rate, state: State, stop: float, stepping: Stepping) -> State:
    """After one step, shortened until its error is small, no further than ``stop`` [m].

    Raises StepTooSmall.
    """
    left, longest = stop - state.distance, _by_depth(state, stepping)
    step = min(state.step, longest, left)
    while True:
        depth, error = _stepped(rate, state, step)
        grown = SAFETY * math.sqrt(stepping.error / max(error, 1e-300))
        proposed = step * min(max(grown, GROWTH[0]), GROWTH[1])
        if error <= stepping.error:
            break
        if step < LEAST * longest:
            raise StepTooSmall(state.distance * 1e-3, step * 1e-3, error)
        step = proposed
    distance = stop if step == left else state.distance + step
    return State(distance, depth, rate(depth), proposed, error, state.number + 1)


def go(rate: Rate, state: State, distance: float) -> State:
    """The state at a distance [m] by one step, for one no longer than an accepted one."""
    depth, error = _stepped(rate, state, distance - state.distance)
    return State(distance, depth, rate(depth), state.step, error, state.number + 1)


def reach_depth(rate: Rate, before: State, after: State, target: float) -> State:
    """The state between two at which the greatest depth is ``target`` [m]."""

    def miss(step: float) -> float:
        return float(_stepped(rate, before, step)[0].max()) - target

    length = after.distance - before.distance
    step = brentq(miss, 0.0, length, xtol=1e-12 * length, rtol=1e-12)
    return go(rate, before, before.distance + step)


def _by_depth(state: State, stepping: Stepping) -> float:
    return stepping.largest / max(float(state.rate.max()), 1e-300)


def _stepped(rate: Rate, state: State, step: float) -> tuple[Array, float]:
    """Depth after a step of the second order, and the greatest difference of the two ways."""
    middle = rate(state.depth + 0.5 * step * state.rate)
    error = 0.5 * step * float(abs(middle - state.rate).max())
    return state.depth + step * middle, error
