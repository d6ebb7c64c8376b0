"""Special points on one step of a walk: sign changes of test functions, located and named."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

from wheelset.bifurcation.curves.branch import SpecialPoint
from wheelset.bifurcation.curves.locate import Found, Gap, Segment, is_zero, opposite
from wheelset.bifurcation.curves.zero_problem import Finding, Point
from wheelset.bifurcation.outcomes import NumericalOutcome

#: A test function this small at the start of a walk, relative to the next point, is zero there.
ZERO_AT_START = 1e-8


@dataclass(eq=False)
class Undefined(NumericalOutcome):
    """A test function without a value at a point between two where it has one."""

    name: str

    def __str__(self) -> str:
        return f"{self.name} has no value between"


class Candidate(NamedTuple):
    """What a change of sign turned out to be; an artefact is kept apart."""

    special: SpecialPoint
    artefact: bool


def changed(old: Mapping[str, float], new: Mapping[str, float]) -> list[str]:
    """Names of the test functions that change sign between two points, or vanish at the second."""
    return [name for name, value in new.items() if name in old and opposite(old[name], value)]


def zero_at_start(old: Mapping[str, float], new: Mapping[str, float]) -> list[str]:
    """Names of the test functions that are zero, but for rounding, where a walk starts."""
    return [
        name
        for name, value in new.items()
        if name in old and value != 0.0 and abs(old[name]) <= ZERO_AT_START * abs(value)
    ]


def on_segment(segment: Segment, name: str, index: int) -> Candidate:
    """Where a test function changes sign on a step, and what is there.

    The step's own problem evaluates both ends, since the one before it may scale its test
    functions otherwise. index: number of the point the step starts from. Raises Gap where the step
    does not stay on one curve.
    """
    try:
        return _located(segment, name, index)
    except Gap:
        raise
    except NumericalOutcome as outcome:
        words = f"the change of sign of {name} could not be located: {outcome}"
        return _artefact(segment.last, index + 0.5, words)


def _located(segment: Segment, name: str, index: int) -> Candidate:
    first, last = segment.first, segment.last

    def value(point: Point) -> float:
        tests = point.problem.tests(point)
        if name not in tests:
            raise Undefined(name)
        return tests[name]

    start, end = value(first), value(last)
    if not opposite(start, end):
        words = f"{name} changed its sign with the renewed problem, not along the curve"
        return _artefact(last, float(index), words)
    found = segment.zero(value, start, end)
    place = index + found.s / segment.length
    if not is_zero(found, start, end):
        return _artefact(found.point, place, _pole(name, found))
    return at_point(found.point, name, place)


def _pole(name: str, found: Found) -> str:
    return f"{name} changes sign through a pole or a jump, not a zero: {found.value:.3g} there"


def at_point(point: Point, name: str, index: float) -> Candidate:
    """What the problem says about a zero of a test function at a point."""
    try:
        finding = point.problem.classify(name, point)
    except NumericalOutcome as outcome:
        return _artefact(point, index, f"the zero of {name} could not be classified: {outcome}")
    return Candidate(_special(finding, point, index), finding.artefact or not finding.kind)


def _artefact(point: Point, index: float, words: str) -> Candidate:
    return Candidate(_special(Finding("", words), point, index), artefact=True)


def _special(finding: Finding, point: Point, index: float) -> SpecialPoint:
    problem = point.problem
    return SpecialPoint(
        finding.kind, finding.words, dict(finding.coefficients), index,
        point.u, point.tangent, problem.values(point.u), problem.solution(point),
    )  # fmt: skip
