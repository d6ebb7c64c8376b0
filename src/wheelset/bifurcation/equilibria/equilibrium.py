"""Equilibria f(x, p) = 0 and their eigenvalues along one parameter."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import linear_sum_assignment

from wheelset.bifurcation.equilibria.spectrum import eigenvalues
from wheelset.bifurcation.outcomes import NoConvergence
from wheelset.bifurcation.system import System

Array = NDArray[np.float64]

#: Newton stops when a step is this small, relative and absolute, in every component of the state.
STEP_TOLERANCE = 1e-12, 1e-14
MAX_ITERATIONS = 30


def equilibrium(system: System, p: Array, guess: ArrayLike | None = None) -> tuple[Array, Array]:
    """The equilibrium (n,) Newton's method reaches from ``guess`` (default: the origin), and the
    Jacobian (n, n) there.

    Raises NoConvergence with the residual history, or the field's own outcome.
    """
    x = np.zeros(system.n) if guess is None else np.array(guess, dtype=np.float64)
    residuals: list[float] = []
    for _ in range(MAX_ITERATIONS):
        f, jacobian = system.evaluate(x, p)
        residuals.append(math.sqrt(f @ f))
        if residuals[-1] == 0.0:
            return x, jacobian
        step = _solve(jacobian, -f, residuals)
        x = x + step
        relative, absolute = STEP_TOLERANCE
        if np.all(np.abs(step) <= relative * np.abs(x) + absolute):
            return x, system.jacobian(x, p)
    raise NoConvergence("Newton's method for an equilibrium", tuple(residuals))


def _solve(jacobian: Array, rhs: Array, residuals: list[float]) -> Array:
    try:
        return np.asarray(np.linalg.solve(jacobian, rhs), dtype=np.float64)
    except np.linalg.LinAlgError:
        raise NoConvergence("singular Jacobian in Newton's method", tuple(residuals)) from None


@dataclass
class EquilibriumPath:
    """Equilibria over one parameter, each found from the nearest one known."""

    system: System
    parameter: str
    guess: Array
    known: dict[float, tuple[Array, Array]] = field(default_factory=dict)
    spectra: dict[float, NDArray[Any]] = field(default_factory=dict)

    def p(self, value: float) -> Array:
        """Parameter vector with the path's parameter at ``value``."""
        return self.system.p(**{self.parameter: value})

    def at(self, value: float) -> tuple[Array, Array]:
        """The equilibrium (n,) and its Jacobian (n, n) at a parameter value."""
        if value not in self.known:
            near = min(self.known, key=lambda v: abs(v - value), default=None)
            start = self.guess if near is None else self.known[near][0]
            self.known[value] = equilibrium(self.system, self.p(value), start)
        return self.known[value]

    def state(self, value: float) -> Array:
        """The equilibrium (n,)."""
        return self.at(value)[0]

    def jacobian(self, value: float) -> Array:
        """df/dx (n, n) at the equilibrium."""
        return self.at(value)[1]

    def eigenvalues(self, value: float) -> NDArray[Any]:
        """Eigenvalues of the Jacobian at the equilibrium, complex, shape (n,)."""
        if value not in self.spectra:
            self.spectra[value] = eigenvalues(self.jacobian(value))
        return self.spectra[value]


@dataclass(frozen=True)
class EigenvalueLoci:
    """Eigenvalues followed along a parameter.

    values (points,), states (points, n), eigenvalues (points, n) in 1/s, each column one locus.
    """

    parameter: str
    values: Array
    states: Array
    eigenvalues: NDArray[Any]


def eigenvalue_loci(
    system: System, parameter: str, values: ArrayLike, guess: ArrayLike | None = None
) -> EigenvalueLoci:
    """All eigenvalues of the equilibrium at each value; neighbours are matched by distance."""
    path = equilibrium_path(system, parameter, guess)
    grid = np.asarray(values, dtype=np.float64)
    raw = np.array([path.eigenvalues(v) for v in grid])
    for i in range(1, len(raw)):
        distance = np.abs(raw[i - 1][:, None] - raw[i][None, :])
        raw[i] = raw[i][linear_sum_assignment(distance)[1]]
    return EigenvalueLoci(parameter, grid, np.array([path.state(v) for v in grid]), raw)


def equilibrium_path(
    system: System, parameter: str, guess: ArrayLike | None = None
) -> EquilibriumPath:
    """Equilibria of a system over one of its parameters, starting from a guess."""
    system.index(parameter)
    start = np.zeros(system.n) if guess is None else np.asarray(guess, dtype=np.float64)
    return EquilibriumPath(system, parameter, start)
