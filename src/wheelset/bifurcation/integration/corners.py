"""Integration of a piecewise smooth field: each region by itself, cut exactly at its corners.

In a region the field is smooth, so that a step which overshoots the corner is still a good step;
it is cut where the switching variable reaches the threshold, and the solver starts anew on the
other side. A corner that is only touched is not crossed.
"""

from __future__ import annotations

from collections.abc import Generator, Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from wheelset.bifurcation.integration.endings import Ending, Sliding
from wheelset.bifurcation.integration.plan import Plan
from wheelset.bifurcation.integration.step import ROUNDING, Step, sign_changes
from wheelset.bifurcation.integration.stepping import smooth_steps
from wheelset.bifurcation.system import System

Array = NDArray[np.float64]


#: Methods that lose nothing by starting anew.
ONE_STEP = ("DOP853", "RK45", "Radau")


@dataclass(frozen=True)
class Corner:
    """Where a step leaves its region: time, threshold number, +1 upward or -1 downward."""

    t: float
    threshold: int
    direction: int


@dataclass(frozen=True)
class Regions:
    """The smooth pieces of a field at parameters p; region k lies above k thresholds."""

    system: System
    p: Array
    variable: int
    thresholds: tuple[float, ...]
    values: tuple[float, ...]
    slot: int

    def number(self, x: Array) -> int:
        """Region of a state; one on a threshold belongs to the region below."""
        return sum(bool(x[self.variable] > threshold) for threshold in self.thresholds)

    def parameters(self, region: int) -> Array:
        """p with the region frozen."""
        p = self.p.copy()
        p[self.slot] = self.values[region]
        return p

    def snapped(self, x: Array, threshold: int) -> Array:
        """The state put exactly on a threshold."""
        on = x.copy()
        on[self.variable] = self.thresholds[threshold]
        return on

    def words(self, corner: Corner) -> str:
        """What was crossed, and which way."""
        name = self.system.state_names[self.variable]
        way = "upward" if corner.direction > 0 else "downward"
        return f"{name} = {self.thresholds[corner.threshold]:.6g} crossed {way}"


def regions(system: System, p: Array) -> Regions:
    """The regions of a piecewise smooth system."""
    switch = system.field.switch
    assert switch is not None
    smooth = System(
        replace(system.field, switch=None),
        {**system.values, switch.region.name: switch.values[0]},
        system.functions,
    )
    variable = system.field.state.index(switch.variable)
    thresholds = system.thresholds(p)
    slot = system.index(switch.region.name)
    return Regions(smooth, p, variable, thresholds, switch.values, slot)


@dataclass(frozen=True, eq=False)
class Front:
    """Where the integration stands before it goes on in a region.

    first: size of the step to try, s. crossed: words for the corner it stands on. refused: the
    region it has just left at once from here.
    """

    t: float
    x: Array
    region: int
    first: float | None = None
    crossed: str = ""
    refused: int | None = None


def piecewise_steps(plan: Plan, t: float, x: Array, t_end: float) -> Iterator[Step | Ending]:
    """Accepted steps, none across a corner, then how they ended."""
    pieces = regions(plan.system, plan.p)
    front: Front | None = Front(t, x, pieces.number(x))
    while front:
        front = yield from _in_region(plan, pieces, front, t_end)


def _in_region(
    plan: Plan, pieces: Regions, front: Front, t_end: float
) -> Generator[Step | Ending, None, Front | None]:
    """Steps in one region, the last one cut at its corner, or the ending; the front at the end."""
    p = pieces.parameters(front.region)
    for item in smooth_steps(plan, pieces.system, p, front.t, front.x, t_end, front.first):
        if isinstance(item, Ending):
            yield item
            return None
        corner = _exit(item, pieces, front.region)
        if corner:
            return (yield from _at_corner(plan, pieces, front, item, corner))
        yield replace(item, corner=front.crossed)
        front = replace(front, crossed="", refused=None)
    return None


def _at_corner(
    plan: Plan, pieces: Regions, front: Front, step: Step, corner: Corner
) -> Generator[Step | Ending, None, Front | None]:
    """Cut the step at the corner; the front from which it goes on in the region ahead.

    A motion that leaves the region ahead at once has only touched the corner and goes on in the
    region behind; if it leaves that one at once as well, the field holds it on the corner.
    """
    words, size, ahead = pieces.words(corner), step.t1 - step.t0, front.region + corner.direction
    if corner.t - step.t0 > 1e-12 * size + ROUNDING * abs(step.t0):
        cut = _cut(plan, pieces, front.region, step, corner)
        yield replace(cut, corner=front.crossed)
        return Front(cut.t1, cut.x1, ahead, size, words)
    if front.refused == ahead:
        yield Sliding(step.t0, step.x0, words)
        return None
    on = pieces.snapped(step.x0, corner.threshold)
    return Front(step.t0, on, ahead, size, refused=front.region)


def _cut(plan: Plan, pieces: Regions, region: int, step: Step, corner: Corner) -> Step:
    """The step ended on its corner.

    The dense output says where; it is of lower order than the formula, so that a one-step method
    repeats the step up to there, and what is left is a Newton correction of the time.
    """
    p = pieces.parameters(region)
    again = smooth_steps(plan, pieces.system, p, step.t0, step.x0, corner.t, corner.t - step.t0)
    landed = next(again) if plan.method in ONE_STEP else step
    if not (isinstance(landed, Step) and landed.t1 == corner.t):
        return replace(step, t1=corner.t, x1=pieces.snapped(step(corner.t), corner.threshold))
    f, jacobian = pieces.system.evaluate(landed.x1, p)
    miss = pieces.thresholds[corner.threshold] - landed.x1[pieces.variable]
    dt = miss / f[pieces.variable] if f[pieces.variable] else 0.0
    dt = dt if abs(dt) < 1e-3 * (landed.t1 - landed.t0) else 0.0  # a grazing corner: leave it
    x = landed.x1 + dt * f + dt**2 / 2 * jacobian @ f
    return replace(landed, t1=landed.t1 + dt, x1=pieces.snapped(x, corner.threshold))


def _exit(step: Step, pieces: Regions, region: int) -> Corner | None:
    """The first time a step leaves its region."""
    sides = ((region - 1, 1), (region, -1))  # threshold, sign of the distance to it inside
    corners = (
        _crossing(step, pieces, threshold, inside)
        for threshold, inside in sides
        if 0 <= threshold < len(pieces.thresholds)
    )
    return min((c for c in corners if c), key=lambda c: c.t, default=None)


def _crossing(step: Step, pieces: Regions, threshold: int, inside: int) -> Corner | None:
    level, i = pieces.thresholds[threshold], pieces.variable
    coefficients = step.coefficients[:, i].copy()
    coefficients[0] -= level
    size = abs(level) + float(np.abs(coefficients).sum())
    changes, _ = sign_changes(step, lambda t: float(step(t)[i]) - level, coefficients, inside, size)
    return Corner(changes[0].t, threshold, changes[0].direction) if changes else None
