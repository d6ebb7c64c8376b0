"""Where a walk along a curve stands, and where its next step leads."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from wheelset.bifurcation.curves.locate import Segment
from wheelset.bifurcation.curves.steps import Cubic, StepControl, cubic
from wheelset.bifurcation.curves.zero_problem import Point, Renewal, ZeroProblem

Array = NDArray[np.float64]
Window = tuple[float, float]

EVERYWHERE = (-math.inf, math.inf)


class Exit(NamedTuple):
    """A window that was left: which free parameter, its number, the bound."""

    parameter: str
    number: int
    bound: float

    @property
    def words(self) -> str:
        """The same in words."""
        return f"the window of {self.parameter} is left at {self.bound:.9g}"


class Start(NamedTuple):
    """Where a walk started: u, tangent (N,), and the plane row . x = offset across the curve."""

    u: Array
    tangent: Array
    row: Array
    offset: float

    def side(self, u: Array) -> float:
        """How far a point lies beyond the plane."""
        return float(self.row @ u) - self.offset


def start_of(u: Array, tangent: Array, metric: Array) -> Start:
    """The start of a walk from a point and its tangent."""
    row = metric * tangent
    return Start(u, tangent, row, float(row @ u))


@dataclass(eq=False)
class Front:
    """Where a walk stands: what it needs to go on as if never interrupted. Never changed.

    problem: renewed at the last point; u, tangent, start: in its unknowns. side: of the point,
    beyond the start. curve: the cubic of the last step. step: the next one.
    """

    control: StepControl
    windows: Mapping[str, Window]
    problem: ZeroProblem
    u: Array
    tangent: Array
    start: Start
    side: float
    curve: Cubic | None
    step: float

    def predicted(self, step: float) -> tuple[Array, Array]:
        """The next point and the direction there."""
        if self.curve is None:
            return self.u + step * self.tangent, self.tangent
        return self.curve.at(self.curve.length + step)

    def curve_to(self, point: Point) -> Cubic:
        """The cubic from here to a point of the same problem."""
        return cubic(self.u, self.tangent, point.u, point.tangent, self.problem.metric)

    def moved(self, point: Point, curve: Cubic, step: float, renewal: Renewal) -> Front:
        """The front at the next point, in the unknowns of the renewed problem."""
        side = self.start.side(point.u)
        problem = self.problem if renewal.transfer else renewal.problem
        front = Front(
            self.control, self.windows, problem, point.u, point.tangent, self.start, side, curve,
            step,
        )  # fmt: skip
        return front._transferred(renewal) if renewal.transfer else front

    def renewed(self, renewal: Renewal) -> Front:
        """The front in the unknowns of the renewed problem."""
        if renewal.transfer is not None:
            return self._transferred(renewal)
        same = renewal.problem is self.problem
        return self if same else replace(self, problem=renewal.problem)

    def _transferred(self, renewal: Renewal) -> Front:
        transfer, metric = renewal.transfer, renewal.problem.metric
        assert transfer is not None
        known, curve = [self.u, self.tangent, self.start.u, self.start.tangent], self.curve
        if curve is not None:
            known += [curve.data[0], curve.data[2]]
        u, tangent, first, sense, *before = transfer(np.array(known))
        tangent = tangent / math.sqrt(metric @ (tangent * tangent))
        if curve is not None:
            curve = cubic(before[0], before[1], u, tangent, metric)
        start = start_of(first, sense, metric)
        return Front(
            self.control, self.windows, renewal.problem, u, tangent, start, start.side(u), curve,
            self.step,
        )  # fmt: skip

    def exits(self, values: Array) -> list[Exit]:
        """The windows that values of the free parameters are outside of."""
        found = []
        for number, name in enumerate(self.problem.parameters):
            low, high = self.windows.get(name, EVERYWHERE)
            if not low <= values[number] <= high:
                found.append(Exit(name, number, low if values[number] < low else high))
        return found

    def passes_start(self, point: Point) -> bool:
        """Whether the way to a point crosses, forward, the plane across the curve at its start."""
        return self.side < 0.0 <= self.start.side(point.u)

    def segment(self, last: Point) -> Segment:
        """The curve to a point, from a beginning that this problem linearises anew."""
        first = Point(self.problem, self.u, self.tangent)
        return Segment(first, last, self.curve_to(last).length, self.control)
