"""Recognising that a motion has settled, to an equilibrium or to a cycle, with an error estimate.

Equilibrium: Newton's correction, the distance to the equilibrium nearby, stays below the tolerance
for a stretch and no eigenvalue there has a positive real part.

Cycle: the returns are the local maxima of one state, the zeros of its rate located on the dense
output. Where differences of successive returns shrink geometrically, d, qd, q^2 d, ..., what is
left to the cycle is d q / (1 - q): a slowly decaying spiral is not taken for a cycle.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from wheelset.bifurcation.integration.endings import Ending, SettledToCycle, SettledToEquilibrium
from wheelset.bifurcation.integration.plan import Plan
from wheelset.bifurcation.integration.step import DEGREE, Step, sign_changes
from wheelset.bifurcation.outcomes import NumericalOutcome

Array = NDArray[np.float64]

#: Consecutive returns that have to agree.
AGREEING = 3
#: A cycle may have up to this many maxima of the section state.
MOST_TURNS = 4
#: The fraction of the time gone by that a state has to stay at an equilibrium, at most.
STRETCH = 0.1
#: Differences below this multiple of rtol are the integrator's and tell no rate.
NOISE = 100
#: Ratios of successive differences within this band are a rate all the same.
STEADY = 0.1
#: Points at which a step is searched for extremes, and the matrices of value, slope and bend.
SPACING = 1 / 8
_POINTS = np.linspace(-1, 1, 17)
FINE = tuple(
    np.stack(
        [chebyshev.chebval(_POINTS, chebyshev.chebder(unit, k)) for unit in np.eye(DEGREE + 1)], 1
    )
    for k in range(3)
)


@dataclass
class Settling:
    """Follows a motion from step to step.

    largest: of |x| so far, (n,). calm_since: since when the state has been at an equilibrium.
    """

    plan: Plan
    t_start: float
    largest: Array
    calm_since: float | None = None
    sign: int = 0
    returns: list[tuple[float, Array]] = field(default_factory=list)
    ranges: list[tuple[float, Array, Array]] = field(default_factory=list)

    def after(self, step: Step) -> Ending | None:
        """The ending if the motion has settled by the end of this step."""
        self.largest = np.maximum(self.largest, np.abs(step.x1))
        return self._at_equilibrium(step) or self._on_cycle(step)

    # --- equilibrium ---------------------------------------------------------------------------

    def _at_equilibrium(self, step: Step) -> SettledToEquilibrium | None:
        tolerance = self.plan.settle_tol * self.largest
        found = None
        if np.all(np.abs(step.x1 - step.x0) <= 2 * tolerance):
            found = _equilibrium_near(self.plan, step)
        if found is None or np.any(np.abs(found[0]) > tolerance):
            self.calm_since = None
            return None
        if self.calm_since is None:
            self.calm_since = step.t0
        to_equilibrium, eigenvalues = found
        if step.t1 - self.calm_since < self._stretch(step.t1, eigenvalues):
            return None
        distance = float((np.abs(to_equilibrium) / np.where(tolerance > 0, self.largest, 1)).max())
        decay = -float(eigenvalues.real.max())
        return SettledToEquilibrium(step.t1, step.x1, step.x1 + to_equilibrium, distance, decay)

    def _stretch(self, t: float, eigenvalues: NDArray[Any]) -> float:
        fastest = float(np.abs(eigenvalues).max())
        passed = STRETCH * (t - self.t_start)
        return min(2 * np.pi / fastest, passed) if fastest > 0 else passed

    # --- cycle ---------------------------------------------------------------------------------

    def _on_cycle(self, step: Step) -> SettledToCycle | None:
        self.ranges.append((step.t1, *_extremes(step)))
        maxima = self._maxima(step)
        for t in maxima:
            self.returns.append((t, step(t)))
        if not maxima:
            return None
        self._forget()
        turns = (m for m in range(1, MOST_TURNS + 1) if len(self.returns) > AGREEING + m + 1)
        return next((c for m in turns if (c := self._agreeing(m))), None)

    def _maxima(self, step: Step) -> list[float]:
        system, p, i = self.plan.system, self.plan.p, self.plan.section
        rates = step.rates(i)
        changes, self.sign = sign_changes(
            step, lambda t: float(system.rhs(step(t), p)[i]), rates, self.sign, 0.0
        )
        return [c.t for c in changes if c.direction < 0]

    def _forget(self) -> None:
        """Keep what the longest cycle looked for needs."""
        self.returns = self.returns[-(AGREEING + 2 * MOST_TURNS + 1) :]
        oldest = self.returns[max(0, len(self.returns) - MOST_TURNS - 1)][0]
        self.ranges = [r for r in self.ranges if r[0] > oldest]

    def _agreeing(self, turns: int) -> SettledToCycle | None:
        """The cycle with this many maxima a period, if the returns agree."""
        lowest, highest = self._range(self.returns[-1 - turns][0])
        span = np.where(highest > lowest, highest - lowest, 1.0) / 2
        differences = self._differences(turns, span)
        error, contraction = _error(differences, NOISE * self.plan.rtol)
        if error > self.plan.settle_tol or differences[1:].max() > self.plan.settle_tol:
            return None
        (t, x), period = self.returns[-1], self.returns[-1][0] - self.returns[-1 - turns][0]
        return SettledToCycle(t, x, period, lowest, highest, error, contraction, turns)

    def _differences(self, turns: int, span: Array) -> Array:
        """Distances of the last returns from the ones a period before, states and period."""
        t = np.array([r[0] for r in self.returns])
        x = np.array([r[1] for r in self.returns]) / span
        periods = t[turns:] - t[:-turns]
        moved = np.abs(x[turns:] - x[:-turns]).max(axis=1)[1:]
        return np.maximum(moved, np.abs(np.diff(periods)) / periods[1:])[-AGREEING - 1 :]

    def _range(self, start: float) -> tuple[Array, Array]:
        parts = [r for r in self.ranges if r[0] > start]
        return np.min([r[1] for r in parts], axis=0), np.max([r[2] for r in parts], axis=0)


def _equilibrium_near(plan: Plan, step: Step) -> tuple[Array, NDArray[Any]] | None:
    """The way (n,) to the equilibrium beside the end of a step, and the eigenvalues there.

    None where one of them has a positive real part, unless the state rests in it exactly.
    """
    try:
        f, jacobian = plan.system.evaluate(step.x1, plan.p)
    except NumericalOutcome:
        return None
    eigenvalues = np.linalg.eigvals(jacobian)
    unstable = eigenvalues.real.max() > 1e-9 * np.abs(eigenvalues).max()
    if unstable and f.any():
        return None
    way = np.linalg.lstsq(jacobian, -f, rcond=None)[0]
    return np.asarray(way, dtype=np.float64), eigenvalues


def _error(differences: Array, noise: float) -> tuple[float, float]:
    """Estimated distance from the limit of a sequence with these differences, and their ratio.

    Differences that are the integrator's and shrink at no steady rate are themselves the estimate.
    """
    first, last = float(differences[0]), float(differences[-1])
    if first == 0.0:
        return (0.0, 0.0) if not differences.any() else (np.inf, np.inf)
    ratios = differences[1:] / np.maximum(differences[:-1], np.finfo(np.float64).tiny)
    steady = ratios.max() < 1 and np.ptp(ratios) < STEADY
    if differences.max() <= noise and not steady:
        return float(differences.max()), 0.0
    ratio = float((last / first) ** (1 / len(ratios)))
    return (last * ratio / (1 - ratio), ratio) if ratio < 1 else (np.inf, ratio)


def _extremes(step: Step) -> tuple[Array, Array]:
    """Lowest and highest value of each state on a step, (n,).

    The extreme sample is moved to the vertex of the parabola that touches the motion there.
    """
    values, slopes, bends = (matrix @ step.coefficients for matrix in FINE)
    shift = np.divide(-slopes, bends, out=np.zeros_like(bends), where=bends != 0)
    vertex = np.where(np.abs(shift) <= SPACING, values + slopes * shift / 2, values)
    return np.minimum(vertex, values).min(axis=0), np.maximum(vertex, values).max(axis=0)
