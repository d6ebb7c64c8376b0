"""Newton's method onto a curve, and zeros of a function between two points of it."""

from __future__ import annotations

import bisect
import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from wheelset.bifurcation.curves.steps import StepControl, cubic
from wheelset.bifurcation.curves.vectors import corrected_by, distance
from wheelset.bifurcation.curves.zero_problem import Linearisation, Point, ZeroProblem
from wheelset.bifurcation.outcomes import NoConvergence, NumericalOutcome

Array = NDArray[np.float64]

#: Zeros are located to this arclength, relative to the step, and points on the way corrected to it.
LOCATED = 1e-11

#: Arclengths below this, relative to 1 + |u|, are not told apart.
ROUNDING = 4e-16

#: In a bracket this narrow, relative to the step, the cubic through its ends is the curve: the
#: error falls with the fourth power. Nothing is solved there, where a branch point may lie.
NARROW = 1e-3

#: A function that does not fall this far between its ends and its zero has a pole or a jump.
SMALL = 1e-2

#: A point between lies this near to the cubic, relative to the step, or on another curve; its
#: tangent turns by ten times this at most, rad.
AWAY = 0.05

#: Where in a narrow bracket the curve is checked.
PLACE = 0.37


@dataclass(eq=False)
class Gap(NumericalOutcome):
    """Two points of a step are not joined by a curve that can be computed; words say why."""

    words: str

    def __str__(self) -> str:
        return f"the step does not stay on one curve: {self.words}"


class Corrected(NamedTuple):
    """A point of the curve: size of the first correction, the same relative to 1 + |u|, and the
    number of iterations.
    """

    point: Point
    distance: float
    error: float
    iterations: int


def corrected(
    problem: ZeroProblem,
    predicted: Array,
    direction: Array,
    wanted: float,
    iterations: int,
    enough: float = 0.0,
) -> Corrected:
    """The point of the curve that Newton's method reaches across a direction (N,).

    wanted: the last correction, relative to 1 + |u|. enough: a larger one that is accepted when
    the corrections no longer shrink, as beside a branch point, where rounding is magnified.
    Raises NoConvergence with the residuals, or the outcome met on the way.
    """
    metric, u = problem.metric, predicted
    row, scale = metric * direction, 0.0
    sizes: list[float] = []
    met: list[Linearisation] = []
    for _ in range(iterations):
        met.append(problem.linearised(u))
        u, tangent, size, step = corrected_by(u, *met[-1].newton(row), metric)
        scale = scale or 1 + size
        sizes.append(step / scale)
        if sizes[-1] <= wanted or _stalled(sizes, enough):
            point = Point(problem, u, tangent, met[-1])
            return Corrected(point, sizes[0] * scale, sizes[0], len(sizes))
        if not sizes[-1] < 2 * sizes[0]:
            break
    residuals = tuple(float(np.linalg.norm(lin.residual)) for lin in met)
    raise NoConvergence("Newton's method for a point of the curve", residuals)


def _stalled(sizes: list[float], enough: float) -> bool:
    return len(sizes) > 1 and enough >= sizes[-1] > sizes[-2] / 2


def unit_tangent(linearisation: Linearisation, row: Array, metric: Array) -> Array:
    """The curve's direction (N,), of length one, on the positive side of a row."""
    _, tangent = linearisation.newton(row)
    return np.asarray(tangent / math.sqrt(metric @ (tangent * tangent)))


def any_tangent(linearisation: Linearisation, metric: Array) -> Array:
    """The curve's direction (N,), of length one, in either sense."""
    anywhere = np.sqrt(metric) * np.cos(1.0 + np.arange(len(metric)))  # along no curve, or nearly
    return unit_tangent(linearisation, anywhere, metric)


class Found(NamedTuple):
    """Where on a segment: arclength from its first point, the point, the function's value."""

    s: float
    point: Point
    value: float


