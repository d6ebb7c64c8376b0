"""Equilibria as a zero problem: f(x, p) = 0 with one parameter free, u = (x, p)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from wheelset.bifurcation.curves.zero_problem import DenseLinearisation, Finding, Point, Renewal
from wheelset.bifurcation.equilibria.lyapunov import critical_pair, first_lyapunov
from wheelset.bifurcation.equilibria.spectrum import (
    closest_to_opposite,
    eigenvalues,
    is_real,
    pair_sums,
)
from wheelset.bifurcation.outcomes import NumericalOutcome
from wheelset.bifurcation.system import System

Array = NDArray[np.float64]

#: A zero of the branch point test this near, in scaled arclength, is at the point itself.
SAME_PLACE = 1e-6
#: Half the arclength over which the test's change is measured.
REACH = 1e-4
#: A fold whose null vectors are this near to orthogonal has a double zero eigenvalue.
DOUBLE = 1e-9


@dataclass(frozen=True, eq=False)
class EquilibriumPoint:
    """An equilibrium: state (n,) and parameter value in SI units, eigenvalues (n,) in 1/s."""

    state: Array
    value: float
    eigenvalues: NDArray[Any]
    state_names: tuple[str, ...]

    @property
    def measures(self) -> tuple[str, ...]:
        """What a table shows by default: the state."""
        return self.state_names

    @property
    def unstable(self) -> int:
        """Number of eigenvalues with a positive real part."""
        return int((self.eigenvalues.real > 0).sum())

    def measure(self, name: str) -> float:
        """A state by its name, or ``growth``, the largest real part of the eigenvalues in 1/s."""
        if name == "growth":
            return float(self.eigenvalues.real.max())
        if name not in self.state_names:
            known = ", ".join((*self.state_names, "growth"))
            raise ValueError(f"unknown measure {name!r}; there are {known}")
        return float(self.state[self.state_names.index(name)])


@dataclass(frozen=True, eq=False)
class EquilibriumProblem:
    """f(x, p) = 0 along one parameter; metric (n + 1,) weighs x and p."""

    system: System
    parameter: str
    metric: Array

    def __post_init__(self) -> None:
        self.system.index(self.parameter)

    @property
    def parameters(self) -> tuple[str, ...]:
        """The free parameter."""
        return (self.parameter,)

    @cached_property
    def along(self) -> Array:
        """Direction of the parameter, shape (1, m)."""
        return self.system.directions(self.parameter)

    # --- the curve -------------------------------------------------------------------------------

    def values(self, u: Array) -> Array:
        """The parameter's value, shape (1,)."""
        return u[-1:]

    def p(self, u: Array) -> Array:
        """The system's parameter vector (m,)."""
        return self.system.p(**{self.parameter: u[-1]})

    def residual(self, u: Array) -> Array:
        """f (n,)."""
        return self.system.rhs(u[:-1], self.p(u))

    def linearised(self, u: Array) -> DenseLinearisation:
        """f and [f_x, f_p] (n, n + 1)."""
        return DenseLinearisation(*self.system.evaluate(u[:-1], self.p(u), along=self.along))

    def renewed(self, point: Point) -> Renewal:
        """Nothing to renew."""
        return Renewal(self)

    def ended(self, point: Point) -> str:
        """An equilibrium curve has no end of its own."""
        return ""

    def solution(self, point: Point) -> EquilibriumPoint:
        """The state with its eigenvalues."""
        u = point.u
        return EquilibriumPoint(u[:-1], float(u[-1]), _spectrum(point), self.system.state_names)

    # --- what lies on it -------------------------------------------------------------------------

    def tests(self, point: Point) -> Mapping[str, float]:
        """LP: the tangent's parameter component; BP: det [J; tangent]; H: the product of the sums
        of all pairs of eigenvalues, which vanishes at +-iw and at +-a.
        """
        found = {
            "LP": float(point.tangent[-1]) * math.sqrt(self.metric[-1]),
            "BP": point.determinant,
        }
        return found | {"H": pair_sums(_spectrum(point))} if self.system.n > 1 else found

    def classify(self, test: str, point: Point) -> Finding:
        """What the zero of a test function is."""
        rules = {"LP": _fold, "BP": _branch_point, "H": _hopf}
        return rules[test](self, point)


@lru_cache(maxsize=4)
def _spectrum(point: Point) -> NDArray[Any]:
    """The eigenvalues at a point itself, where its linearisation may be a last correction off."""
    problem = point.problem
    return eigenvalues(problem.system.jacobian(point.u[:-1], problem.p(point.u)))


def _fold(problem: EquilibriumProblem, point: Point) -> Finding:
    if _branches(problem, point):
        words = "the curve turns in the parameter at a branch point; see there"
        return Finding("LP", words, artefact=True)
    x, p = point.u[:-1], problem.p(point.u)
    q = point.tangent[:-1] / np.linalg.norm(point.tangent[:-1])
    left = np.linalg.svd(problem.system.jacobian(x, p))[0][:, -1]
    if abs(left @ q) < DOUBLE:
        return Finding("LP", "fold with a double zero eigenvalue (Bogdanov-Takens)")
    a = float(left @ problem.system.form(x, p, q, q)) / float(2 * (left @ q))
    return Finding("LP", f"fold: two equilibria meet in {problem.parameter}", {"a": a})


def _branches(problem: EquilibriumProblem, point: Point) -> bool:
    """Whether the branch point test vanishes here too."""
    row, step = point.row, REACH * point.tangent
    here, ahead, behind = (
        problem.linearised(u).determinant(row) for u in (point.u, point.u + step, point.u - step)
    )
    return abs(here) * 2 * REACH <= SAME_PLACE * abs(ahead - behind)


def _branch_point(problem: EquilibriumProblem, point: Point) -> Finding:
    return Finding("BP", "branch point: another curve of equilibria crosses")


def _hopf(problem: EquilibriumProblem, point: Point) -> Finding:
    values = _spectrum(point)
    one, other = closest_to_opposite(values)
    if is_real(one, values):
        a = abs(one - other) / 2
        return Finding("NSE", "neutral saddle: real eigenvalues +-a; no bifurcation", {"a": a})
    return _with_criticality(problem, point, abs(one.imag))


def _with_criticality(problem: EquilibriumProblem, point: Point, frequency: float) -> Finding:
    """A Hopf point with its first Lyapunov coefficient, or why there is none."""
    x, p, system = point.u[:-1], problem.p(point.u), problem.system
    found = {"frequency": frequency}
    try:
        pair = critical_pair(system.jacobian(x, p), frequency)
        flc = first_lyapunov(system, x, p, pair)
    except NumericalOutcome as outcome:
        return Finding("H", f"Hopf; criticality undefined: {outcome}", found)
    return Finding("H", f"Hopf, {criticality(flc)}", found | {"FLC": flc})


def criticality(flc: float) -> str:
    """In a word, what a first Lyapunov coefficient says."""
    return "supercritical" if flc < 0 else "subcritical" if flc > 0 else "degenerate"
