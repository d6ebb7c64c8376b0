"""Curves of equilibria in any parameter, and the branches that cross them."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from wheelset.bifurcation.curves.branch import Branch, BranchPoint, SpecialPoint
from wheelset.bifurcation.curves.continuation import Progress, both_ways
from wheelset.bifurcation.curves.front import Front, Window
from wheelset.bifurcation.curves.scaling import parameter_weight, state_weights
from wheelset.bifurcation.curves.steps import StepControl
from wheelset.bifurcation.equilibria.equilibrium import equilibrium
from wheelset.bifurcation.equilibria.equilibrium_problem import EquilibriumProblem
from wheelset.bifurcation.outcomes import NoConvergence
from wheelset.bifurcation.system import System

Array = NDArray[np.float64]

KIND = "equilibria"

#: Special points at which the number of unstable eigenvalues changes; how near to a point of the
#: branch, in steps, one may belong to either side of it.
CHANGES, BESIDE = {"LP", "BP", "H"}, 1e-6

#: How far from a branch point, in first steps, the crossing curve starts: the first step back then
#: clears the branch point.
APART = 0.7

#: Below this, relative to its terms, the discriminant at a branch point is zero.
DEGENERATE = 1e-6


def equilibrium_curve(
    system: System,
    parameter: str,
    window: Window,
    guess: ArrayLike | None = None,
    *,
    scales: ArrayLike | None = None,
    control: StepControl | None = None,
    steps: int = 200,
    progress: Progress | None = None,
    checkpoint: Path | None = None,
) -> Branch:
    """Follow the equilibrium both ways from the parameter's value in ``system``.

    window: of the parameter, whose width is its scale. guess: where Newton's method starts
    (default: the origin). scales (n,): typical sizes of the states (default: the system's).
    steps: at most, each way. Finds LP (fold, with coefficient a), BP, H (with frequency and FLC)
    and NSE (neutral saddle, no bifurcation). Raises NoConvergence where there is no equilibrium.
    """
    start = float(system.p()[system.index(parameter)])
    state, _ = equilibrium(system, system.p(), guess)
    weights = [*state_weights(system, scales), parameter_weight(window, start)]
    problem = EquilibriumProblem(system, parameter, np.array(weights))
    branch = both_ways(
        problem, [*state, start], windows={parameter: window}, control=control, steps=steps,
        progress=progress, checkpoint=checkpoint, kind=KIND,
    )  # fmt: skip
    return with_silent_changes(branch)


def branch_from_bp(
    branch: Branch,
    special: SpecialPoint,
    *,
    control: StepControl | None = None,
    steps: int = 200,
    progress: Progress | None = None,
    checkpoint: Path | None = None,
) -> Branch:
    """The other curve of equilibria through a branch point (BP) of a curve, both ways.

    It starts less than a first step away and passes the branch point on its way back. Windows and
    scales are those of the branch. Raises NoConvergence where no second curve crosses.
    """
    if special.kind != "BP":
        raise ValueError(
            f"special point {special.kind!r}: has to be a BP; choose one of the branch's"
        )
    front = branch.state if isinstance(branch.state, Front) else branch.state[1]
    problem, ready = front.problem, control or front.control
    assert isinstance(problem, EquilibriumProblem)
    tangent = _crossing(problem, special)
    start = special.u + APART * ready.first * tangent
    switched = both_ways(
        problem, start, direction=tangent, windows=front.windows, control=ready, steps=steps,
        progress=progress, checkpoint=checkpoint, kind=KIND,
    )  # fmt: skip
    return with_silent_changes(switched)


def _crossing(problem: EquilibriumProblem, special: SpecialPoint) -> Array:
    """Unit tangent of the curve that crosses at a branch point.

    The tangents a v1 + b v2 in the plane of null vectors of J solve w . F''(z, z) = 0, w the left
    null vector: the algebraic branching equation. Of the two solutions, the one across the curve.
    """
    scale = 1 / np.sqrt(problem.metric)
    left, _, right = np.linalg.svd(problem.linearised(special.u).jacobian * scale)
    plane, w = right[-2:] * scale, left[:, -1]
    second = [[w @ _second(problem, special.u, a, b) for b in plane] for a in plane]
    rows = [_direction(root, plane) for root in _isotropic(np.array(second))]
    if not rows:
        raise NoConvergence("no second curve crosses at this branch point", ())
    row = problem.metric * special.tangent
    return min(rows, key=lambda direction: abs(float(row @ direction)))


def _second(problem: EquilibriumProblem, u: Array, a: Array, b: Array) -> Array:
    """F''(a, b) (n,), a and b along states and parameter."""
    system, k = problem.system, problem.system.index(problem.parameter)
    directions = np.zeros((2, system.n + len(system.parameter_names)))
    directions[:, : system.n] = a[:-1], b[:-1]
    directions[:, system.n + k] = a[-1], b[-1]
    return np.asarray(system.form(u[:-1], problem.p(u), *directions))


def _isotropic(form: Array) -> list[tuple[float, float]]:
    """The directions z with z . form z = 0 of a symmetric (2, 2) form, none if it is definite."""
    (low, high), vectors = np.linalg.eigh(form)
    if not low < 0 < high or min(-low, high) <= DEGENERATE * max(-low, high):
        return []
    pair = math.sqrt(high), math.sqrt(-low)
    found = (pair[0] * vectors[:, 0] + sign * pair[1] * vectors[:, 1] for sign in (1, -1))
    return [(float(z[0]), float(z[1])) for z in found]


def _direction(weights: tuple[float, float], plane: Array) -> Array:
    return np.asarray(weights) @ plane / math.hypot(*weights)


def with_silent_changes(branch: Branch) -> Branch:
    """The branch with a note, among the artefacts, wherever the number of unstable eigenvalues
    changes although no test function changed its sign: several pairs cross at once. To be asked
    for again after ``extend`` or ``resume``.
    """
    explained = {
        math.floor(point.index + shift)
        for point in branch.special
        for shift in (-BESIDE, BESIDE)
        if point.kind in CHANGES
    }
    notes = []
    for i, (point, following) in enumerate(zip(branch.points, branch.points[1:], strict=False)):
        counts = point.solution.unstable, following.solution.unstable
        if counts[0] != counts[1] and i not in explained:
            notes.append(_silent(i, following, counts))
    said = {(artefact.index, artefact.words) for artefact in branch.artefacts}
    notes = [note for note in notes if (note.index, note.words) not in said]
    artefacts = sorted((*branch.artefacts, *notes), key=lambda point: point.index)
    return replace(branch, artefacts=tuple(artefacts))


def _silent(i: int, point: BranchPoint, counts: tuple[int, int]) -> SpecialPoint:
    words = (
        f"unstable eigenvalues go from {counts[0]} to {counts[1]}, and no test function says how"
    )
    return SpecialPoint(
        "", words, {}, i + 0.5, point.u, point.tangent, point.values, point.solution
    )
