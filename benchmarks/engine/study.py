"""One study by either program: equilibria, Hopf curve, cycles, and the curve of their fold.

Both walk in the same norm (``Case.scales``) with the same first and longest step, renew the mesh
every three steps, and stop Newton's method at 1e-7. What is timed is what a user waits for: of
ours everything from the system to the branch, of AUTO its own clock from reading its constants to
the last line written, without process starts and compilation.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from time import perf_counter
from typing import NamedTuple, TypeVar

import numpy as np

from benchmarks.auto07p import Case, Peer, Run
from wheelset.bifurcation.curves.branch import Branch, SpecialPoint
from wheelset.bifurcation.curves.continuation import both_ways, follow
from wheelset.bifurcation.curves.steps import StepControl
from wheelset.bifurcation.cycles.critical_start import lpc_from_cycle
from wheelset.bifurcation.cycles.cycle_curve import Meshing
from wheelset.bifurcation.cycles.cycle_start import Discretisation, cycle_from_hopf
from wheelset.bifurcation.equilibria.equilibrium_curve import equilibrium_curve
from wheelset.bifurcation.equilibria.hopf import hopf_point
from wheelset.bifurcation.equilibria.hopf_curve import hopf_curve

#: Of both: first and longest step, Newton's tolerance, steps between two renewals of the mesh.
FIRST, LONGEST, TOLERANCE, RENEWED = 0.1, 0.5, 1e-7, 3

#: Longest step of AUTO's Hopf curve: its arclength there counts the eigenvectors in the scales of
#: the states too, so that 0.5 would make it a thousand steps.
LONGEST_HOPF = 200.0

#: More than any curve here has.
STEPS = 1000

EQUAL_MESH = Meshing(every=RENEWED, accuracy=None)

Result = TypeVar("Result")


@dataclass(frozen=True)
class Form:
    """How cycles are discretised: intervals of the full or of the half period."""

    half: bool
    intervals: int

    def __str__(self) -> str:
        return f"{'half' if self.half else 'full'} {self.intervals}"


FORMS = FULL_40, HALF_20, HALF_10 = Form(False, 40), Form(True, 20), Form(True, 10)


class Stage(NamedTuple):
    """A curve: seconds of the walk and of what led to its first point, steps, iterations."""

    seconds: float
    preparation: float
    steps: int
    iterations: int


class Study(NamedTuple):
    """stages by name; fold (v, T); curve (points, 3): the two parameters and T; intervals at the
    end of the fold curve.
    """

    stages: dict[str, Stage]
    fold: tuple[float, float]
    curve: np.ndarray
    intervals: int


class Curves(NamedTuple):
    """What our study computed."""

    stages: dict[str, Stage]
    cycles: Branch
    folds: Branch

    @property
    def fold(self) -> SpecialPoint:
        return self.cycles.of_kind("LPC")[0]


def curves(
    case: Case,
    form: Form,
    mesh: Meshing = EQUAL_MESH,
    longest: float = LONGEST,
    tolerance: float = TOLERANCE,
) -> Curves:
    """Our study of a case."""
    system, (first, second) = case.system, case.free
    widths = case.scales[first], case.scales[second]
    control = StepControl(first=FIRST, most=longest, tolerance=tolerance)
    middle = system.with_values(**{first: sum(case.start) / 2})
    rest, seconds = timed(lambda: equilibrium_curve(middle, first, case.start))
    stages = {"equilibrium": stage(rest, seconds)}

    near = float(rest.of_kind("H")[0].values[0])
    hopf, before = timed(lambda: hopf_point(system, first, near))
    line, seconds = timed(lambda: hopf_curve(system, hopf, case.free, {second: case.curve}))
    stages["hopf_curve"] = stage(line, seconds, before)

    how = Discretisation(form.intervals, form.half, mesh)
    start, before = timed(lambda: cycle_from_hopf(system, hopf, widths[0], discretisation=how))
    cycles, seconds = timed(lambda: walk(follow, start, {first: case.window}, control))
    stages["cycles"] = stage(cycles, seconds, before)

    fold = cycles.of_kind("LPC")[0].solution
    start, before = timed(lambda: lpc_from_cycle(system, fold, case.free, widths, mesh))
    folds, seconds = timed(lambda: walk(both_ways, start, {second: case.curve}, control))
    stages["lpc_curve"] = stage(folds, seconds, before)
    return Curves(stages, cycles, folds)


def walk(ways: Callable[..., Branch], start, windows, control: StepControl) -> Branch:
    return ways(
        start.problem, start.u, direction=start.tangent, windows=windows, control=control,
        steps=STEPS,
    )  # fmt: skip


def timed(call: Callable[[], Result]) -> tuple[Result, float]:
    start = perf_counter()
    result = call()
    return result, perf_counter() - start


def stage(branch: Branch, seconds: float, preparation: float = 0.0) -> Stage:
    done = branch.statistics["iterations"] + branch.statistics["trials"]
    return Stage(seconds, preparation, len(branch) - 1, done)


def ours(case: Case, form: Form, mesh: Meshing = EQUAL_MESH, longest: float = LONGEST) -> Study:
    done = curves(case, form, mesh, longest)
    periods = [point.solution.period for point in done.folds.points]
    return Study(
        done.stages,
        (float(done.fold.values[0]), done.fold.solution.period),
        np.column_stack([done.folds.values, periods]),
        len(done.folds.points[-1].solution.mesh) - 1,
    )


def theirs(case: Case, peer: Peer, form: Form, longest: float = LONGEST) -> Study:
    """AUTO's study; ``peer`` has the tolerance and the kind of Jacobian."""
    first, second = case.free
    auto = peer.using(ntst=form.intervals, step=FIRST, largest=longest, adapt=RENEWED)
    hopf = auto.hopf(case.start)
    line = auto.using(largest=LONGEST_HOPF).hopf_curve(hopf, {second: case.curve})
    cycles = auto.cycles(hopf, {first: case.window}, half=form.half)
    folds = auto.lpc_curve(cycles, {second: case.curve})
    runs = {"equilibrium": hopf, "hopf_curve": line, "cycles": cycles, "lpc_curve": folds}
    fold = cycles.table[cycles.table["type"] == "LP"].iloc[0]
    return Study(
        {name: _stage(run) for name, run in runs.items()},
        (float(fold[first]), float(fold["T"])),
        folds.table[[first, second, "T"]].to_numpy(),
        form.intervals,
    )


def _stage(run: Run) -> Stage:
    assert math.isfinite(run.seconds)
    return Stage(run.seconds, run.preparation, run.steps, run.iterations)
