"""A branch: the points of a followed curve, what was found on it, and how it began and ended."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import pandas as pd

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Ending:
    """Why a curve ends.

    kind: start, steps, window, closed, problem (its own reason), least step, domain, not finite.
    words: the same in a sentence, with the numbers.
    """

    kind: str
    words: str

    def __str__(self) -> str:
        return f"{self.kind}: {self.words}"


@dataclass(frozen=True, eq=False)
class BranchPoint:
    """An accepted point.

    u, tangent (N,): unknowns and direction of the walk. values: of the free parameters, SI.
    solution: what the problem keeps. tests: its test functions, as the walk that came here saw
    them. arclength: from the start, in the scaled norm. step: the one that led here.
    """

    u: Array
    tangent: Array
    values: Array
    solution: Any
    tests: Mapping[str, float]
    arclength: float
    step: float


@dataclass(frozen=True, eq=False)
class SpecialPoint:
    """A located zero of a test function: the field's letters, a sentence, its coefficients.

    index: number of the point before it, plus the fraction of the step to the next one.
    """

    kind: str
    words: str
    coefficients: Mapping[str, float]
    index: float
    u: Array
    tangent: Array
    values: Array
    solution: Any


@dataclass(frozen=True, eq=False)
class Branch:
    """A followed curve.

    kind: what it consists of. parameters: the free ones. special, artefacts: in order; an
    artefact is a sign change of a test function that is no special point, and says why.
    began, ended: at the first and the last point. statistics: decisions and work, counted.
    state: what is needed to go on (see ``extend``), one front for each end that can.
    """

    kind: str
    parameters: tuple[str, ...]
    points: tuple[BranchPoint, ...]
    special: tuple[SpecialPoint, ...]
    artefacts: tuple[SpecialPoint, ...]
    began: Ending
    ended: Ending
    statistics: Mapping[str, int]
    state: Any = None

    def __len__(self) -> int:
        return len(self.points)

    @property
    def values(self) -> Array:
        """Values of the free parameters at the points, shape (points, parameters)."""
        return np.array([point.values for point in self.points])

    def of_kind(self, kind: str) -> tuple[SpecialPoint, ...]:
        """The special points with the given letters."""
        return tuple(point for point in self.special if point.kind == kind)

    def table(self, measures: Sequence[str] | None = None) -> pd.DataFrame:
        """One row a point, special points among them in order.

        Columns: the free parameters, the measures (default: those the solutions name), the number
        of unstable directions, and the letters of a special point ("" elsewhere).
        """
        import pandas as pd

        rows: list[tuple[float, str, BranchPoint | SpecialPoint]]
        rows = [(float(i), "", point) for i, point in enumerate(self.points)]
        rows += [(special.index, special.kind, special) for special in self.special]
        rows.sort(key=lambda row: row[:2])
        names = self.points[0].solution.measures if measures is None else tuple(measures)
        columns = [*self.parameters, *names, "unstable", "point"]
        return pd.DataFrame([_row(point, kind, names) for _, kind, point in rows], columns=columns)


def _row(point: BranchPoint | SpecialPoint, kind: str, names: Sequence[str]) -> list[Any]:
    solution = point.solution
    return [*point.values, *(solution.measure(n) for n in names), solution.unstable, kind]


def joined(backward: Branch, forward: Branch) -> Branch:
    """Two walks from one start as one branch, from the backward walk's end to the forward one's.

    Tangents and arclengths of the backward walk are reversed. A special point at the common start
    is kept once.
    """
    shift = len(backward) - 1
    special = (*_reversed(backward.special, shift), *_moved(forward.special, shift))
    artefacts = (*_reversed(backward.artefacts, shift), *_moved(forward.artefacts, shift))
    counts = {**forward.statistics}
    for name, count in backward.statistics.items():
        counts[name] = counts.get(name, 0) + count
    return Branch(
        kind=forward.kind,
        parameters=forward.parameters,
        points=(*map(_turned, backward.points[:0:-1]), *forward.points),
        special=_once(special),
        artefacts=_once(artefacts),
        began=backward.ended,
        ended=forward.ended,
        statistics=counts,
        state=(backward.state, forward.state),
    )


def parted(branch: Branch) -> tuple[Branch, Branch]:
    """The backward and the forward walk that were joined; what was counted goes to the second."""
    start = next(i for i, point in enumerate(branch.points) if point.arclength == 0.0)
    start_words = Ending("start", "where both walks start")
    before = tuple(p for p in branch.special if p.index < start)
    noise_before = tuple(p for p in branch.artefacts if p.index < start)
    backward = replace(
        branch,
        points=(branch.points[start], *map(_turned, branch.points[:start][::-1])),
        special=_reversed(before, start),
        artefacts=_reversed(noise_before, start),
        began=start_words,
        ended=branch.began,
        statistics={},
        state=branch.state[0],
    )
    forward = replace(
        branch,
        points=branch.points[start:],
        special=_moved(branch.special[len(before) :], -start),
        artefacts=_moved(branch.artefacts[len(noise_before) :], -start),
        began=start_words,
        state=branch.state[1],
    )
    return backward, forward


def _turned(point: BranchPoint) -> BranchPoint:
    return replace(point, tangent=-point.tangent, arclength=-point.arclength)


def _reversed(points: tuple[SpecialPoint, ...], last: int) -> tuple[SpecialPoint, ...]:
    return tuple(
        replace(point, tangent=-point.tangent, index=last - point.index) for point in points[::-1]
    )


def _moved(points: tuple[SpecialPoint, ...], shift: int) -> tuple[SpecialPoint, ...]:
    return tuple(replace(point, index=point.index + shift) for point in points)


def _once(points: tuple[SpecialPoint, ...]) -> tuple[SpecialPoint, ...]:
    """Without the repetition of one that both walks found at their start."""
    kept: list[SpecialPoint] = []
    for point in points:
        name = point.kind, point.words, point.index
        if not any((k.kind, k.words, k.index) == name for k in kept):
            kept.append(point)
    return tuple(kept)
