"""The transposed condensed linear problem: what every right-hand side does to the scalars.

The steps of ``condensed.solve`` are taken backwards, each transposed, through the same factors.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from wheelset.bifurcation.cycles.bordering import closing, reduce_row
from wheelset.bifurcation.cycles.dense import gauss_elimination
from wheelset.bifurcation.cycles.vectors import dot, entry, load, part, plus, store, zeros


@entry
def transposed(
    factors: Any, at_one: Any, signs: Any, h: Any, columns: Any, rows: Any, D: Any, t: Any,
    psi: Any, eta: Any,
) -> float:  # fmt: skip
    """psi (N, m n) and eta (k) with t . c = sum_j psi_j . g_j + eta . e for every forcing g of
    X' = A X + G c + g and every right-hand side e of the k border rows (rows flat, D (k, k)).

    Returns the determinant up to a positive factor, 0 where singular.
    """
    N, n, size = factors[2].shape[0], len(signs), (len(at_one) - 1) * len(signs)
    k = columns.shape[0]
    carried, delta, y = np.empty((k, 2 * n)), D.copy(), np.empty((k, N, n))
    nobody, none, x = np.empty((0, 0)), np.empty(0), np.zeros((n + k, 1))
    for b in range(k):
        reduce_row(
            factors, at_one, signs, columns, rows, b * N * size, size, nobody, delta[b],
            carried[b], y[b], none,
        )  # fmt: skip
        x[n + b, 0] = t[b]
    B, scale = closing(factors, columns, signs, carried, delta)
    determinant = gauss_elimination(B.T.copy(), x)
    for i in range(n + k):
        x[i, 0] *= scale[i]
        if i >= n:
            eta[i - n] = x[i, 0]
    _return(factors, at_one, signs, h, rows, x, y, psi)
    return determinant


@part
def _return(
    factors: Any, at_one: Any, signs: Any, h: Any, rows: Any, x: Any, y: Any, psi: Any
) -> None:
    """psi from the multipliers x (n + k, 1) of the last equations and the border rows."""
    responses, links, _ = factors
    N, n, size = links.shape[0], len(signs), (len(at_one) - 1) * len(signs)
    wide, inner = zeros(signs, at_one), zeros(signs, at_one[1:])
    narrow, pair = zeros(signs, (0,)), zeros(signs, (0, 0))
    r, bar = np.empty(2 * n), np.empty(size + n)  # of [r, r_j] and [X_j1 .. X_jm | x_{j+1}]
    for i in range(n):
        r[i] = x[i, 0]
    for j in range(N - 1, -1, -1):
        if j > 0:
            both = pair
            for i in range(n):
                share = 0.0
                for b in range(y.shape[0]):
                    share -= x[n + b, 0] * y[b, j, i]
                both = plus(both, share, load(pair, links, (j, i, 0)))
                both = plus(both, r[i], load(pair, links, (j, n + i, 0)))
            store(r, (0,), both)
        else:
            store(r, (n,), load(narrow, r, (0,)))
        store(bar, (size,), load(narrow, r, (n,)))
        weight = inner
        for b in range(y.shape[0]):
            weight = plus(weight, -x[n + b, 0], load(inner, rows, ((b * N + j) * size,)))
        store(bar, (0,), weight)
        full = load(wide, bar, (0,))
        for i in range(size):
            psi[j, i] = h[j] * dot(full, load(wide, responses, (j, i, 0)))
