"""Step by step through a smooth field with scipy's solvers; nothing is lost when one fails."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import OdeSolver

from wheelset.bifurcation.integration.endings import (
    BecameNotFinite,
    Ending,
    LeftDomain,
    ReachedEnd,
    SolverFailed,
    StepBelowMinimum,
)
from wheelset.bifurcation.integration.plan import METHODS, Plan
from wheelset.bifurcation.integration.step import Step
from wheelset.bifurcation.outcomes import DomainLeft, NotFinite, NumericalOutcome
from wheelset.bifurcation.system import System

Array = NDArray[np.float64]

#: A boundary of the domain is located to this fraction of the last ordinary step.
BOUNDARY = 1e-9
#: Methods that are given the exact Jacobian.
IMPLICIT = ("Radau", "BDF", "LSODA")
#: Steps that succeed in a row before a step shortened by a boundary may grow again.
CLEAR = 4


class RightHandSide:
    """f(x, p) of a smooth system as scipy calls it; remembers when it was last asked.

    A step asks for f at one state some ten times, so the kernel of f is called without what
    ``System`` does for arrays; where f has no value it raises the named outcome.
    """

    def __init__(self, system: System, p: Array) -> None:
        self.system, self.p = system, np.ascontiguousarray(p)
        self.last_t = 0.0
        self._kernel = system.field_kernel()

    def __call__(self, t: float, x: Array) -> Array:
        """f at x, shape (n,)."""
        self.last_t = t
        f = np.empty((1, len(x)))
        self._kernel(np.ascontiguousarray(x).reshape(1, -1), self.p, f)
        return f[0]

    def jacobian(self, t: float, x: Array) -> Array:
        """df/dx."""
        self.last_t = t
        return self.system.jacobian(x, self.p)


@dataclass
class Approach:
    """The steps allowed while a boundary of the domain is near; ``cause`` is what was hit last."""

    ordinary: float = np.inf
    limit: float = np.inf
    clear: int = 0
    cause: NumericalOutcome | None = None

    def hit(self, cause: NumericalOutcome, tried: float) -> None:
        """A trial step left the domain: half of it is tried next."""
        self.cause, self.clear = cause, 0
        if np.isinf(self.ordinary):
            self.ordinary = tried
        self.limit = min(self.limit, tried) / 2

    def passed(self, size: float) -> bool:
        """A step succeeded; True if the next ones may be longer again."""
        if np.isinf(self.limit):
            self.ordinary = size
            return False
        self.clear += 1
        if self.clear < CLEAR:
            return False
        self.clear, self.limit = 0, 2 * self.limit
        if self.limit >= self.ordinary:
            self.limit, self.cause = np.inf, None
        return True

    def located(self, t: float) -> bool:
        """Whether the boundary is as close as it can usefully be told."""
        return self.limit < max(BOUNDARY * self.ordinary, 16 * np.spacing(abs(t)))


def smooth_steps(
    plan: Plan, system: System, p: Array, t: float, x: Array, t_end: float, first: float | None
) -> Iterator[Step | Ending]:
    """Accepted steps from (t, x) on, then how they ended. ``first``: size of the first, in s."""
    rhs, near, solver = RightHandSide(system, p), Approach(), None
    while t < t_end:
        rhs.last_t = t
        try:
            solver = solver or _start(plan, rhs, t, x, t_end, first, near.limit)
            step = _advance(solver, rhs)
        except (DomainLeft, NotFinite) as cause:
            near.hit(cause, max(rhs.last_t - t, 0.0) or _spacing(t))
            solver, first = None, near.limit
            if near.located(t):
                yield _outside(t, x, cause)
                return
            continue
        if step is None:
            yield _outside(t, x, near.cause) if near.cause else _failure(solver, t, x)
            return
        yield step
        t, x = step.t1, step.x1
        if near.passed(step.t1 - step.t0):
            solver, first = None, step.t1 - step.t0
    yield ReachedEnd(t, x)


def _start(
    plan: Plan,
    rhs: RightHandSide,
    t: float,
    x: Array,
    t_end: float,
    first: float | None,
    limit: float,
) -> OdeSolver:
    longest = min(plan.max_step, limit)
    start = None if first is None else min(first, longest, t_end - t)
    exact = {"jac": rhs.jacobian} if plan.method in IMPLICIT else {}
    limits = {"first_step": start, "max_step": longest}
    tolerances = {"rtol": plan.rtol, "atol": plan.atol}
    return METHODS[plan.method](rhs, t, x, t_end, **tolerances, **limits, **exact)


def _advance(solver: OdeSolver, rhs: RightHandSide) -> Step | None:
    """The next accepted step, defined up to its end; None where the solver failed."""
    t0, x0 = solver.t, solver.y.copy()
    solver.message = solver.step()
    if solver.status == "failed":
        return None
    dense = solver.dense_output()
    rhs(solver.t, solver.y)  # a multistep method may accept a state it never evaluated f at
    return Step(t0, float(solver.t), x0, solver.y.copy(), dense)


def _spacing(t: float) -> float:
    return float(np.spacing(max(abs(t), 1.0)))


def _outside(t: float, x: Array, cause: NumericalOutcome | None) -> Ending:
    if isinstance(cause, DomainLeft):
        return LeftDomain(t, x, cause)
    assert isinstance(cause, NotFinite)
    return BecameNotFinite(t, x, cause)


def _failure(solver: OdeSolver, t: float, x: Array) -> Ending:
    message = str(solver.message)
    if message == OdeSolver.TOO_SMALL_STEP:
        return StepBelowMinimum(t, x)
    return SolverFailed(t, x, message)
