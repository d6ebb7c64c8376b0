"""One shape for every curve: a zero problem F(u) = 0 with F: R^N -> R^(N-1), and its points.

The continuer never learns what it follows. A problem says how to linearise itself, which test
functions to watch, what a zero of one of them is, and what to keep of a point.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
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

    def solve(self, row: Array, rhs: Array | None, last: float) -> Array:
        """x (N,) with J x = rhs (None: zero) and row . x = last; SingularSystem when it cannot."""
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
    linearisation: a ``Linearisation`` at u, or within Newton's tolerance of it.
    """

    problem: Any
    u: Array
    tangent: Array
    linearisation: Any

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
    """The renewed problem. transfer maps points and tangents of the old problem to the unknowns of
    the new one when its mesh changed; None when the unknowns are the same.
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

    def solve(self, row: Array, rhs: Array | None, last: float) -> Array:
        """x (N,) with J x = rhs (None: zero) and row . x = last."""
        right = np.zeros(len(row))
        if rhs is not None:
            right[:-1] = rhs
        right[-1] = last
        _, _, x, info = dgesv(self._bordered(row), right, 1, 1)
        if info or not math.isfinite(x.sum()):
            raise SingularSystem("the Jacobian bordered by a row")
        return np.asarray(x, dtype=np.float64)

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
