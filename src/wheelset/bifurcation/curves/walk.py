"""One walk along a curve, step by step: predict, correct, look for what was passed, and end."""

from __future__ import annotations

import logging
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from wheelset.bifurcation.curves.branch import Branch, BranchPoint, Ending
from wheelset.bifurcation.curves.cut import cut
from wheelset.bifurcation.curves.front import Front
from wheelset.bifurcation.curves.locate import corrected
from wheelset.bifurcation.curves.special import (
    Candidate,
    at_point,
    changed,
    on_segment,
    zero_at_start,
)
from wheelset.bifurcation.curves.steps import SHRINK, Cubic, word
from wheelset.bifurcation.curves.vectors import distance as chord
from wheelset.bifurcation.curves.zero_problem import Point, Renewal
from wheelset.bifurcation.outcomes import DomainLeft, NotFinite, NumericalOutcome

Array = NDArray[np.float64]

logger = logging.getLogger(__name__)

#: A prediction this many times worse than aimed at is refused, even if Newton's method converged.
FAR = 50.0

#: An unpredicted turn of the tangent, rad, beyond so many times what the prediction's error e over
#: a step s explains (e = O(s^4) turns by 4 e/s): the point lies so near a branch point that its
#: tangent is rounding, or on another curve.
SURPRISE, EXPLAINED = 0.1, 20.0

#: The numbers a branch keeps of its walk.
COUNTED = ("steps", "refused", "grown", "kept", "shrunk", "iterations", "trials")


@dataclass(eq=False)
class Misjudged(NumericalOutcome):
    """A step led to a point of the curve, perhaps, but not to the next one."""

    words: str

    def __str__(self) -> str:
        return self.words


class Arrival(NamedTuple):
    """A point with all that its problem says about it."""

    point: Point
    values: Array
    tests: Mapping[str, float]
    solution: Any
    renewal: Renewal
    ended: str


def arrival(point: Point) -> Arrival:
    """Ask the problem about a point."""
    problem, u = point.problem, point.u
    return Arrival(
        point, problem.values(u), problem.tests(point), problem.solution(point),
        problem.renewed(point), problem.ended(point),
    )  # fmt: skip


class Attempt(NamedTuple):
    """A step that succeeded: where it led, the cubic to there, its length (0: it ends at once), the
    next one wanted, the Newton iterations it took, how the walk ends in it, what was passed.
    """

    here: Arrival
    curve: Cubic
    step: float
    wanted: float
    iterations: int
    ending: Ending | None = None
    found: tuple[Candidate, ...] = ()


class Walk:
    """A walk that is under way: what a branch is made of, until the walk is over."""

    def __init__(self, branch: Branch) -> None:
        self.branch = branch
        self.front: Front = branch.state
        self.points = list(branch.points)
        self.special, self.artefacts = list(branch.special), list(branch.artefacts)
        self.counts = dict.fromkeys(COUNTED, 0) | dict(branch.statistics)
        self.ended = None if branch.ended.kind == "steps" else branch.ended

    def so_far(self) -> Branch:
        """The branch as it stands."""
        words = f"{len(self.points) - 1} steps done, as many as asked for"
        return replace(
            self.branch,
            points=tuple(self.points),
            special=tuple(self.special),
            artefacts=tuple(self.artefacts),
            ended=self.ended or Ending("steps", words),
            statistics=self.counts.copy(),
            state=self.front,
        )

    def advance(self) -> None:
        """One accepted step, or the ending."""
        try:
            tried = self._attempt()
        except NumericalOutcome as outcome:
            self.ended = _failure(outcome, self.front.control.least)
            return
        self.ended = tried.ending
        if tried.step:
            self._keep(tried.found)
            self._accept(tried)

    def _attempt(self) -> Attempt:
        """The step asked for, or the longest of ever shorter ones that succeeds."""
        step, whole = self.front.step, True
        while True:
            try:
                return self._look(self._cut(self._try(step, whole)))
            except NumericalOutcome as outcome:
                self.counts["refused"] += 1
                logger.debug("step %.3g refused: %s", step, outcome)
                if step * SHRINK < self.front.control.least:
                    raise
            step, whole = step * SHRINK, False

    def _try(self, step: float, whole: bool) -> Attempt:
        front, control = self.front, self.front.control
        predicted, direction = front.predicted(step)
        point, distance, error, iterations = corrected(
            front.problem, predicted, direction, control.tolerance, control.iterations
        )
        curve = front.curve_to(point)
        surprise = chord(point.tangent, direction, front.problem.metric)  # the angle, if small
        if error > FAR * control.error:
            raise Misjudged(f"the prediction is off by {error:.1e}")
        if curve.turn > control.turn or surprise > SURPRISE + EXPLAINED * distance / step:
            words = f"the tangent turns by {curve.turn:.2g} rad, {surprise:.2g} unpredicted"
            raise Misjudged(words)
        gap = None if front.curve is None else front.curve.length
        wanted = control.next_step(step, error, curve.turn, gap)
        wanted = wanted if whole else min(wanted, step)
        return Attempt(arrival(point), curve, step, wanted, iterations)

    def _cut(self, tried: Attempt) -> Attempt:
        """The step up to where the walk ends in it, if it does; of length 0 if it ends at once."""
        front, here = self.front, tried.here
        ends = cut(front, here.point, front.exits(here.values))
        if ends is None:
            return tried
        self.counts["trials"] += ends.trials
        curve = front.curve_to(ends.point)
        return tried._replace(
            here=arrival(ends.point), curve=curve, step=ends.s, ending=ends.ending
        )

    def _look(self, tried: Attempt) -> Attempt:
        """The step with what the test functions say about it."""
        index, old, new = len(self.points) - 1, self.points[-1].tests, tried.here.tests
        starting = zero_at_start(old, new) if self.front.curve is None else []
        crossed = [name for name in changed(old, new) if name not in starting]
        if not (starting or crossed):
            return tried
        segment = self.front.segment(tried.here.point)
        candidates = [at_point(segment.first, name, 0.0) for name in starting]
        candidates += [on_segment(segment, name, index) for name in crossed]
        self.counts["trials"] += segment.trials
        return tried._replace(found=tuple(candidates))

    def _keep(self, candidates: tuple[Candidate, ...]) -> None:
        for special, artefact in sorted(candidates, key=lambda c: c.special.index):
            (self.artefacts if artefact else self.special).append(special)
            logger.debug("%s: %s", special.kind or "artefact", special.words)

    def _accept(self, tried: Attempt) -> None:
        (point, values, tests, solution, renewal, ended), curve, step, wanted, iterations, *_ = (
            tried
        )
        length = self.points[-1].arclength + curve.length
        self.points.append(
            BranchPoint(point.u, point.tangent, values, solution, tests, length, step)
        )
        decision, counts = word(step, wanted), self.counts
        counts["steps"] += 1
        counts[decision] += 1
        counts["iterations"] += iterations
        logger.debug("step %.3g accepted, %s to %.3g", step, decision, wanted)
        self.front = self.front.moved(point, curve, wanted, renewal)
        if ended and self.ended is None:
            self.ended = Ending("problem", ended)


def _failure(outcome: NumericalOutcome, least: float) -> Ending:
    kinds = {DomainLeft: "domain", NotFinite: "not finite"}
    return Ending(
        kinds.get(type(outcome), "least step"),
        f"{outcome}; the step would have to be below {least:.1e}",
    )
