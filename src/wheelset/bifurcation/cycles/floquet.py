"""Floquet multipliers of a cycle from its condensed linear problem.

With G x_0 + E x_N = 0 for every solution of the linearised equations, the eigenvalues of
-G x = mu E S x are those of S Phi: the monodromy matrix M for a full period (S = I), and
N = S Phi(T/2) for half a period of a symmetric cycle, where M = N^2.
"""

from __future__ import annotations

import cmath
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations
from typing import Any

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
        G, E = factors.pencil
        signs = factors.collocation.signs
        matrix = -G
        if _solved(E * signs, matrix) < GROWTH:
            real, imaginary, _, _, info = dgeev(matrix, compute_vl=0, compute_vr=0)
            values = real + 1j * imaginary
        else:  # E is nearly singular where modes grow much: the pencil, which bears that
            values, info = _pencil_values(G, E * signs)
        if info or not cmath.isfinite(values.sum()):
            raise NoConvergence("the Floquet multipliers: a mode grows beyond all numbers", ())
        return cls(values, factors.collocation.half)

    @property
    def multipliers(self) -> NDArray[Any]:
        """Eigenvalues of the monodromy matrix M over the full period, largest first, (n,)."""
        values = self.computed**2 if self.half else self.computed
        return np.asarray(values[np.argsort(-np.abs(values), kind="stable")])

    @cached_property
    def nontrivial(self) -> tuple[complex, ...]:
        """What was computed without the trivial multiplier, n - 1 numbers."""
        return _without(self.computed.tolist(), 1.0)

    @property
    def trivial_error(self) -> float:
        """Distance of the trivial multiplier from +1."""
        return min(abs(value - 1) for value in self.computed.tolist())

    @property
    def unstable(self) -> int:
        """Number of multipliers outside the unit circle."""
        return sum(abs(value) > 1 + UNIT for value in self.nontrivial)

    @property
    def torus(self) -> float:
        """prod (mu_i mu_j - 1) over pairs of nontrivial multipliers: zero at Neimark-Sacker (a
        complex pair on the unit circle) and where two real ones are reciprocal. Each factor is
        scaled by 1 + |mu_i mu_j|; 1 where there is no pair.
        """
        return _pairs(self.nontrivial)

    def torus_beside(self, critical: float) -> float:
        """``torus`` without the multiplier nearest to a critical one, +1 or -1."""
        return _pairs(_without(self.nontrivial, critical))

    @property
    def fold(self) -> float:
        """prod (mu_i - 1) over nontrivial multipliers, each factor scaled by 1 + |mu_i|."""
        return _product(self.nontrivial, 1.0)

    @property
    def flip(self) -> float:
        """prod (mu_i + 1) over what was computed, each factor scaled by 1 + |mu_i|: zero where a
        period doubles, or, on half a period, where the symmetry breaks.
        """
        return _product(self.computed.tolist(), -1.0)


@njit(cache=True, error_model="numpy")
def _solved(A: Array, B: Array) -> float:
    """B <- A^-1 B; its greatest entry, inf where A is singular."""
    most = 0.0 if gauss_elimination(A, B) != 0.0 else np.inf
    for r in range(B.shape[0]):
        for c in range(B.shape[1]):
            most = max(most, abs(B[r, c]))
    return most


def _pencil_values(G: Array, ES: Array) -> tuple[NDArray[Any], int]:
    """Eigenvalues of -G x = mu E S x; a number that is not 0 where one is infinite."""
    real, imaginary, beta, _, _, _, info = dggev(-G, ES, compute_vl=0, compute_vr=0)
    values = (real + 1j * imaginary) / np.where(beta == 0, 1.0, beta)
    return values, info or int(not beta.all())


def _product(values: Sequence[complex], critical: float) -> float:
    """prod (mu_i - critical)/(1 + |mu_i|)."""
    product = 1.0 + 0.0j
    for value in values:
        product *= (value - critical) / (1 + abs(value))
    return product.real


def _without(values: Sequence[complex], one: float) -> tuple[complex, ...]:
    """Values without the one nearest to a number."""
    nearest = min(range(len(values)), key=lambda i: abs(values[i] - one))
    return (*values[:nearest], *values[nearest + 1 :])


def _pairs(values: Sequence[complex]) -> float:
    """prod (mu_i mu_j - 1)/(1 + |mu_i mu_j|) over pairs."""
    product = 1.0 + 0.0j
    for a, b in combinations(values, 2):
        product *= (a * b - 1) / (1 + abs(a * b))
    return product.real
