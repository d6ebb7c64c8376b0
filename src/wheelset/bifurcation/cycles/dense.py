"""Small dense linear systems, for use inside compiled functions."""

from __future__ import annotations

from typing import Any

import numpy as np

from wheelset.bifurcation.cycles.vectors import part


@part
def unit_matrix(n: int) -> Any:
    """The unit matrix (n, n)."""
    unit = np.zeros((n, n))
    for r in range(n):
        unit[r, r] = 1.0
    return unit


@part
def gauss_elimination(B: Any, x: Any) -> float:
    """Solve B y = x in place of x (size, columns), with row exchanges; B (size, size) is changed.

    Returns the determinant, 0 where a pivot vanishes.
    """
    size, determinant = B.shape[0], 1.0
    for k in range(size):
        best = k
        for i in range(k + 1, size):
            if abs(B[i, k]) > abs(B[best, k]):
                best = i
        if not abs(B[best, k]) > 0.0:
            return 0.0
        if best != k:
            determinant = -determinant
            _exchange(B, k, best)
            _exchange(x, k, best)
        determinant *= B[k, k]
        for i in range(k + 1, size):
            factor = B[i, k] / B[k, k]
            _subtract(B, i, factor, k)
            _subtract(x, i, factor, k)
    for k in range(size - 1, -1, -1):
        for s in range(x.shape[1]):
            x[k, s] /= B[k, k]
        for i in range(k):
            _subtract(x, i, B[i, k], k)
    return determinant


@part
def _exchange(B: Any, i: int, k: int) -> None:
    for s in range(B.shape[1]):
        B[i, s], B[k, s] = B[k, s], B[i, s]


@part
def _subtract(B: Any, i: int, factor: float, k: int) -> None:
    """Row i less a multiple of row k."""
    for s in range(B.shape[1]):
        B[i, s] -= factor * B[k, s]
