"""Linear boundary-value problems of collocation, condensed interval by interval.

Every linear system of a cycle has this shape (a Newton step, a Floquet mode, a normal form):

    unknowns   mesh values x_0 .. x_N (n each), stages X_j1 .. X_jm (n each), scalars c (k)
    stages     sum_l b_il (X_jl - x_j) - h_j (A_ji X_ji + g_ji c)  = rho_ji    (b = a^-1)
    mesh       x_{j+1} - end x_j - sum_i d_i X_ji                  = jump_j
    boundary   x_N - S x_0                                         = gap       (S: signs)
    rows       sum_j weight_j . X_j + D c                          = e         (k of them)

``elimination`` solves the stages and ``reduction`` removes x_1 .. x_{N-1}; their arrays (responses,
links, forced) are the factors. ``solve`` takes border rows and right-hand sides through them.
Work and memory are linear in N; nothing larger than one interval is ever factored. The layouts are

    u        [ x_0, X_01 .. X_0m | x_1, ... | .. X_{N-1,m} | x_N | c ]
    right    [ rho_0 .. rho_{N-1} (m n each) | jump_0 .. jump_{N-1} (n each) | gap | e ]

so that a row of the responses, [X_j1 .. X_jm | x_{j+1}], lies in u as it is. There are r
right-hand sides, each with its own u; those beyond the rows of ``right`` are zero but for e.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from wheelset.bifurcation.cycles.bordering import closing, reduce_row
from wheelset.bifurcation.cycles.dense import gauss_elimination
from wheelset.bifurcation.cycles.vectors import dot, entry, load, part, plus, store, zeros


@entry
def solve(
    factors: Any, at_one: Any, signs: Any, columns: Any, rows: Any, D: Any, row: Any, right: Any,
    e: Any, u: Any,
) -> float:  # fmt: skip
    """Solve for u (r, unknowns), with the scalars in ``columns`` (k) and k border rows.

    rows: k or k - 1 of them, flat; D (as many, k). In the second case the last one is ``row``, laid
    out as u, with no entries for mesh values. right (up to r, ...); e (r, k): of the border rows,
    added to what right says of them.
    Returns the determinant up to a positive factor, 0 where singular.
    """
    N, n, size = factors[2].shape[0], len(signs), (len(at_one) - 1) * len(signs)
    k, sides, last = columns.shape[0], u.shape[0], N * (size + n)
    carried, delta, y = np.empty((k, 2 * n)), np.empty((k, k)), np.empty((N, n))
    rest, products = np.empty((n + k, sides)), np.zeros((k, right.shape[0]))
    for i in range(sides):
        if i < right.shape[0]:
            _condense(factors, at_one, signs, right, u, i)
        else:
            for s in range(last):
                u[i, s] = 0.0
    for b in range(k):
        given = b < D.shape[0]
        for s in range(k):
            delta[b, s] = D[b, s] if given else row[last + n + s]
        weights, start, stride = (rows, b * N * size, size) if given else (row, n, size + n)
        reduce_row(
            factors, at_one, signs, columns, weights, start, stride, u, delta[b], carried[b], y,
            products[b],
        )  # fmt: skip
        for i in range(sides):
            rest[n + b, i] = e[i, b] - (products[b, i] if i < right.shape[0] else 0.0)
            if i < right.shape[0] and last + n + b < right.shape[1]:
                rest[n + b, i] += right[i, last + n + b]
    determinant = _close(factors, signs, columns, carried, delta, right, rest, u)
    _expand(factors, at_one, signs, columns, u)
    return determinant


@part
def _condense(factors: Any, at_one: Any, signs: Any, right: Any, u: Any, side: int) -> None:
    """A right-hand side through the factors: its shares of stages and mesh values, to u; in the
    place of x_0 what is left of it in the last equations.
    """
    responses, links, _ = factors
    N, n, size = links.shape[0], len(signs), (len(at_one) - 1) * len(signs)
    wide, narrow, pair = zeros(signs, at_one), zeros(signs, (0,)), zeros(signs, (0, 0))
    r = np.empty(2 * n)  # [r, r_j] of ``reduction``
    for j in range(N):
        at = j * (size + n)
        row = wide
        for i in range(size):
            row = plus(row, right[side, j * size + i], load(wide, responses, (j, i, 0)))
        store(u, (side, at + n), row)
        jump = load(narrow, right, (side, N * size + j * n))
        store(r, (n,), plus(load(narrow, u, (side, at + n + size)), 1.0, jump))
        if j == 0:
            store(r, (0,), load(narrow, r, (n,)))
        else:
            both = load(pair, r, (0,))
            for i in range(n):
                u[side, at + i] = dot(load(pair, links, (j, i, 0)), both)
                r[i] = dot(load(pair, links, (j, n + i, 0)), both)
    store(u, (side, 0), load(narrow, r, (0,)))


@part
def _close(
    factors: Any, signs: Any, columns: Any, carried: Any, delta: Any, right: Any, rest: Any, u: Any
) -> float:
    """Solve the last equations: x_0, x_N = S x_0 + gap and c, to u; rest[n:] (k, r): right-hand
    sides of the border rows. Returns the determinant.
    """
    n, k = len(signs), columns.shape[0]
    last = u.shape[1] - n - k
    B, scale = closing(factors, columns, signs, carried, delta)
    for i in range(n + k):
        for side in range(u.shape[0]):
            if i < n:
                rest[i, side] = u[side, i]
            if side < right.shape[0]:
                for s in range(n):
                    factor = factors[1][0, i, n + s] if i < n else carried[i - n, n + s]
                    rest[i, side] -= factor * right[side, last + s]
            rest[i, side] *= scale[i]
    determinant = gauss_elimination(B, rest)
    for side in range(u.shape[0]):
        for s in range(n):
            gap = right[side, last + s] if side < right.shape[0] else 0.0
            u[side, s], u[side, last + s] = rest[s, side], signs[s] * rest[s, side] + gap
        for s in range(k):
            u[side, last + n + s] = rest[n + s, side]
    return determinant


@part
def _expand(factors: Any, at_one: Any, signs: Any, columns: Any, u: Any) -> None:
    """Mesh values and stages from x_0, x_N and c, which are in u beside the right-hand sides'
    shares.
    """
    responses, links, forced = factors
    N, n, size = forced.shape[0], len(signs), (len(at_one) - 1) * len(signs)
    inner, narrow, c = zeros(signs, at_one[1:]), zeros(signs, (0,)), N * (size + n) + n
    for j in range(N - 1, -1, -1):
        at = j * (size + n)
        for side in range(u.shape[0]):
            if j > 0:
                first = load(narrow, u, (side, 0))
                following = load(narrow, u, (side, at + size + n))
                for i in range(n):
                    u[side, at + i] += dot(load(narrow, links, (j, 2 * n + i, 0)), first)
                    u[side, at + i] += dot(load(narrow, links, (j, 2 * n + i, n)), following)
                x = load(narrow, u, (side, at))
                for s in range(columns.shape[0]):
                    x = plus(x, u[side, c + s], load(narrow, forced, (j, columns[s], 0)))
                store(u, (side, at), x)
            X = load(inner, u, (side, at + n))
            for s in range(n):
                X = plus(X, u[side, at + s], load(inner, responses, (j, size + s, 0)))
            for s in range(columns.shape[0]):
                own = load(inner, responses, (j, size + n + columns[s], 0))
                X = plus(X, u[side, c + s], own)
            store(u, (side, at + n), X)
