"""Pseudo-arclength continuation of any zero problem.

A walk predicts by the cubic through its last two points and tangents, corrects by Newton's method
across it, watches the problem's test functions, and ends for a reason that it names. It can be
interrupted anywhere and goes on to the same points, bit by bit.
"""

from __future__ import annotations

import pickle
import tempfile
import time
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from wheelset.bifurcation.curves.branch import Branch, BranchPoint, Ending, joined, parted
from wheelset.bifurcation.curves.front import Front, Window, start_of
from wheelset.bifurcation.curves.locate import any_tangent, corrected, unit_tangent
from wheelset.bifurcation.curves.steps import StepControl
from wheelset.bifurcation.curves.walk import Walk, arrival
from wheelset.bifurcation.curves.zero_problem import Point, ZeroProblem

Array = NDArray[np.float64]
Progress = Callable[[BranchPoint], None]
Job = tuple[Branch, int]  # a walk so far, and how many steps are still wanted

#: Seconds between two checkpoints.
CHECKPOINT_EVERY = 5.0


def follow(
    problem: ZeroProblem,
    start: ArrayLike,
    *,
    direction: int | ArrayLike = 1,
    windows: Mapping[str, Window] | None = None,
    control: StepControl | None = None,
    steps: int = 200,
    progress: Progress | None = None,
    checkpoint: Path | None = None,
    kind: str = "curve",
) -> Branch:
    """Follow a curve from near ``start`` (N,) until it ends or ``steps`` are done.

    direction: +1 or -1, whether the first free parameter grows or shrinks at first, or a tangent
    vector (N,). windows: bounds of free parameters; the last point is put on the bound. progress:
    called with every accepted point. checkpoint: a file from which ``resume`` goes on. kind: what
    the branch calls itself. Raises the outcome where not even the start can be computed.
    """
    ready = control or StepControl()
    first = first_point(problem, start, direction, ready)
    return _run([(begun(first, windows or {}, ready, kind), steps)], progress, checkpoint)


def both_ways(
    problem: ZeroProblem,
    start: ArrayLike,
    *,
    direction: int | ArrayLike = 1,
    windows: Mapping[str, Window] | None = None,
    control: StepControl | None = None,
    steps: int = 200,
    progress: Progress | None = None,
    checkpoint: Path | None = None,
    kind: str = "curve",
) -> Branch:
    """As ``follow``, from the start along and against the direction: one branch, steps each way.

    A closed curve is walked once.
    """
    ready = control or StepControl()
    first = first_point(problem, start, direction, ready)
    turned = replace(first, tangent=-first.tangent)
    jobs = [(begun(point, windows or {}, ready, kind), steps) for point in (first, turned)]
    return _run(jobs, progress, checkpoint)


def extend(
    branch: Branch,
    steps: int,
    *,
    progress: Progress | None = None,
    checkpoint: Path | None = None,
) -> Branch:
    """Go on where a branch ended because its steps were done, at both ends if it has two.

    The points are the same, bit by bit, as if it had not been interrupted.
    """
    if "steps" not in (branch.began.kind, branch.ended.kind):
        raise ValueError(
            f"the branch ended: {branch.ended}; only one whose steps were done can go on, "
            "follow a new one from its last point instead"
        )
    walks = [branch] if isinstance(branch.state, Front) else list(parted(branch)[::-1])
    return _run([(walk, steps) for walk in walks], progress, checkpoint)


def resume(checkpoint: Path, *, progress: Progress | None = None) -> Branch:
    """Go on from a checkpoint to the steps asked for when it was written.

    The file is a pickle: open none that you did not write.
    """
    jobs = pickle.loads(Path(checkpoint).read_bytes())  # noqa: S301  (the user's own file)
    return _run(jobs, progress, checkpoint)


# --- the start -----------------------------------------------------------------------------------


