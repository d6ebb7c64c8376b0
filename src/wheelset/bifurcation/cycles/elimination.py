"""The linear stage equations of every mesh interval, solved once for all right-hand sides.

With b = a^-1 (``Gauss.slopes``) the stages of interval j obey, one n-block a stage i,

    sum_l b_il (X_jl - x_j) - h_j (A_ji X_ji + g_ji c) = rho_ji,

A = kappa T Df, and x_{j+1} = end x_j + sum_i d_i X_ji. They are linear in rho, x_j and c:

    responses (N, m n + n + q, m n + n)    [X_j1 .. X_jm | x_{j+1}] to a unit of each of
                                           [rho_j (m n) | x_j (n) | c (q)], one row each

Scalars c: the period (forcing kappa f), the free parameters (kappa T f_p), further forcings.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from wheelset.bifurcation.cycles.dense import gauss_elimination, unit_matrix
from wheelset.bifurcation.cycles.vectors import load, part, plus, store, times, zeros

#: Greatest entry on the diagonal of the inverse of a stage's pivot block (about 1/4 on a fine mesh,
#: whatever the units) up to which stages are eliminated in order: rounding errors grow like it.
SAFE = 20.0

#: The same of the whole inverse, beyond which an interval counts as singular.
SINGULAR = 1e12


@part
def eliminate(
    J: Any, f: Any, extra: Any, kappa: float, period: float, h: Any, slopes: Any, at_one: Any,
    signs: Any, responses: Any,
) -> tuple[float, int]:  # fmt: skip
    """Fill the responses. J (N, m, n, n + k), f (N, m, n), extra (N, m, n, e): Df and f_p, f, and
    further forcings at the stages. at_one: (end, d_1 .. d_m); signs: any tuple of n floats.

    Returns the sign of the stages' determinant, and the first singular interval or -1.
    """
    unit = unit_matrix(len(signs))
    sign = 1.0
    for j in range(len(h)):
        w, time = responses[j], kappa * period * h[j]
        _assemble(w, J, j, time, slopes, at_one, signs, unit)
        turn = _invert(w, at_one, signs, unit)
        if turn == 0.0:
            _assemble(w, J, j, time, slopes, at_one, signs, unit)
            turn = _invert_at_large(w, len(signs))
        if turn == 0.0:
            return 0.0, j
        sign *= turn
        _respond(w, J, f, extra, j, h[j], kappa, period, slopes, at_one, signs)
        _step_over(w, at_one, signs, unit)
    return sign, -1


@part
def _assemble(
    w: Any, J: Any, j: int, time: float, slopes: Any, at_one: Any, signs: Any, unit: Any
) -> None:
    """The transposed stage matrix in the last m blocks of columns of w; time = h_j kappa T."""
    n, m = len(signs), len(at_one) - 1
    narrow = zeros(signs, (0,))
    for i in range(m):
        for r in range(n):
            row, own = i * n + r, load(narrow, unit, (r, 0))
            for other in range(m):
                store(w, (row, (other + 1) * n), times(slopes[other, i + 1], own))
            for s in range(n):
                w[row, (i + 1) * n + s] -= time * J[j, i, s, r]


@part
def _invert(w: Any, at_one: Any, signs: Any, unit: Any) -> float:
    """Gauss-Jordan elimination of the matrix in the last m blocks of columns of w, stage by stage:
    its inverse is left in the first m.

    Once stage p - 1 is done, its block of columns is a unit matrix, and as good as the next one:
    rewritten as that, it becomes column p of the inverse. Returns the sign of the determinant, 0
    where a stage is not ``SAFE`` to eliminate.
    """
    n, m = len(signs), len(at_one) - 1
    narrow = zeros(signs, (0,))
    sign = 1.0
    for p in range(m):
        for i in range(m * n):
            store(w, (i, p * n), narrow)
        for r in range(n):
            store(w, (p * n + r, p * n), load(narrow, unit, (r, 0)))
        sign *= _solve_stage(w, p * n, at_one, signs)
        if sign == 0.0:
            return 0.0
        _clear(w, p * n, at_one, signs)
    return sign


@part
def _solve_stage(w: Any, top: int, at_one: Any, signs: Any) -> float:
    """Row operations with pivoting on n rows of w that make their own block the unit matrix.

    Returns the sign of the block's determinant, 0 where it is not safe.
    """
    n, at = len(signs), top + len(signs)
    wide = zeros(signs, at_one)
    sign = 1.0
    for k in range(n):
        best, most = top + k, abs(w[top + k, at + k])
        for i in range(n):
            size = abs(w[top + i, at + k])
            better = i > k and size > most
            best = top + i if better else best
            most = size if better else most
        if not most > 0.0:
            return 0.0
        pivot = w[best, at + k]
        row = times(1.0 / pivot, load(wide, w, (best, 0)))
        if (best != top + k) != (pivot < 0.0):
            sign = -sign
        store(w, (best, 0), load(wide, w, (top + k, 0)))
        for i in range(n):
            factor = -w[top + i, at + k]
            store(w, (top + i, 0), plus(load(wide, w, (top + i, 0)), factor, row))
        store(w, (top + k, 0), row)
    for r in range(top, at):
        if not abs(w[r, r]) < SAFE:
            return 0.0
    return sign


@part
def _clear(w: Any, top: int, at_one: Any, signs: Any) -> None:
    """Subtract n solved rows of w from all others: zeros in their block of columns."""
    n, m = len(signs), len(at_one) - 1
    at, wide = top + n, zeros(signs, at_one)
    for i in range(m * n):
        if i < top or i >= at:
            row = load(wide, w, (i, 0))
            if top == 0:  # what couples the first stage to another is a multiple of the unit matrix
                row = plus(row, -w[i, n + i % n], load(wide, w, (i % n, 0)))
            else:
                for q in range(n):
                    row = plus(row, -w[i, at + q], load(wide, w, (top + q, 0)))
            store(w, (i, 0), row)


@part
def _invert_at_large(w: Any, n: int) -> float:
    """As ``_invert``, with row pivoting over all stages; 0 where the matrix is singular."""
    size = w.shape[1] - n
    matrix, inverse = np.empty((size, size)), unit_matrix(size)
    for i in range(size):
        for s in range(size):
            matrix[i, s] = w[i, n + s]
    sign = np.sign(gauss_elimination(matrix, inverse))
    for i in range(size):
        if not abs(inverse[i, i]) < SINGULAR:
            return 0.0
        for s in range(size):
            w[i, s] = inverse[i, s]
    return sign


@part
def _respond(
    w: Any, J: Any, f: Any, extra: Any, j: int, h: float, kappa: float, period: float, slopes: Any,
    at_one: Any, signs: Any,
) -> None:  # fmt: skip
    """The rows of w for x_j and the scalars, from the inverse in it."""
    n, m = len(signs), len(at_one) - 1
    free, first, wide = J.shape[3] - n, m * n, zeros(signs, at_one)
    for s in range(n):
        row = wide
        for i in range(m):
            row = plus(row, -slopes[i, 0], load(wide, w, (i * n + s, 0)))
        store(w, (first + s, 0), row)
    for c in range(w.shape[0] - first - n):
        row = wide
        for i in range(m):
            for r in range(n):
                if c == 0:
                    g = kappa * f[j, i, r]
                elif c <= free:
                    g = kappa * period * J[j, i, r, n + c - 1]
                else:
                    g = extra[j, i, r, c - 1 - free]
                row = plus(row, h * g, load(wide, w, (i * n + r, 0)))
        store(w, (first + n + c, 0), row)


@part
def _step_over(w: Any, at_one: Any, signs: Any, unit: Any) -> None:
    """x_{j+1} in every row of w, from the stages there."""
    n, m = len(signs), len(at_one) - 1
    narrow = zeros(signs, (0,))
    for row in range(w.shape[0]):
        last = narrow
        if m * n <= row < m * n + n:
            last = times(at_one[0], load(narrow, unit, (row - m * n, 0)))
        for i in range(m):
            last = plus(last, at_one[i + 1], load(narrow, w, (row, i * n)))
        store(w, (row, m * n), last)
