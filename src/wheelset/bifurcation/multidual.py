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
def _multiply(slots: Array, a: int, b: int, out: int) -> None:
    """Slot out = a b: the coefficient of a subset is the sum over its splittings in two."""
    for whole in range(slots.shape[1]):
        total = slots[a, 0] * slots[b, whole]
        part = whole
        while part > 0:
            total += slots[a, part] * slots[b, whole ^ part]
            part = (part - 1) & whole
        slots[out, whole] = total


@njit(cache=True, error_model="numpy")
def _compose(slots: Array, taylor: Array, a: int, order: int, out: int) -> None:
    """Slot out = sum_j taylor[j] n^j, j = 0..order, n = slot a less its value, by Horner's rule.

    From the last subset to the first, so that the product by n (which has no coefficient of the
    empty set) needs no second array.
    """
    size = slots.shape[1]
    for part in range(size):
        slots[out, part] = 0.0
    slots[out, 0] = taylor[order]
    for j in range(order - 1, -1, -1):
        for whole in range(size - 1, 0, -1):
            total = slots[a, whole] * slots[out, 0]
            part = (whole - 1) & whole
            while part > 0:
                total += slots[a, part] * slots[out, whole ^ part]
                part = (part - 1) & whole
            slots[out, whole] = total
        slots[out, 0] = taylor[j]


@njit(cache=True, error_model="numpy")
def _taylor(kind: int, x: float, k: float, order: int, out: Array) -> None:
    """Taylor coefficients at a real x of x^k (5), exp (6), log (7), sin (8), cos (9).

    In real arithmetic: where one is infinite it says so, and does not raise.
    """
    if kind >= 8:
        value, slope = (np.sin(x), np.cos(x)) if kind == 8 else (np.cos(x), -np.sin(x))
        factor = 1.0
        for j in range(order + 1):
            out[j] = factor * value
            value, slope = slope, -value
            factor /= j + 1
        return
    term = x**k if kind == 5 else np.exp(x) if kind == 6 else np.log(x)
    out[0] = term
    for j in range(1, order + 1):
        if kind == 5:
            term *= (k - j + 1) / (j * x)
        elif kind == 6:
            term /= j
        else:
            term = 1 / x if j == 1 else -term * (j - 1) / (j * x)
        out[j] = term


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
            _multiply(slots, a, b, here)
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
                _taylor(kind, slots[a, 0].real, k, reach, taylor)
            _compose(slots, taylor, a, reach, here)
    return slots
