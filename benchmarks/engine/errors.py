"""What either program's folds are off by: against the same study on four times the intervals."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass

import numpy as np

from benchmarks.auto07p import Case, Peer
from benchmarks.engine.study import Curves, Form, Study, curves
from wheelset.bifurcation.cycles.critical_start import lpc_from_cycle
from wheelset.bifurcation.cycles.cycle import Cycle

#: Twenty intervals of the half period and forty of the full one are the finest compared.
FINE = Form(True, 80)

#: Newton's tolerance and the locating tolerance of the reference.
TOLERANCE, LOCATE = 1e-10, 1e-7

#: Degree of the polynomials in log p2 that the reference's fold curve is interpolated by.
DEGREE = 23

#: Off the nodes, what the interpolation may err by.
INTERPOLATED = 1e-11


@dataclass(frozen=True)
class Reference:
    """The fold (v, T), and v of the folds over the second parameter p2, a polynomial in log p2.

    error: of the polynomial between its nodes, relative.
    """

    fold: tuple[float, float]
    speed: np.polynomial.Chebyshev
    error: float

    def of(self, study: Study) -> dict[str, float]:
        """Relative errors of the fold's speed and period, and the curve's greatest in speed."""
        v, second, _ = study.curve.T
        return {
            "fold_speed_error": abs(study.fold[0] / self.fold[0] - 1),
            "fold_period_error": abs(study.fold[1] / self.fold[1] - 1),
            "curve_error": float(np.abs(v / self.speed(np.log(second)) - 1).max()),
        }


def reference(case: Case) -> Reference:
    """Ours on four times as many intervals."""
    done = curves(case, FINE, tolerance=TOLERANCE)
    ends = np.log(case.curve)
    speed = np.polynomial.Chebyshev.interpolate(
        lambda logs: np.array([_speed(case, done, float(np.exp(log))) for log in logs]),
        DEGREE,
        ends,
    )
    between = float(ends[0] + 0.123 * (ends[1] - ends[0]))
    error = abs(float(speed(between)) / _speed(case, done, float(np.exp(between))) - 1)
    if error > INTERPOLATED:
        raise RuntimeError(f"{case.name}: the reference's curve is only good to {error:.1e}")
    return Reference((float(done.fold.values[0]), done.fold.solution.period), speed, error)


def _speed(case: Case, done: Curves, second: float) -> float:
    """v of the fold at a value of the second parameter."""
    nearest = int(np.abs(np.log(done.folds.values[:, 1] / second)).argmin())
    cycle: Cycle = done.folds.points[nearest].solution
    there = dataclasses.replace(cycle, parameters={**cycle.parameters, case.free[1]: second})
    widths = tuple(case.scales[name] for name in case.free)
    return float(lpc_from_cycle(case.system, there, case.free, widths).u[-2])


def auto_fold(case: Case, peer: Peer) -> tuple[float, float]:
    """AUTO's fold (v, T) on the reference's mesh, to eleven digits."""
    fine = peer.using(ntst=FINE.intervals, tolerance=TOLERANCE, locate=LOCATE, jacobian=True)
    first = case.free[0]
    run = fine.cycles(fine.hopf(case.start), {first: case.window}, half=FINE.half)
    fold = run.table[run.table["type"] == "LP"].iloc[0]
    return float(fold[first]), float(fold["T"])
