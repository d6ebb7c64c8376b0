"""Complex linear problems of a cycle: v' - kappa T A v + i w v = g, v(1) = S v(0).

They occur at a Neimark-Sacker point only, a few at a time, so the mesh values are solved for at
once, by a dense matrix of order N n.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from wheelset.bifurcation.cycles.collocation import Collocation

Complex = NDArray[Any]


@dataclass(frozen=True, eq=False)
class Twisted:
    """The operator L v = v' - A v + i w v for A (N, m, n, n) at the stages; w is the ``turn``."""

    space: Collocation
    A: NDArray[np.float64]
    turn: float

    @cached_property
    def _stages(self) -> Complex:
        """Matrices (N, m n, m n) of the Runge-Kutta form of collocation."""
        (N, m, n), rule = self.space.shape, self.space.rule
        field = self.A - 1j * self.turn * np.eye(n)
        blocks = np.einsum("j,il,jlrs->jirls", self.space.h, rule.a, field)
        return np.eye(m * n) - blocks.reshape(N, m * n, m * n)

    @cached_property
    def _carry(self) -> Complex:
        """Stages (N, m n, n) for unit values at the left end of their interval."""
        N, m, n = self.space.shape
        ones = np.broadcast_to(np.tile(np.eye(n), (m, 1)), (N, m * n, n))
        return np.linalg.solve(self._stages, ones)

    @cached_property
    def _mesh(self) -> Complex:
        """The matrix (N n, N n) of x_{j+1} - Phi_j x_j with x_N = S x_0."""
        (N, m, n), rule = self.space.shape, self.space.rule
        carry = self._carry.reshape(N, m, n, n)
        phi = rule.end * np.eye(n) + np.einsum("i,jirs->jrs", rule.d, carry)
        matrix = np.zeros((N, n, N, n), dtype=complex)
        for j in range(N):
            matrix[j, :, j] -= phi[j]
            matrix[j, :, (j + 1) % N] += np.diag(self.space.signs) if j + 1 == N else np.eye(n)
        return matrix.reshape(N * n, N * n)

    def solve(self, g: Complex) -> Complex:
        """v (N, m, n) at the stages, for a forcing g (N, m, n)."""
        (N, m, n), rule = self.space.shape, self.space.rule
        forced = np.einsum("j,il,jlr->jir", self.space.h, rule.a, g).reshape(N, m * n, 1)
        own = np.linalg.solve(self._stages, forced)[..., 0]
        right = np.einsum("i,jir->jr", rule.d, own.reshape(N, m, n)).ravel()
        return self._expanded(np.linalg.solve(self._mesh, right), own)

    def kernel(self) -> tuple[Complex, Complex]:
        """v (N, m, n) with L v = 0, and psi (N, m, n), whose sum with a forcing vanishes when L can
        bear it: singular vectors of the least singular value.
        """
        (N, m, n), rule = self.space.shape, self.space.rule
        left, _, right = np.linalg.svd(self._mesh)
        v = self._expanded(right[-1].conj(), np.zeros((N, m * n)))
        multipliers = left[:, -1].conj().reshape(N, n)
        weighted = np.einsum("i,jr->jir", rule.d, multipliers).reshape(N, m * n, 1)
        back = np.linalg.solve(self._stages.transpose(0, 2, 1), weighted).reshape(N, m, n)
        return v, np.einsum("j,il,jir->jlr", self.space.h, rule.a, back)

    def _expanded(self, x: Complex, own: Complex) -> Complex:
        N, m, n = self.space.shape
        carried = (self._carry @ x.reshape(N, n, 1))[..., 0]
        return (carried + own).reshape(N, m, n)
