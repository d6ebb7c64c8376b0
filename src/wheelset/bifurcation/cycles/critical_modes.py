"""The critical mode of a cycle and its adjoint, by bordered systems.

A mode v obeys v' - kappa T A v = kappa f S over the part of the cycle computed, with
v(1) = sigma S v(0): ``periodic`` has sigma = 1 and the scalar S (a fold when there is a solution
orthogonal to the phase shift), ``flip`` has sigma = -1 and no S (a period doubling, or the loss of
symmetry on half a period). The bordered system

    [ L    w0 ] [v, S]   [0]
    [ v0   0  ] [  g ] = [1]

is regular even where L is singular, and there g = 0: (v, S) is the mode. The transposed system
gives psi: the sum of psi times a forcing of v' is zero exactly for those the mode's equation can
bear. psi carries the quadrature weights.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numba import njit
from numpy.typing import NDArray

from wheelset.bifurcation.cycles.collocation import Collocation, Orbit
from wheelset.bifurcation.cycles.factors import Factors

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Borders:
    """column (N, m, n): the forcing w0. stages (N, m, n) and period: the row v0, weights included.

    flip: which of the two problems. phase (N, m n): weights of the phase condition.
    """

    column: Array
    stages: Array
    period: float
    flip: bool
    phase: Array

    @cached_property
    def rows(self) -> tuple[Array, Array]:
        """Border rows (k, N, m n) and their entries for the scalars (k, k)."""
        own = self.stages.reshape(self.phase.shape)
        if self.flip:
            return own[np.newaxis].copy(), np.zeros((1, 1))
        rows, scalars = np.empty((2, *own.shape)), np.zeros((2, 2))
        rows[0], rows[1], scalars[1, 0] = self.phase, own, self.period
        return rows, scalars


@dataclass(frozen=True, eq=False)
class Mode:
    """A critical mode: x (N + 1, n) at the mesh, v (N, m, n) at the stages, period S (0 for a
    flip), the adjoint psi (N, m, n), and g: zero at the bifurcation.
    """

    x: Array
    v: Array
    period: float
    psi: Array
    g: float


def mode(factors: Factors, borders: Borders, columns: NDArray[np.int64]) -> Mode:
    """The mode from factors whose columns hold the forcing by S (for a fold) and w0, in order."""
    space = factors.collocation
    N, m, n = space.shape
    signs = -space.signs if borders.flip else space.signs
    weights, D = borders.rows
    last = np.zeros(len(columns))
    last[-1] = 1.0
    _, x, X, c = factors.solve(columns, weights, D, None, last, signs)
    psi, _ = factors.transposed(columns, weights, D, last, signs)
    period = 0.0 if borders.flip else float(c[0])
    return Mode(x, X.reshape(N, m, n), period, psi, float(c[-1]))


def renewed(space: Collocation, borders: Borders, found: Mode, period_size: float) -> Borders:
    """Borders along the mode and its adjoint: the bordered system is then best conditioned."""
    column, stages, period = _fitted(space.weights, found.v, found.period, found.psi, period_size)
    return Borders(column, stages, period, borders.flip, borders.phase)


def with_phase(borders: Borders, phase: Array) -> Borders:
    """The same with another phase condition."""
    return Borders(borders.column, borders.stages, borders.period, borders.flip, phase)


@njit(cache=True, error_model="numpy")
def _fitted(
    weights: Array, v: Array, S: float, psi: Array, period_size: float
) -> tuple[Array, Array, float]:
    """w0 = -psi / weights, of length one: psi . w0 is negative, so psi keeps its sense; and the
    row of (v, S), of length one.
    """
    size, length = (S / period_size) ** 2, 0.0
    column, stages = np.empty(weights.shape), np.empty(weights.shape)
    for j in range(weights.shape[0]):
        for i in range(weights.shape[1]):
            for r in range(weights.shape[2]):
                size += weights[j, i, r] * v[j, i, r] ** 2
                length += psi[j, i, r] ** 2 / weights[j, i, r]
    size, length = np.sqrt(size), np.sqrt(length)
    for j in range(weights.shape[0]):
        for i in range(weights.shape[1]):
            for r in range(weights.shape[2]):
                column[j, i, r] = -psi[j, i, r] / (weights[j, i, r] * length)
                stages[j, i, r] = weights[j, i, r] * v[j, i, r] / size
    return column, stages, S / period_size**2 / size


def critical_mode(
    space: Collocation, orbit: Orbit, phase: Array, period_size: float, flip: bool
) -> tuple[Mode, Borders]:
    """The mode nearest to critical, from borders that know nothing, renewed until they fit."""
    f, J = space.evaluate(orbit)
    column = np.ones(space.shape) * space.scales
    borders = Borders(column, space.weights * column, 0.0, flip, phase)
    own = 1 + len(space.free)
    columns = np.array([own] if flip else [0, own])
    for _ in range(_ROUNDS):
        factors = Factors.of(space, J, f, orbit.period, borders.column[..., np.newaxis])
        found = mode(factors, borders, columns)
        borders = renewed(space, borders, found, period_size)
    return found, borders


#: Renewals of the borders: inverse iteration, which gains the ratio of the two least singular
#: values a round.
_ROUNDS = 4
