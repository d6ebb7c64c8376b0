"""Floquet multipliers of a cycle from its condensed linear problem.

With G x_0 + E x_N = 0 for every solution of the linearised equations, the eigenvalues of
-G x = mu E S x are those of S Phi: the monodromy matrix M for a full period (S = I), and
N = S Phi(T/2) for half a period of a symmetric cycle, where M = N^2.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray
from scipy.linalg.lapack import dgeev, dggev

from wheelset.bifurcation.cycles.dense import gauss_elimination
from wheelset.bifurcation.cycles.factors import Factors
from wheelset.bifurcation.outcomes import NoConvergence

Array = NDArray[np.float64]

#: A multiplier whose modulus exceeds one by less than this counts as on the unit circle.
UNIT = 1e-9


#: Entries of a monodromy matrix up to which it is formed.
GROWTH = 1e3


@dataclass(frozen=True, eq=False)
class Floquet:
    """Multipliers of the part of a cycle that was computed.

    computed (n,): eigenvalues of M, or of N where ``half``. The one nearest to +1 belongs to a
    shift of phase and is called trivial.
    """

    computed: NDArray[Any]
    half: bool

    @classmethod
    def of(cls, factors: Factors) -> Floquet:
        """Multipliers from the factors of the linearised equations."""
        space = factors.collocation
        matrix, small = _formed(factors.arrays[1], space.signs)
        if small:
            real, imaginary, _, _, info = dgeev(matrix, compute_vl=0, compute_vr=0)
            values = real + 1j * imaginary
        else:  # E is nearly singular where modes grow much: the pencil, which bears that
            values, info = _pencil_values(*factors.pencil, space.signs)
        if info:
            raise NoConvergence("the Floquet multipliers: a mode grows beyond all numbers", ())
        return cls(values, space.half)

    @property
    def multipliers(self) -> NDArray[Any]:
        """Eigenvalues of the monodromy matrix M over the full period, largest first, (n,)."""
        values = self.computed**2 if self.half else self.computed
        return np.asarray(values[np.argsort(-np.abs(values), kind="stable")])

    @cached_property
    def nontrivial(self) -> tuple[complex, ...]:
        """What was computed without the trivial multiplier, n - 1 numbers."""
        values = self.computed.tolist()
        nearest = min(range(len(values)), key=lambda i: abs(values[i] - 1))
        return (*values[:nearest], *values[nearest + 1 :])

    @property
    def unstable(self) -> int:
        """Number of multipliers outside the unit circle."""
        return sum(abs(value) > 1 + UNIT for value in self.nontrivial)

    @cached_property
    def watched(self) -> Watched:
        """The test functions along a branch of cycles."""
        return Watched(*_watched(self.computed, 0.0))

    def watched_beside(self, critical: float) -> Watched:
        """The same where a multiplier is critical, +1 or -1; ``torus`` leaves it out."""
        return Watched(*_watched(self.computed, critical))


class Watched(NamedTuple):
    """Test functions of the multipliers mu; the trivial one counts in ``flip`` alone.

    trivial_error: distance of the trivial multiplier from +1.
    fold: prod (mu_i - 1), each factor scaled by 1 + |mu_i|.
    flip: prod (mu_i + 1), scaled alike: zero where a period doubles, or, on half a period, where
    the symmetry breaks.
    torus: prod (mu_i mu_j - 1) over pairs, each factor scaled by 1 + |mu_i mu_j|: zero at
    Neimark-Sacker (a complex pair on the unit circle) and where two real ones are reciprocal; 1
    where there is no pair.
    """

    trivial_error: float
    fold: float
    flip: float
    torus: float


@njit(cache=True, error_model="numpy")
def _formed(links: Array, signs: Array) -> tuple[Array, bool]:
    """-(E S)^-1 G, and whether its entries are below ``GROWTH``; links (N, 3 n, 2 n) of
    ``reduction``.
    """
    n = signs.shape[0]
    ES, matrix = np.empty((n, n)), np.empty((n, n))
    for r in range(n):
        for c in range(n):
            matrix[r, c], ES[r, c] = -links[0, r, c], links[0, r, n + c] * signs[c]
    small = gauss_elimination(ES, matrix) != 0.0
    for r in range(n):
        for c in range(n):
            small = small and abs(matrix[r, c]) < GROWTH
    return matrix, small


@njit(cache=True, error_model="numpy")
def _watched(values: NDArray[Any], critical: float) -> tuple[float, float, float, float]:
    """The numbers of ``Watched``; critical: left out of the last one, none if 0."""
    n, fold, flip, torus = values.shape[0], 1.0 + 0.0j, 1.0 + 0.0j, 1.0 + 0.0j
    trivial = _nearest(values, 1.0, -1)
    other = -1 if critical == 0.0 else _nearest(values, critical, trivial)
    for i in range(n):
        scale = 1.0 + abs(values[i])
        flip *= (values[i] + 1.0) / scale
        if i != trivial:
            fold *= (values[i] - 1.0) / scale
            for j in range(i):
                if j != trivial and i != other and j != other:
                    product = values[i] * values[j]
                    torus *= (product - 1.0) / (1.0 + abs(product))
    return abs(values[trivial] - 1.0), fold.real, flip.real, torus.real


@njit(cache=True, error_model="numpy")
def _nearest(values: NDArray[Any], one: float, without: int) -> int:
    """Which of the values, but for one of them, is nearest to a number; -1 where there is none."""
    best, least = -1, np.inf
    for i in range(values.shape[0]):
        away = abs(values[i] - one)
        if i != without and away < least:
            best, least = i, away
    return best


def _pencil_values(G: Array, E: Array, signs: Array) -> tuple[NDArray[Any], int]:
    """Eigenvalues of -G x = mu E S x; a number that is not 0 where one is not finite."""
    real, imaginary, beta, _, _, _, info = dggev(-G, E * signs, compute_vl=0, compute_vr=0)
    values = (real + 1j * imaginary) / np.where(beta == 0, 1.0, beta)
    finite = beta.all() and np.isfinite(values).all()
    return values, info or int(not finite)
