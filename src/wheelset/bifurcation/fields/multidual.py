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
    term = np.exp(x) if kind == 6 else np.log(x) if kind == 7 else 1 / x if k == -1.0 else x**k
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
def _propagate(  # noqa: C901  (one branch an elementary operation)
    code: Array,
    constants: Array,
    slots: Array,
    sampled: Array,
    still: Array,
    known: Array,
    taylor: Array,
) -> None:
    """Fill the slots of a tape's operations, each with all its 2^k coefficients.

    code (ops, 4), constants (ops,): the packed tape. slots (n + m + ops, 2^k): state and
    parameters are there. sampled (functions, k + 1): Taylor coefficients. still (slots,): whether
    a slot depends on no direction; the inputs' are there. known (ops,): already filled.
    taylor (k + 1,): work.
    """
    size = slots.shape[1]
    inputs, order = slots.shape[0] - code.shape[0], sampled.shape[1] - 1
    for i in range(code.shape[0]):
        if known[i]:
            continue
        kind, a, b, c = code[i, 0], code[i, 1], code[i, 2], code[i, 3]
        k, here = constants[i], inputs + i
        if kind == 11:
            a = b if slots[a, 0].real > 0.0 else c
        still[here] = kind == 0 or (still[a] and (kind > 2 or still[b]))
        count = 1 if still[here] else size
        for part in range(count, size):
            slots[here, part] = 0.0
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
                for j in range(reach + 1):
                    taylor[j] = sampled[b, j]
            else:
                _taylor(kind, slots[a, 0].real, k, reach, taylor)
            _compose(slots, taylor, a, reach, here)


@njit(cache=True, error_model="numpy")
def over_points(
    packed: tuple[Array, Array],
    fixed: Array,
    points: Array,
    p: Array,
    directions: Array,
    sampled: Array,
    bounds: tuple[Array, Array],
    outputs: Array,
    work: tuple[Array, Array, Array],
    slots: Array,
    out: Array,
) -> int:
    """D^k f(x, p)[v_1, ..., v_k] at every point; the number of points done.

    packed: code (ops, 4) and constants (ops,) of a tape; fixed (ops,): operations of parameters
    alone. points (points, n), p (points, m) or one row for all, (1, m), directions
    (points, k, n or n + m), real or complex, sampled (points, functions, k + 1). bounds: slots and
    what they have to exceed.
    work: still, all true, known, all false, and taylor of ``_propagate``. slots
    (n + m + ops, 2^k), zero. out (points, n): written, from the slots ``outputs``.
    A point outside a bound or not finite ends it, and its coefficients stay in ``slots``.
    """
    (code, constants), (still, known, taylor) = packed, work
    n, (order, width) = points.shape[1], directions.shape[1:]
    each = p.shape[0] - 1  # 0 where all points share their parameters
    for i in range(points.shape[0]):
        for j in range(p.shape[1]):
            slots[n + j, 0] = p[min(i, each), j]
        for j in range(n):
            slots[j, 0] = points[i, j]
        for j in range(width):
            still[j] = True
            for d in range(order):
                slots[j, 1 << d] = directions[i, d, j]
                still[j] = still[j] and directions[i, d, j] == 0.0
        _propagate(code, constants, slots, sampled[i], still, known, taylor)
        if not _accepted(slots, bounds, outputs):
            return i
        for row in range(n):
            out[i, row] = slots[outputs[row], slots.shape[1] - 1]
        if i == 0 and width == n and each == 0:
            for j in range(len(fixed)):
                known[j] = fixed[j]
    return points.shape[0]


@njit(cache=True, error_model="numpy")
def _accepted(slots: Array, bounds: tuple[Array, Array], outputs: Array) -> bool:
    """Whether all bounds are kept and all coefficients of the outputs are finite."""
    for i in range(len(bounds[0])):
        if not slots[bounds[0][i], 0].real > bounds[1][i]:
            return False
    total = slots[0, 0]
    for row in range(len(outputs)):
        for part in range(slots.shape[1]):
            total += slots[outputs[row], part]
    return bool(abs(total) < np.inf)