@dataclass(eq=False)
class Segment:
    """The curve between two points; what was computed on it is kept and predicts the rest.

    places: arclengths of the points that were solved for.
    """

    first: Point
    last: Point
    length: float
    control: StepControl
    points: dict[float, Point] = field(init=False)
    places: list[float] = field(init=False)

    def __post_init__(self) -> None:
        self.points = {0.0: self.first, self.length: self.last}
        self.places = [0.0, self.length]

    @property
    def trials(self) -> int:
        """Points computed on the way."""
        return len(self.points) - 2

    @property
    def width(self) -> float:
        """Arclength to which a zero is located."""
        u, metric = self.last.u, self.last.problem.metric
        return max(LOCATED * self.length, ROUNDING * (1 + math.sqrt(metric @ (u * u))))

    def at(self, s: float) -> Point:
        """The point at arclength s; raises Gap where it cannot be computed."""
        if s not in self.points:
            try:
                self.points[s] = self._between(s)
            except NumericalOutcome as outcome:
                raise Gap(str(outcome)) from outcome
        return self.points[s]

    def _between(self, s: float) -> Point:
        """Predicted by the cubic between the nearest known points; corrected where they are far."""
        i = min(max(bisect.bisect(self.places, s), 1), len(self.places) - 1)
        low, high = self.places[i - 1], self.places[i]
        a, b = self.points[low], self.points[high]
        problem, metric = b.problem, b.problem.metric
        curve = cubic(a.u, a.tangent, b.u, b.tangent, metric)
        predicted, direction = curve.at((s - low) / (high - low) * curve.length)
        if high - low <= NARROW * self.length:
            tangent = direction / math.sqrt(metric @ (direction * direction))
            return Point(problem, predicted, tangent)
        most, enough = self.control.iterations + 2, self.control.tolerance
        found = corrected(problem, predicted, direction, LOCATED, most, enough)
        turned = distance(found.point.tangent, direction, metric)
        if max(found.distance / self.length, turned / 10) > AWAY:
            raise Gap(f"a point between lies {found.distance:.1e} away from the cubic")
        bisect.insort(self.places, s)  # only here: a chord much shorter would have no direction
        return found.point

    def zero(self, f: Callable[[Point], float], start: float, end: float) -> Found:
        """The zero of a function that has the given values, of opposite sign, at the ends.

        Raises Gap where the curve between cannot be computed, or what f raises.
        """
        known = {0.0: start, self.length: end}

        def value(s: float) -> float:
            if s not in known:
                known[s] = f(self.at(s))
            return known[s]

        low, high = self._narrowed(value)
        self._check_connected(low, high)
        s = float(brentq(value, low, high, xtol=self.width, rtol=1e-14))
        return Found(s, self.at(s), value(s))

    def _narrowed(self, value: Callable[[float], float]) -> tuple[float, float]:
        """A bracket so narrow that the cubic through its ends is the curve.

        Probes on both sides of where the chord crosses zero, and the middle if that was no use.
        """
        low, high = 0.0, self.length
        while high - low > NARROW * self.length:
            width, margin = high - low, 0.45 * NARROW * self.length
            guess = low + width * value(low) / (value(low) - value(high))
            for probe in (guess - margin, guess + margin):
                low, high = _halved(value, low, high, probe)
            if high - low > width / 2:
                low, high = _halved(value, low, high, (low + high) / 2)
        return low, high

    def _check_connected(self, low: float, high: float) -> None:
        """Raise Gap where the cubic through the ends of a narrow bracket is not the curve.

        Newton's method says so at a place off the middle, where a branch point is no accident.
        """
        point = self.at(low + PLACE * (high - low))
        step, _ = point.linearisation.newton(point.row)
        away = math.sqrt(point.problem.metric @ (step * step))
        if not away <= NARROW * (high - low) + self.width:
            raise Gap(f"another curve comes as near as {away:.1e}")


def _halved(
    value: Callable[[float], float], low: float, high: float, s: float
) -> tuple[float, float]:
    """The part of a bracket, cut at s, in which the sign changes."""
    if not low < s < high:
        return low, high
    return (low, s) if opposite(value(low), value(s)) else (s, high)


def opposite(old: float, new: float) -> bool:
    """Whether a value changes sign, or becomes zero."""
    return old != 0.0 and (new == 0.0 or (old > 0.0) != (new > 0.0))


def is_zero(found: Found, start: float, end: float) -> bool:
    """Whether a change of sign is a zero, and not a pole or a jump."""
    return abs(found.value) <= SMALL * max(abs(start), abs(end))
