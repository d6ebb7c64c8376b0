"""A least-squares fit of the hidden values of one structure to printed Hopf points."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from wheelset.bifurcation.equilibria.hopf_batch import HopfBatch
from wheelset.studies.identification_problem import Problem

Array = NDArray[np.float64]

#: A fit ends after so many steps, or when the cost changes less than this part of it; the second
#: number is for the best fits.
STEPS, STILL, STANDS = 60, 1e-4, 1e-8


@dataclass(frozen=True, eq=False)
class Fit:
    """A fit that has ended: coordinates (free,), and half the sum of the loss."""

    problem: Problem
    at: Array
    cost: float

    @property
    def values(self) -> dict[str, float]:
        """The fitted values, SI."""
        return {
            one.name: one.value(float(t)) for one, t in zip(self.problem.free, self.at, strict=True)
        }

    @property
    def unnatural(self) -> tuple[str, ...]:
        """Names of the values that no vehicle of steel could have."""
        by_name = {one.name: one for one in self.problem.free}
        return tuple(n for n, value in self.values.items() if not by_name[n].is_natural(value))


def unfitted(problem: Problem) -> Fit:
    """A problem in which nothing is free, with its cost."""
    at = np.empty(0)
    return Fit(problem, at, cost_of(problem.residuals(at)))


def fit(problem: Problem, starts: Sequence[Array], still: float = STILL) -> Fit:
    """The best of the fits from some starts (free,): soft L1 loss of residuals in tolerances."""
    ended = [_fit_from(problem, start, still) for start in starts]
    return min(ended, key=lambda one: one.cost)


def _fit_from(problem: Problem, start: Array, still: float) -> Fit:
    low, high = problem.bounds
    inside = np.clip(start, low + 1e-3 * (high - low), high - 1e-3 * (high - low))
    walk = _Walk(problem)
    ended = least_squares(
        walk.residuals,
        inside,
        walk.jacobian,
        (low, high),
        loss="soft_l1",
        ftol=still,
        max_nfev=STEPS,
    )
    return Fit(problem, np.asarray(ended.x), float(ended.cost))


class _Walk:
    """Residuals and Jacobians along a fit, each Hopf point sought beside the last one."""

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        self.at: Array | None = None
        self.batch: HopfBatch | None = None

    def residuals(self, t: Array) -> Array:
        return self.problem.judged(self._there(t))

    def jacobian(self, t: Array) -> Array:
        return self.problem.jacobian(t, self._there(t))

    def _there(self, t: Array) -> HopfBatch:
        if self.batch is None or self.at is None or not np.array_equal(self.at, t):
            self.at, self.batch = t.copy(), self.problem.hopf(t, self.batch)
        return self.batch


def cost_of(residuals: Array) -> float:
    """Half the sum of the soft L1 loss, 2 (sqrt(1 + r^2) - 1) each."""
    return float(np.sum(np.sqrt(1 + residuals**2) - 1))


def starts(problem: Problem, count: int, seed: int = 20210403) -> list[Array]:
    """The start values of the free, the same with c0 negative, and others at random around them."""
    rng = np.random.default_rng(seed)
    first = np.zeros(len(problem.free))
    other = np.array([-3.0 if one.name == "c0" else 0.0 for one in problem.free])
    more = [0.8 * rng.normal(size=len(first)) for _ in range(count - 2)]
    return [first, other, *more][:count]
