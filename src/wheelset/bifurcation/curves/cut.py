"""Where a walk ends within a step: at the bound of a window, or where the curve closes."""

from __future__ import annotations

import math
from typing import NamedTuple

from wheelset.bifurcation.curves.branch import Ending
from wheelset.bifurcation.curves.front import Exit, Front
from wheelset.bifurcation.curves.locate import Found, Segment, opposite
from wheelset.bifurcation.curves.zero_problem import Point

#: How near a curve has to come to its start to be closed, relative to 1 + |u|.
SAME = 1e-6


class Cut(NamedTuple):
    """An ending within a step: at which arclength and point, and points computed to find it."""

    s: float
    point: Point
    ending: Ending
    trials: int


def cut(front: Front, last: Point, exits: list[Exit]) -> Cut | None:
    """The first ending on the way to a point that left some windows; None if there is none.

    At arclength 0 for a walk that stands on a bound and goes outward.
    """
    closing = front.passes_start(last)
    if not (exits or closing):
        return None
    segment = front.segment(last)
    found = [(_at_bound(segment, e), Ending("window", e.words)) for e in exits]
    if closing and (start := _at_start(segment, front)):
        found.append((start, Ending("closed", "the curve returned to its start")))
    if not found:
        return None
    place, ending = min(found, key=lambda f: f[0].s)
    return Cut(place.s, place.point, ending, segment.trials)


def _at_bound(segment: Segment, passed: Exit) -> Found:
    """Where a window is left; at the segment's first point if that stands on the bound."""

    def beyond(point: Point) -> float:
        return float(point.problem.values(point.u)[passed.number]) - passed.bound

    start, end = beyond(segment.first), beyond(segment.last)
    if not opposite(start, end):
        return Found(0.0, segment.first, start)
    return segment.zero(beyond, start, end)


def _at_start(segment: Segment, front: Front) -> Found | None:
    """Where the curve meets the start of the walk; None if it only passes it."""
    u, row = front.start.u, front.start.row

    def side(point: Point) -> float:
        return float(row @ (point.u - u))

    found = segment.zero(side, side(segment.first), side(segment.last))
    metric, away = front.problem.metric, found.point.u - u
    near = SAME * (1 + math.sqrt(metric @ (u * u)))
    return found if math.sqrt(metric @ (away * away)) <= near else None
