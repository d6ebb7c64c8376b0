"""Folds and flips of cycles along two parameters, minimally augmented.

To the equations of a cycle one scalar is added, g = 0, where g comes from the bordered linear
problem of its critical mode (see ``critical_modes``). With the adjoint psi its derivative along a
change of orbit, period and parameters is

    dg = psi . [ kappa T (D2f[v, du] + D2f[v, dp]) + kappa dT A v + kappa S (A du + f_p dp) ]

so one factorisation gives g, its gradient and the Newton step. A fold (S unknown, v(1) = S v(0)) is
an LPC; a flip (v(1) = -S v(0)) is a period doubling, or the loss of symmetry on half a period.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numba import njit
from numpy.typing import NDArray

from wheelset.bifurcation.curves.locate import any_tangent
from wheelset.bifurcation.curves.zero_problem import Finding, Point, Renewal
from wheelset.bifurcation.cycles import critical_modes, critical_points, meshes
from wheelset.bifurcation.cycles.collocation import Collocation, Orbit
from wheelset.bifurcation.cycles.critical_modes import Borders, Mode
from wheelset.bifurcation.cycles.cycle import Cycle
from wheelset.bifurcation.cycles.cycle_curve import CycleCurve
from wheelset.bifurcation.cycles.factors import Factors
from wheelset.bifurcation.cycles.floquet import Floquet

Array = NDArray[np.float64]

#: How a curve of folds ends where its cycles have no size.
GH_END = "the cycle shrank to an equilibrium: a generalised Hopf point"

#: Size of a cycle, in the norm of the state's scales, below which its curve has arrived at a
#: generalised Hopf point: the equations lose their regularity there.
SMALLEST = 2e-3

#: Columns of the mode's problem among T, the two parameters and w0.
_FOLD, _FLIP = np.array([0, 3]), np.array([3])


@dataclass(frozen=True, eq=False)
class CriticalLinearisation:
    """The equations of a cycle, phase and g, linearised and factored.

    residual: [stages | mesh | boundary | phase | g]. rows (2, N, m n), scalars (2, 3): phase
    condition and gradient of g, on stages and on (T, p1, p2).
    """

    curve: CriticalCurve
    residual: Array
    factors: Factors
    mode: Mode
    rows: Array
    scalars: Array

    def newton(self, row: Array) -> tuple[Array, Array]:
        """x and t with J x = residual, row . x = 0, and J t = 0, row . t = 1."""
        return self.factors.newton(self.rows, self.scalars, row, self.residual)[1:]

    def determinant(self, row: Array) -> float:
        """det [J; row] up to a positive factor."""
        return self.factors.newton(self.rows, self.scalars, row, self.residual)[0]

    @cached_property
    def floquet(self) -> Floquet:
        """Multipliers of the cycle."""
        return Floquet.of(self.factors)


@dataclass(frozen=True, eq=False)
class CriticalCurve:
    """Cycles with a critical mode, over two free parameters.

    cycles: the cycles' own equations, whose space has the two parameters free. borders: of the
    mode's problem. adapt, age: as for ``CycleCurve``.
    """

    cycles: CycleCurve
    borders: Borders

    @property
    def space(self) -> Collocation:
        """The discretisation."""
        return self.cycles.space

    @property
    def flip(self) -> bool:
        """Whether the mode changes sign over the part computed."""
        return self.borders.flip

    @property
    def parameters(self) -> tuple[str, ...]:
        """The two free parameters."""
        return self.space.free

    @property
    def metric(self) -> Array:
        """The cycles' own metric."""
        return self.cycles.metric

    def values(self, u: Array) -> Array:
        """The two free parameters."""
        return self.space.split(u).free

    def residual(self, u: Array) -> Array:
        """[stages | mesh | boundary | phase | g]."""
        return self.linearised(u).residual

    def linearised(self, u: Array) -> CriticalLinearisation:
        """One factorisation, the mode and its adjoint, and the gradient of g."""
        anchor, column = self.cycles.anchor, self.borders.column[..., np.newaxis]
        at = Factors.at(self.space, u, anchor.row, anchor.level, column)
        found = critical_modes.mode(at.factors, self.borders, _FLIP if self.flip else _FOLD)
        rows, scalars = self._rows(at.orbit, at.J, found)
        residual = np.append(at.residual, found.g)
        return CriticalLinearisation(self, residual, at.factors, found, rows, scalars)

    def _rows(self, orbit: Orbit, J: Array, found: Mode) -> tuple[Array, Array]:
        """Phase condition and gradient of g, by the stages (2, N, m n) and (T, p1, p2) (2, 3)."""
        second = self.space.curvature(orbit, found.v, found.psi)
        return _gradient(
            self.cycles.anchor.row, J, second, found.v, found.psi, self.space.kappa, orbit.period,
            found.period,
        )  # fmt: skip

    def renewed(self, point: Point) -> Renewal:
        """Phase reference, borders and, now and then, the mesh are renewed."""
        borders = critical_modes.renewed(
            self.space, self.borders, point.linearisation.mode, float(self.cycles.sizes[0])
        )
        error = self._estimated(point.u) if self.cycles.due else 0.0
        renewal = self.cycles.renewal(point.u, error)
        cycles: CycleCurve = renewal.problem
        if renewal.transfer is not None:
            borders = self._moved(borders, cycles.space)
        anchored = critical_modes.with_phase(borders, cycles.anchor.row)
        return Renewal(CriticalCurve(cycles, anchored), renewal.transfer)

    def _estimated(self, u: Array) -> float:
        """Estimated error: that of the branch of cycles in the first parameter alone."""
        if self.cycles.known_error is not None:
            return self.cycles.known_error
        cycles, free = self.cycles, self.space.split(u).free
        one = replace(self.space, free=self.space.free[:1], p=self.space.parameters(free))
        branch = replace(
            cycles, space=one, sizes=cycles.sizes[:2], metric=np.ascontiguousarray(self.metric[:-1])
        )
        tangent = any_tangent(branch.linearised(u[:-1]), branch.metric)
        return branch.estimated(u[:-1], tangent)

    def _moved(self, borders: Borders, space: Collocation) -> Borders:
        """Borders as functions of the phase, on another mesh."""

        def carried(stages: Array) -> Array:
            return meshes.carried(self.space, space, stages)

        column, row = carried(borders.column), carried(borders.stages / self.space.weights)
        return replace(borders, column=column, stages=row * space.weights)

    def tests(self, point: Point) -> Mapping[str, float]:
        """Test functions; see ``critical_points``."""
        return critical_points.tests(self, point)

    def classify(self, test: str, point: Point) -> Finding:
        """CPC, R1, LPPD, LPNS; R2, GPD, LPPD, PDNS."""
        return critical_points.finding(self, test, point)

    def solution(self, point: Point) -> Cycle:
        """The critical cycle."""
        return self.cycles.cycle(point.u, point.linearisation.floquet)

    def ended(self, point: Point) -> str:
        """Ends where the cycle has no size: at a generalised Hopf point."""
        if self.cycles.alignment(point.u) < SMALLEST**2:  # of about the size's square
            return GH_END
        return self.cycles.ended(point)


@njit(cache=True, error_model="numpy")
def _gradient(
    phase: Array, J: Array, second: Array, v: Array, psi: Array, kappa: float, period: float,
    S: float,
) -> tuple[Array, Array]:  # fmt: skip
    """Phase condition and dg as rows on the stages (2, N, m n) and on (T, p1, p2) (2, 3).

    second (N, m, n + 2): gradient of psi . (Df v) by states and parameters.
    """
    N, m, n, width = J.shape
    rows, scalars = np.empty((2, N, m * n)), np.zeros((2, 1 + width - n))
    rows[0] = phase
    for j in range(N):
        for i in range(m):
            for s in range(width):
                first = 0.0
                for r in range(n):
                    first += psi[j, i, r] * J[j, i, r, s]
                by = kappa * (period * second[j, i, s] + S * first)
                if s < n:
                    rows[1, j, i * n + s] = by
                    scalars[1, 0] += kappa * first * v[j, i, s]
                else:
                    scalars[1, 1 + s - n] += by
    return rows, scalars
