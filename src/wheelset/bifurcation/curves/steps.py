"""Predictors along a curve, and how far to step: by the error the corrector finds."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from wheelset.bifurcation.curves.vectors import hermite, on_cubic

Array = NDArray[np.float64]

#: A step grows at most this much, and shrinks to this when refused: not to one half, which could
#: land on the same singular point again and again.
GROWTH, SHRINK = 2.0, 0.6

#: Between two points that cannot be told apart.
NO_LENGTH = 1e-100

#: Below this change a step counts as kept, in the log.
KEPT = 1.05


@dataclass(frozen=True)
class StepControl:
    """How a curve is walked; lengths in the problem's scaled norm.

    first, least, most: step lengths. tolerance: a point is accepted when the last correction,
    relative to 1 + |u|, is below it (convergence is quadratic, so its square is what is left).
    error: the predictor's error aimed at, relative alike. iterations: of Newton's method, at most.
    turn: largest angle between successive tangents, rad.
    """

    first: float = 0.01
    least: float = 1e-8
    most: float = 0.1
    tolerance: float = 1e-7
    error: float = 2e-4
    iterations: int = 6
    turn: float = 0.5

    def __post_init__(self) -> None:
        for field in fields(self):
            if not getattr(self, field.name) > 0:
                value = getattr(self, field.name)
                raise ValueError(f"{field.name} = {value!r}: has to be positive; give one that is")
        if not self.least <= self.first <= self.most:
            raise ValueError(
                f"steps least = {self.least:g}, first = {self.first:g}, most = {self.most:g}: "
                "have to increase in this order; change one of them"
            )

    def next_step(self, step: float, error: float, turned: float, gap: float | None) -> float:
        """The step to try after an accepted one.

        error: of its prediction. turned: angle between its tangents, rad. gap: length of the step
        before it, which the prediction was extrapolated from; None for a prediction by tangent.
        A cubic extrapolated over s from a step h errs by s^2 (s + h)^2, a tangent by s^2.
        """
        if gap is None:
            wanted = step * math.sqrt(self.error / max(error, 1e-300))
        else:
            reach = step * (step + gap) * math.sqrt(self.error / max(error, 1e-300))
            wanted = (math.sqrt(step * step + 4 * reach) - step) / 2
        wanted = min(wanted, GROWTH * step, self.most, 0.8 * self.turn / max(turned, 1e-300) * step)
        return max(wanted, SHRINK * step, self.least)


@dataclass(eq=False)
class Cubic:
    """The cubic through two points with their unit tangents, by arclength from the first one.

    data (4, N): first point, second point, first tangent, second tangent. length: between them.
    turn: angle between the tangents, rad (its chord).
    """

    data: Array
    length: float
    turn: float

    def at(self, s: float) -> tuple[Array, Array]:
        """Point and derivative (N,) at arclength s, which may lie beyond the second point."""
        place, direction = on_cubic(self.data, self.length, s)
        return place, direction


def cubic(
    start: Array, start_tangent: Array, end: Array, end_tangent: Array, metric: Array
) -> Cubic:
    """The cubic between two points of a curve.

    Its length is the chord c stretched to the arc: c (1 + |t1 - t0|^2 / 24), exact to fifth order
    where the curvature is constant.
    """
    data, chord, turn = hermite(start, start_tangent, end, end_tangent, metric)
    return Cubic(data, max(chord * (1 + turn * turn / 24), NO_LENGTH), turn)


def word(old: float, new: float) -> str:
    """What happened to a step."""
    return "grown" if new > KEPT * old else "shrunk" if new * KEPT < old else "kept"