def first_point(
    problem: ZeroProblem, start: ArrayLike, direction: int | ArrayLike, control: StepControl
) -> Point:
    """The point of the curve nearest to ``start``, with its tangent along the direction.

    At a fold of the first parameter +1 and -1 are either of the two ways. Raises NoConvergence
    with the residuals, or the outcome met.
    """
    u = np.array(start, dtype=np.float64)
    if np.ndim(direction) == 0:
        if direction not in (1, -1):
            raise ValueError(f"direction = {direction!r}: +1, -1 or a tangent vector; give one")
        way = float(np.asarray(direction)) * _growing(problem, u)
    else:
        way = np.array(direction, dtype=np.float64)
    most = 2 * control.iterations
    point = corrected(problem, u, way, control.tolerance, most).point
    row = problem.metric * point.tangent
    return replace(point, tangent=unit_tangent(point.linearisation, row, problem.metric))


def _growing(problem: ZeroProblem, u: Array) -> Array:
    """The curve's direction at u in which the first free parameter grows."""
    linearisation, metric = problem.linearised(u), problem.metric
    rough = any_tangent(linearisation, metric)
    tangent = unit_tangent(linearisation, metric * rough, metric)
    growth = problem.values(u + tangent)[0] - problem.values(u)[0]
    return -tangent if growth < 0 else tangent


def begun(point: Point, windows: Mapping[str, Window], control: StepControl, kind: str) -> Branch:
    """The branch of a first point, ready to go on, or over already."""
    problem = point.problem
    _check_windows(problem, windows)
    here = arrival(point)
    start = start_of(point.u, point.tangent, problem.metric)
    front = Front(
        control, dict(windows), problem, point.u, point.tangent, start, 0.0, None, control.first
    )
    first = BranchPoint(
        point.u, point.tangent, here.values, here.solution, here.tests, 0.0, 0.0
    )  # fmt: skip
    ended = Ending("steps", "no step done")
    if exits := front.exits(here.values):
        ended = Ending("window", f"{exits[0].words} already at the start")
    elif here.ended:
        ended = Ending("problem", here.ended)
    began = Ending("start", "where the walk starts")
    return Branch(
        kind, tuple(problem.parameters), (first,), (), (), began, ended, {},
        front.renewed(here.renewal),
    )  # fmt: skip


def _check_windows(problem: ZeroProblem, windows: Mapping[str, Window]) -> None:
    for name, (low, high) in windows.items():
        if name not in problem.parameters:
            free = ", ".join(problem.parameters)
            raise ValueError(f"window of {name!r}: the free parameters are {free}; name one")
        if not low < high:
            raise ValueError(f"window of {name} = {(low, high)}: needs the lower bound first")


# --- the walk ------------------------------------------------------------------------------------


def _run(jobs: list[Job], progress: Progress | None, checkpoint: Path | None) -> Branch:
    """Walk every job's steps; the first goes forward, a second one backward from its start."""
    todo, saved = list(jobs), time.monotonic()
    for number, (branch, steps) in enumerate(jobs):
        if todo[0][0].ended.kind == "closed":
            del todo[1:]
            break
        walk = Walk(branch)
        for left in range(steps - 1, -1, -1):
            if walk.ended or not _advanced(walk, progress):
                break
            if checkpoint and time.monotonic() - saved > CHECKPOINT_EVERY:
                todo[number], saved = (walk.so_far(), left), time.monotonic()
                _save(todo, checkpoint)
        todo[number] = walk.so_far(), 0
    if checkpoint:
        _save(todo, checkpoint)
    forward, *backward = (branch for branch, _ in todo)
    return joined(backward[0], forward) if backward else forward


def _advanced(walk: Walk, progress: Progress | None) -> bool:
    """Whether one more step was possible."""
    known = len(walk.points)
    walk.advance()
    if progress and len(walk.points) > known:
        progress(walk.points[-1])
    return len(walk.points) > known


def _save(jobs: list[Job], checkpoint: Path) -> None:
    """Write a checkpoint at once or not at all."""
    path = Path(checkpoint)
    with tempfile.NamedTemporaryFile("wb", dir=path.parent, suffix=".part", delete=False) as f:
        pickle.dump(jobs, f)
    Path(f.name).replace(path)
