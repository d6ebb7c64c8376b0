"""Elimination of the mesh values x_1 .. x_{N-1} by orthogonal transformations.

Interval by interval G x_0 + E x_j = C c + r is joined with x_{j+1} - Phi_j x_j = Gamma_j c + r_j,

    [ E    ]        [ G ]        [ 0 ]              [ C       ]     [ r   ]
    [ -Phi ] x_j  + [ 0 ] x_0  + [ I ] x_{j+1}   =  [ Gamma_j ] c + [ r_j ],

and Q R = [E; -Phi] (Householder) solves the first n rows for x_j; the others are the next G, E, C,
r. This is stable whether modes grow or decay, as elimination with row exchanges is not (Wright,
SIAM J. Sci. Stat. Comput. 13 (1992) 742-764, 14 (1993) 231-238). By interval j = 1 .. N-1:

    links (N, 3 n, 2 n)      [R^-1 Q1^T; Q2^T]: takes [r; r_j] to its share of x_j, to the next r
                             [L, U]: x_j = L x_0 + U x_{j+1} + K c + its share of r
    forced (N, q, n)         K, one row a scalar
    links[0, :n], forced[0]  [G, E] and C of the last equations, G x_0 + E x_N = C c + r
"""

from __future__ import annotations

from typing import Any

import numpy as np

from wheelset.bifurcation.cycles.dense import unit_matrix
from wheelset.bifurcation.cycles.vectors import dot, load, part, plus, store, times, zeros


@part
def reduce(responses: Any, at_one: Any, signs: Any, links: Any, forced: Any) -> float:
    """Fill links and forced from ``elimination.eliminate``'s responses.

    Returns the sign of the determinant of what is eliminated, 0 where it is singular.
    """
    n, first = len(signs), (len(at_one) - 1) * len(signs)
    count, unit, narrow = forced.shape[1], unit_matrix(n), zeros(signs, (0,))
    B, G, C = np.empty((2 * n, 3 * n)), np.empty((n, n)), np.empty((count, 2 * n))
    sign = 1.0
    for r in range(n):
        store(B, (n + r, 2 * n), load(narrow, unit, (r, 0)))
        for s in range(n):
            G[r, s] = -responses[0, first + s, first + r]
    for c in range(count):
        store(C, (c, 0), load(narrow, responses, (0, first + n + c, first)))
    for j in range(1, forced.shape[0]):
        _stack(B, responses, j, first, signs, unit)
        sign *= _triangularise(B, signs)
        _link(B, G, links, j, signs)
        _force(B, C, responses, forced, j, first, signs)
    for r in range(n):
        store(links, (0, r, 0), load(narrow, G, (r, 0)))
        store(links, (0, r, n), load(narrow, B, (n + r, 2 * n)))
    for c in range(count):
        store(forced, (0, c, 0), load(narrow, C, (c, 0)))
    return sign


@part
def _stack(B: Any, responses: Any, j: int, first: int, signs: Any, unit: Any) -> None:
    """B (2 n, 3 n) = [E; -Phi_j] and the unit matrix; E is found below right in the last B."""
    n, narrow = len(signs), zeros(signs, (0,))
    for r in range(n):
        own = load(narrow, unit, (r, 0))
        store(B, (r, 0), load(narrow, B, (n + r, 2 * n)))
        store(B, (r, n), own)
        store(B, (r, 2 * n), narrow)
        store(B, (n + r, n), narrow)
        store(B, (n + r, 2 * n), own)
        for s in range(n):
            B[n + r, s] = -responses[j, first + s, first + r]


@part
def _triangularise(B: Any, signs: Any) -> float:
    """Householder reflections of B that make its first n columns upper triangular, R; then its
    first n rows are divided by R.

    Returns the sign of prod R_kk, 0 where a column vanishes.
    """
    n, v = len(signs), np.empty(2 * len(signs))
    pair, triple = zeros(signs, (0, 0)), zeros(signs, (0, 0, 0))
    sign = 1.0
    for k in range(n):
        square = 0.0
        for i in range(k, 2 * n):
            v[i] = B[i, k]
            square += v[i] * v[i]
        if not square > 0.0:
            return 0.0
        top = -np.sqrt(square) if v[k] > 0.0 else np.sqrt(square)
        sign = sign if top > 0.0 else -sign
        v[k] -= top
        total = triple
        for i in range(k, 2 * n):
            total = plus(total, v[i], load(triple, B, (i, 0)))
        total = times(1.0 / (top * v[k]), total)  # v . v = -2 top v_k
        for i in range(k, 2 * n):
            store(B, (i, 0), plus(load(triple, B, (i, 0)), v[i], total))
    for k in range(n - 1, -1, -1):
        row = load(pair, B, (k, n))
        for s in range(k + 1, n):
            row = plus(row, -B[k, s], load(pair, B, (s, n)))
        store(B, (k, n), times(1.0 / B[k, k], row))
    return sign


@part
def _link(B: Any, G: Any, links: Any, j: int, signs: Any) -> None:
    """links[j] from the reduced B, whose first block below is overwritten; G becomes the next."""
    n = len(signs)
    narrow, pair = zeros(signs, (0,)), zeros(signs, (0, 0))
    for r in range(n):
        L, following = narrow, narrow
        for s in range(n):
            L = plus(L, -B[r, n + s], load(narrow, G, (s, 0)))
            following = plus(following, B[n + r, n + s], load(narrow, G, (s, 0)))
        store(links, (j, r, 0), load(pair, B, (r, n)))
        store(links, (j, n + r, 0), load(pair, B, (n + r, n)))
        store(links, (j, 2 * n + r, 0), L)
        store(links, (j, 2 * n + r, n), times(-1.0, load(narrow, B, (r, 2 * n))))
        store(B, (n + r, 0), following)
    for r in range(n):
        store(G, (r, 0), load(narrow, B, (n + r, 0)))


@part
def _force(B: Any, C: Any, responses: Any, forced: Any, j: int, first: int, signs: Any) -> None:
    """forced[j] from the reduced B and C (q, 2 n) = [C, Gamma_j], one row a scalar; C becomes the
    next.
    """
    n = len(signs)
    narrow, pair = zeros(signs, (0,)), zeros(signs, (0, 0))
    for c in range(forced.shape[1]):
        store(C, (c, n), load(narrow, responses, (j, first + n + c, first)))
        both = load(pair, C, (c, 0))
        for r in range(n):
            forced[j, c, r] = dot(load(pair, B, (r, n)), both)
            C[c, r] = dot(load(pair, B, (n + r, n)), both)
