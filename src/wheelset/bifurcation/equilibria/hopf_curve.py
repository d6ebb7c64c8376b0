"""Hopf curves in any two parameters, and generalized Hopf points on them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.linalg import matrix_balance

from wheelset.bifurcation.curves.branch import Branch
from wheelset.bifurcation.curves.continuation import Progress, both_ways, first_point
from wheelset.bifurcation.curves.front import Window
from wheelset.bifurcation.curves.locate import corrected
from wheelset.bifurcation.curves.scaling import parameter_weight, state_weights
from wheelset.bifurcation.curves.steps import StepControl
from wheelset.bifurcation.curves.zero_problem import Point
from wheelset.bifurcation.equilibria.hopf import HopfPoint
from wheelset.bifurcation.equilibria.hopf_borders import borders_at
from wheelset.bifurcation.equilibria.hopf_points import examined
from wheelset.bifurcation.equilibria.hopf_problem import HopfProblem
from wheelset.bifurcation.equilibria.second_lyapunov import second_lyapunov
from wheelset.bifurcation.outcomes import NoConvergence, as_tuple
from wheelset.bifurcation.system import System

Array = NDArray[np.float64]

#: (state, frequency in rad/s, values of parameters by name), for a Hopf point that is only known
#: roughly.
Roughly = tuple[ArrayLike, float, Mapping[str, float]]

#: The secant method for FLC = 0 along the curve: first and largest arclength, and what ends it.
FIRST, LARGEST, ENOUGH, MOST = 1e-3, 0.3, 1e-11, 40


def hopf_curve(
    system: System,
    hopf: HopfPoint | Roughly,
    parameters: tuple[str, str],
    windows: Mapping[str, Window] | None = None,
    *,
    scales: ArrayLike | None = None,
    control: StepControl | None = None,
    steps: int = 200,
    progress: Progress | None = None,
    checkpoint: Path | None = None,
) -> Branch:
    """Follow a Hopf point both ways in two parameters, with FLC at every point.

    hopf: a point found before, or (state, frequency, {parameter: value}) near one; parameters not
    named there have the system's values. windows: of the parameters, whose widths are their scales.
    scales (n,): typical sizes of the states (default: the system's). steps: at most, each way.
    Finds GH (with SLC), BT (beyond which the curve consists of neutral saddles), ZH and HH. Raises
    NoConvergence where there is no Hopf point.
    """
    problem, start = hopf_problem(system, hopf, parameters, windows, scales)
    return both_ways(
        problem, start, windows=windows, control=control, steps=steps, progress=progress,
        checkpoint=checkpoint, kind="Hopf points",
    )  # fmt: skip


def hopf_problem(
    system: System,
    hopf: HopfPoint | Roughly,
    parameters: tuple[str, str],
    windows: Mapping[str, Window] | None = None,
    scales: ArrayLike | None = None,
) -> tuple[HopfProblem, Array]:
    """The zero problem of a Hopf curve, and where on it the Hopf point is, u (n + 3,)."""
    if len(set(parameters)) != 2:
        raise ValueError(f"parameters = {parameters!r}: a Hopf curve needs two different ones")
    state, frequency, values = _roughly(hopf)
    at = system.with_values(**values)
    x, p = np.asarray(state, dtype=np.float64), at.p()
    free = [float(p[system.index(name)]) for name in parameters]
    allowed = windows or {}
    weights = [parameter_weight(allowed.get(n), v) for n, v in zip(parameters, free, strict=True)]
    metric = np.array([*state_weights(system, scales), *weights, frequency**-4])
    A = at.jacobian(x, p)
    scale = matrix_balance(A, permute=False, separate=True)[1][0]
    borders = borders_at(A * (scale / scale[:, np.newaxis]) / frequency, 1.0)
    problem = HopfProblem(at, parameters, metric, scale, frequency, borders)
    return problem, np.array([*x, *free, frequency**2])


def _roughly(hopf: HopfPoint | Roughly) -> Roughly:
    if isinstance(hopf, HopfPoint):
        return hopf.state, hopf.frequency, {hopf.parameter: hopf.value}
    if not hopf[1] > 0:
        raise ValueError(f"frequency = {hopf[1]!r} rad/s: has to be positive; give the pair's")
    return hopf


@dataclass(frozen=True)
class GHPoint:
    """A generalized Hopf point: FLC = 0.

    values: of the two parameters, SI. state (n,). frequency: rad/s. lyapunov: what is left of FLC.
    second_lyapunov: SLC in MATCONT's normalisation.
    """

    parameters: tuple[str, str]
    values: tuple[float, ...]
    state: tuple[float, ...]
    frequency: float
    lyapunov: float
    second_lyapunov: float


def gh_point(
    system: System,
    parameters: tuple[str, str],
    near: HopfPoint | Roughly,
    windows: Mapping[str, Window] | None = None,
    *,
    scales: ArrayLike | None = None,
) -> GHPoint:
    """The generalized Hopf point beside a Hopf point, by the secant method along the Hopf curve.

    near, scales: as for ``hopf_curve``. windows: their widths are the parameters' scales; the point
    may lie outside. Raises NoConvergence with the history of |FLC|.
    """
    problem, start = hopf_problem(system, near, parameters, windows, scales)
    control = StepControl()
    point = first_point(problem, start, 1, control)
    step, old, history = FIRST, _flc(point), [abs(_flc(point))]
    for _ in range(MOST):
        point = _further(point, step, control)
        new = _flc(point)
        history.append(abs(new))
        if abs(step) <= ENOUGH or new == 0.0:
            return _gh(point)
        if new == old:
            break
        step, old = max(-LARGEST, min(LARGEST, step * new / (old - new))), new
    raise NoConvergence(f"generalized Hopf point in {' and '.join(parameters)}", tuple(history))


def _further(point: Point, step: float, control: StepControl) -> Point:
    """The point of the curve an arclength further, with the tangent's sense kept."""
    problem = point.problem.renewed(point).problem
    predicted = point.u + step * point.tangent
    return corrected(problem, predicted, point.tangent, 1e-12, 10, control.tolerance).point


def _flc(point: Point) -> float:
    solution = examined(point).solution
    if solution.lyapunov is None:
        raise NoConvergence(f"no first Lyapunov coefficient: {solution.reason}", ())
    return solution.lyapunov


def _gh(point: Point) -> GHPoint:
    at = examined(point)
    solution = at.solution
    assert at.pair is not None and solution.lyapunov is not None
    return GHPoint(
        point.problem.parameters, as_tuple(solution.values), as_tuple(solution.state),
        solution.frequency, solution.lyapunov,
        second_lyapunov(at.system, solution.state, at.p, at.pair),
    )  # fmt: skip
