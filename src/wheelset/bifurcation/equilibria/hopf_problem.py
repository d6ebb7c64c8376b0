"""Hopf points in two parameters as a zero problem: u = (x, p1, p2, k) with k = w^2.

f(x, p) = 0 (n equations) and the condition that A^2 + k has a plane of null vectors (2 equations);
exact second derivatives, nothing singular where the frequency falls to zero.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from wheelset.bifurcation.compiled.batched import MeshKernel
from wheelset.bifurcation.curves.zero_problem import DenseLinearisation, Finding, Point, Renewal
from wheelset.bifurcation.equilibria.hopf_borders import Borders, borders_at, condition
from wheelset.bifurcation.equilibria.hopf_points import (
    HopfCurvePoint,
    classified,
    examined,
    watched,
)
from wheelset.bifurcation.system import System

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class HopfProblem:
    """Hopf points of a system along two parameters.

    metric (n + 3,): weighs x, p1, p2 and k. scale (n,), rate: a similarity of the state and a unit
    of time, rad/s, in which A is computed. borders: near the null vectors at the last point.
    """

    system: System
    parameters: tuple[str, str]
    metric: Array
    scale: Array
    rate: float
    borders: Borders

    @cached_property
    def along(self) -> Array:
        """Directions of the two parameters, shape (2, m)."""
        return self.system.directions(*self.parameters)

    @cached_property
    def curvature(self) -> MeshKernel:
        """The gradients of psi . A v, compiled."""
        return self.system.curvature_kernel(2)

    # --- the curve -------------------------------------------------------------------------------

    def values(self, u: Array) -> Array:
        """The two parameters, shape (2,)."""
        return u[-3:-1]

    def p(self, u: Array) -> Array:
        """The system's parameter vector (m,)."""
        return self.system.p(**dict(zip(self.parameters, u[-3:-1], strict=True)))

    def scaled(self, jacobian: Array) -> Array:
        """A in the problem's units of state and time."""
        return np.asarray(jacobian * (self.scale / self.scale[:, np.newaxis]) / self.rate)

    def residual(self, u: Array) -> Array:
        """f (n,) and the condition (2,)."""
        return self.linearised(u).residual

    def linearised(self, u: Array) -> DenseLinearisation:
        """Both with their Jacobian (n + 2, n + 3)."""
        n = self.system.n
        f, derivative = self.system.evaluate(u[:n], self.p(u), along=self.along)
        A, k = self.scaled(derivative[:, :n]), u[-1] / self.rate**2
        g, q, psi = condition(A, k, self.borders)
        jacobian = np.zeros((n + 2, n + 3))
        jacobian[:n, : n + 2] = derivative
        jacobian[n:, : n + 2] = -self._gradient(u, A, q, psi)
        jacobian[n:, n + 2] = -(psi.T @ q) / self.rate**2
        return DenseLinearisation(np.concatenate([f, g]), jacobian)

    def _gradient(self, u: Array, A: Array, q: Array, psi: Array) -> Array:
        """Gradients of psi_i . A^2 q by states and parameters, shape (2, n + 2): the derivatives of
        psi_i . A (A q) and (A^T psi_i) . A q with what stands beside the one A fixed.
        """
        twice = np.array([A @ q, q] * 2)
        left = np.array([row for one in psi.T for row in (one, A.T @ one)])
        states, by_one = np.tile(u[: self.system.n], (4, 1)), np.empty((4, self.system.n + 2))
        self.curvature(states, self.p(u), self.along, twice * self.scale, left / self.scale, by_one)
        return np.asarray((by_one[::2] + by_one[1::2]) / self.rate)

    def renewed(self, point: Point) -> Renewal:
        """With borders from the point itself."""
        u = point.u
        A = self.scaled(self.system.jacobian(u[: self.system.n], self.p(u)))
        return Renewal(replace(self, borders=borders_at(A, u[-1] / self.rate**2)))

    def ended(self, point: Point) -> str:
        """A Hopf curve has no end of its own: it goes on as a neutral saddle curve."""
        return ""

    # --- what lies on it -------------------------------------------------------------------------

    def tests(self, point: Point) -> Mapping[str, float]:
        """BT, and before it GH, ZH, HH."""
        return watched(examined(point))

    def classify(self, test: str, point: Point) -> Finding:
        """What the zero of a test function is."""
        return classified(test, examined(point))

    def solution(self, point: Point) -> HopfCurvePoint:
        """The point with its frequency, first Lyapunov coefficient and eigenvalues."""
        return examined(point).solution
