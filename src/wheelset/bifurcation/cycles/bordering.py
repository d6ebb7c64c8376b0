"""Border rows of a condensed linear problem, and the last equations, for x_0 and the scalars."""

from __future__ import annotations

from typing import Any

import numpy as np

from wheelset.bifurcation.cycles.vectors import dot, load, part, plus, store, zeros


@part
def reduce_row(
    factors: Any, at_one: Any, signs: Any, columns: Any, weights: Any, start: int, stride: int,
    u: Any, delta: Any, carried: Any, y: Any, products: Any,
) -> None:  # fmt: skip
    """A row sum_j weight_j . X_j through the factors: carried (2 n) on [x_0, x_N], delta (k), added
    to, on the scalars, y (N, n) on what is eliminated: the place of x_j in the rows of u.

    weight_j begins at weights[start + j stride]. products (r): of the row with r rows of u, one
    for each right-hand side, added to.
    """
    responses, links, forced = factors
    N, n, size = forced.shape[0], len(signs), (len(at_one) - 1) * len(signs)
    inner, narrow, pair = zeros(signs, at_one[1:]), zeros(signs, (0,)), zeros(signs, (0, 0))
    for j in range(N):
        at = j * (size + n)
        weight = load(inner, weights, (start + j * stride,))
        for i in range(products.shape[0]):
            products[i] += dot(weight, load(inner, u, (i, at + n)))
        for s in range(n):
            y[j, s] = dot(weight, load(inner, responses, (j, size + s, 0)))
        for s in range(columns.shape[0]):
            delta[s] += dot(weight, load(inner, responses, (j, size + n + columns[s], 0)))
        own = load(narrow, y, (j, 0))
        if j == 0:
            store(carried, (0,), own)
            store(carried, (n,), narrow)
        else:
            own = plus(own, 1.0, load(narrow, carried, (n,)))
            store(y, (j, 0), own)
            for i in range(products.shape[0]):
                products[i] += dot(own, load(narrow, u, (i, at)))
            for s in range(columns.shape[0]):
                delta[s] += dot(own, load(narrow, forced, (j, columns[s], 0)))
            store(carried, (n,), narrow)
            both = load(pair, carried, (0,))
            for i in range(n):
                both = plus(both, y[j, i], load(pair, links, (j, 2 * n + i, 0)))
            store(carried, (0,), both)


@part
def closing(factors: Any, columns: Any, signs: Any, carried: Any, delta: Any) -> tuple[Any, Any]:
    """The matrix (n + k, n + k) of the last equations for [x_0, c], where x_N = S x_0 + gap, with
    its rows scaled to length one; and these scales (n + k).
    """
    _, links, forced = factors
    n, k = len(signs), columns.shape[0]
    B, scale = np.empty((n + k, n + k)), np.empty(n + k)
    for i in range(n + k):
        square = 0.0
        for s in range(n):
            first = links[0, i, s] if i < n else carried[i - n, s]
            last = links[0, i, n + s] if i < n else carried[i - n, n + s]
            B[i, s] = first + last * signs[s]
        for s in range(k):
            B[i, n + s] = -forced[0, columns[s], i] if i < n else delta[i - n, s]
        for s in range(n + k):
            square += B[i, s] * B[i, s]
        scale[i] = 1.0 / np.sqrt(square) if square > 0.0 else 1.0
        for s in range(n + k):
            B[i, s] *= scale[i]
    return B, scale
