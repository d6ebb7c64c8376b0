"""The vector work of a walk in the scaled inner product <a, b> = sum(metric a b), compiled.

All vectors are (N,). Sums are taken in any order, the same at every call.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

Array = NDArray[np.float64]

_OPTIONS: dict[str, Any] = {
    "cache": True, "error_model": "numpy", "fastmath": {"contract", "nsz", "reassoc"},
    "no_cfunc_wrapper": True,
}  # fmt: skip

_compiled: Any = njit(**_OPTIONS)


@_compiled
def distance(a: Array, b: Array, metric: Array) -> float:
    """Length of a - b."""
    square = 0.0
    for i in range(metric.shape[0]):
        square += metric[i] * (a[i] - b[i]) ** 2
    return math.sqrt(square)


@_compiled
def corrected_by(
    u: Array, correction: Array, direction: Array, metric: Array
) -> tuple[Array, Array, float, float]:
    """u - correction, the unit vector along a direction, the lengths of u and the correction."""
    better, unit = np.empty(u.shape[0]), np.empty(u.shape[0])
    size, step, length = 0.0, 0.0, 0.0
    for i in range(u.shape[0]):
        size += metric[i] * u[i] * u[i]
        step += metric[i] * correction[i] * correction[i]
        length += metric[i] * direction[i] * direction[i]
    size, step, length = math.sqrt(size), math.sqrt(step), math.sqrt(length)
    for i in range(u.shape[0]):
        better[i] = u[i] - correction[i]
        unit[i] = direction[i] / length
    return better, unit, size, step


@_compiled
def hermite(
    start: Array, start_tangent: Array, end: Array, end_tangent: Array, metric: Array
) -> tuple[Array, float, float]:
    """[start, end, start tangent, end tangent] (4, N), and the lengths of the chord and of the
    difference of the tangents.
    """
    data = np.empty((4, metric.shape[0]))
    chord, turn = 0.0, 0.0
    for i in range(metric.shape[0]):
        data[0, i], data[1, i] = start[i], end[i]
        data[2, i], data[3, i] = start_tangent[i], end_tangent[i]
        chord += metric[i] * (end[i] - start[i]) ** 2
        turn += metric[i] * (end_tangent[i] - start_tangent[i]) ** 2
    return data, math.sqrt(chord), math.sqrt(turn)


@_compiled
def on_cubic(data: Array, length: float, s: float) -> tuple[Array, Array]:
    """Point and derivative, by arclength, of the cubic through ``hermite``'s data at s."""
    t, one = s / length, s / length - 1.0
    a, b = (1 + 2 * t) * one * one, t * t * (3 - 2 * t)
    c, d = length * t * one * one, length * t * t * one
    slope, e, f = 6 * t * one / length, one * (3 * t - 1), t * (3 * t - 2)
    place, direction = np.empty(data.shape[1]), np.empty(data.shape[1])
    for i in range(data.shape[1]):
        place[i] = a * data[0, i] + b * data[1, i] + c * data[2, i] + d * data[3, i]
        direction[i] = slope * (data[0, i] - data[1, i]) + e * data[2, i] + f * data[3, i]
    return place, direction
