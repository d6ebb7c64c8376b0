"""One shape for every curve: a zero problem F(u) = 0 with F: R^N -> R^(N-1), and its points.

The continuer never learns what it follows. A problem says how to linearise itself, which test
functions to watch, what a zero of one of them is, and what to keep of a point.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.linalg.lapack import dgesv, dgetrf

from wheelset.bifurcation.outcomes import NumericalOutcome

Array = NDArray[np.float64]


@dataclass(eq=False)
class SingularSystem(NumericalOutcome):
    """A linear system without a unique solution; ``what`` says which."""

    what: str

    def __str__(self) -> str:
        return f"singular system: {self.what}"


class Linearisation(Protocol):
    """J = dF/du (N-1, N) at one u, factored."""

    @property
    def residual(self) -> Array:
        """F(u), shape (N-1,)."""
        ...

    def newton(self, row: Array) -> tuple[Array, Array]:
        """x and t (N,) with J x = F, row . x = 0, and J t = 0, row . t = 1: Newton's correction
        across a row and the curve's direction; SingularSystem when there are none.
        """
        ...

    def determinant(self, row: Array) -> float:
        """det [J; row] up to a positive factor that varies smoothly along a curve."""
        ...


class ZeroProblem(Protocol):
    """A curve to follow."""

    @property
    def parameters(self) -> tuple[str, ...]:
        """Names of the free parameters, whose values are in u."""
        ...

    @property
    def metric(self) -> Array:
        """Positive weights (N,) of the scaled inner product <a, b> = sum(metric * a * b)."""
        ...

    def values(self, u: Array) -> Array:
        """Values of the free parameters at u, shape (len(parameters),), SI."""
        ...

    def residual(self, u: Array) -> Array:
        """F(u), shape (N-1,); cheap."""
        ...

    def linearised(self, u: Array) -> Linearisation:
        """F and its factored Jacobian at u; a NumericalOutcome where F is not defined."""
        ...

    def renewed(self, point: Point) -> Renewal:
        """The problem to go on with after an accepted point: new phase reference, borders, mesh.

        Test functions have to stay the same across a renewal, up to positive factors.
        """
        ...

    def tests(self, point: Point) -> Mapping[str, float]:
        """Test functions by name: smooth, and each sign change is a candidate."""
        ...

    def classify(self, test: str, point: Point) -> Finding:
        """What a located zero of a test function is."""
        ...

    def solution(self, point: Point) -> Any:
        """What a branch keeps of a point: a frozen dataclass of arrays and numbers."""
        ...

    def ended(self, point: Point) -> str:
        """Empty to go on, or in words why the curve ends at this point."""
        ...


@dataclass(frozen=True, eq=False)
class Point:
    """A point of a curve.

    u (N,): unknowns. tangent (N,): of length one in the problem's metric, along the walk.
    known: its linearisation where there is one, else that is made when asked for.
    """

    problem: Any
    u: Array
    tangent: Array
    known: Any = None

    @cached_property
    def linearisation(self) -> Any:
        """A ``Linearisation`` at u, or within Newton's tolerance of it."""
        return self.problem.linearised(self.u) if self.known is None else self.known

    @property
    def row(self) -> Array:
        """The tangent as a row: ``row @ x`` is <tangent, x>."""
        return np.asarray(self.problem.metric * self.tangent)

    @property
    def determinant(self) -> float:
        """det [J; row]: its sign changes at a branch point, not at a fold."""
        return self.linearisation.determinant(self.row)


@dataclass(frozen=True, eq=False)
class Renewal:
    """The renewed problem. transfer maps points and tangents of the old problem, rows (..., N), to
    the unknowns of the new one when its mesh changed; None when the unknowns are the same.
    """

    problem: Any
    transfer: Callable[[Array], Array] | None = None


@dataclass(frozen=True)
class Finding:
    """What a zero of a test function is: the field's letters ("" for nothing), a sentence, and
    coefficients by name; an artefact is kept apart from the special points.
    """

    kind: str
    words: str
    coefficients: Mapping[str, float] = field(default_factory=dict)
    artefact: bool = False


@dataclass(frozen=True, eq=False)
class DenseLinearisation:
    """A small linearisation: residual (N-1,) and jacobian (N-1, N), solved by LAPACK."""

    residual: Array
    jacobian: Array

    def newton(self, row: Array) -> tuple[Array, Array]:
        """x and t (N,) with J x = F, row . x = 0, and J t = 0, row . t = 1."""
        right = np.zeros((2, len(row)))
        right[0, :-1], right[1, -1] = self.residual, 1.0
        _, _, x, info = dgesv(self._bordered(row), right.T, 1, 1)
        if info or not math.isfinite(x.sum()):
            raise SingularSystem("the Jacobian bordered by a row")
        correction, tangent = x.T
        return correction, tangent

    def determinant(self, row: Array) -> float:
        """det [J; row]."""
        lu, pivots, _ = dgetrf(self._bordered(row), 1)
        swaps = int((pivots != np.arange(len(row))).sum())
        return float(lu.diagonal().prod()) * (-1.0 if swaps % 2 else 1.0)

    def _bordered(self, row: Array) -> Array:
        """[J; row], in the column order that LAPACK overwrites without a copy."""
        matrix = np.empty((len(row), len(row)), order="F")
        matrix[:-1], matrix[-1] = self.jacobian, row
        return matrix
