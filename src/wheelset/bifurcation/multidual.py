"""Exact derivatives of any order along given directions, by nilpotent arithmetic on a tape.

A number carries 2^k coefficients, one for every subset of k nilpotent units e_1..e_k, e_i^2 = 0.
Evaluating f at ``x + e_1 v_1 + ... + e_k v_k`` leaves the multilinear form D^k f(x)[v_1, ..., v_k]
in the coefficient of e_1 e_2 ... e_k: no differences, no polarisation, no symbolic swell.
Directions may be complex (eigenvectors), and may point along parameters as well as the state.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

Array = NDArray[Any]


@njit(cache=True, error_model="numpy")
def _multiply(a: Array, b: Array, out: Array) -> None:
    """out = a b: the coefficient of a subset is the sum over its splittings in two."""
    for whole in range(out.size):
        total = a[0] * b[whole]
        part = whole
        while part > 0:
            total += a[part] * b[whole ^ part]
            part = (part - 1) & whole
        out[whole] = total


@njit(cache=True, error_model="numpy")
def _compose(taylor: Array, a: Array, order: int, work: Array, out: Array) -> None:
    """out = sum_j taylor[j] (a - a[0])^j, j = 0..order, by Horner's rule."""
    nilpotent = work[0]
    nilpotent[:] = a
    nilpotent[0] = 0.0
    out[:] = 0.0
    out[0] = taylor[order]
    for j in range(order - 1, -1, -1):
        _multiply(out, nilpotent, work[1])
        out[:] = work[1]
        out[0] += taylor[j]


@njit(cache=True, error_model="numpy")
def _taylor(kind: int, a: Any, k: float, order: int, out: Array) -> None:
    """Taylor coefficients at ``a`` of a^k (5), exp (6), log (7), sin (8), cos (9)."""
    if kind == 5:
        out[0] = a**k
        for j in range(1, order + 1):
            out[j] = out[j - 1] * (k - j + 1) / (j * a)
    elif kind == 6:
        out[0] = np.exp(a)
        for j in range(1, order + 1):
            out[j] = out[j - 1] / j
    elif kind == 7:
        out[0] = np.log(a)
        for j in range(1, order + 1):
            out[j] = 1.0 / a if j == 1 else -out[j - 1] * (j - 1) / (j * a)
    else:
        out[0], out[1] = (np.sin(a), np.cos(a)) if kind == 8 else (np.cos(a), -np.sin(a))
        for j in range(2, order + 1):
            out[j] = -out[j - 2] / (j * (j - 1))


@njit(cache=True, error_model="numpy")
def propagate(  # noqa: C901  (one branch an elementary operation)
    code: Array, constants: Array, base: Array, directions: Array, sampled: Array
) -> Array:
    """Every slot of a tape with all its 2^k coefficients.

    code (ops, 4), constants (ops,): the packed tape. base (n + m,): state and parameters.
    directions (k, n + m), real or complex. sampled (functions, k + 1): Taylor coefficients.
    Returns (n + m + ops, 2^k), of the type of ``directions``.
    """
    order, inputs = directions.shape
    size = 1 << order
    slots = np.zeros((inputs + code.shape[0], size), dtype=directions.dtype)
    still = np.ones(slots.shape[0], dtype=np.bool_)  # no dependence on any direction
    work = np.zeros((2, size), dtype=directions.dtype)
    taylor = np.zeros(max(order, 1) + 1, dtype=directions.dtype)
    for i in range(inputs):
        slots[i, 0] = base[i]
        for j in range(order):
            slots[i, 1 << j] = directions[j, i]
            still[i] = still[i] and directions[j, i] == 0.0
    for i in range(code.shape[0]):
        kind, a, b, c = code[i]
        k, here = constants[i], inputs + i
        if kind == 11:
            a = b if slots[a, 0].real > 0.0 else c
        still[here] = kind == 0 or (still[a] and (kind > 2 or still[b]))
        count = 1 if still[here] else size
        if kind == 0:
            slots[here, 0] = k
        elif kind == 1:
            for part in range(count):
                slots[here, part] = slots[a, part] + slots[b, part]
        elif kind == 2 and not (still[a] or still[b]):
            _multiply(slots[a], slots[b], slots[here])
        elif kind == 2:
            number, varying = (a, b) if still[a] else (b, a)
            for part in range(count):
                slots[here, part] = slots[number, 0] * slots[varying, part]
        elif kind == 3 or kind == 4 or kind == 11:
            factor = k if kind == 4 else 1.0
            for part in range(count):
                slots[here, part] = factor * slots[a, part]
            slots[here, 0] += k if kind == 3 else 0.0
        else:
            reach = 0 if still[a] else order
            if kind == 10:
                taylor[: reach + 1] = sampled[b, : reach + 1]
            else:
                _taylor(kind, slots[a, 0], k, reach, taylor)
            _compose(taylor, slots[a], reach, work, slots[here])
    return slots
