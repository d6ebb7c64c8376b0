"""Meshes of collocation: equidistribution of the error, and moving an orbit to another mesh.

De Boor's method as in COLSYS and AUTO: the derivative of order m + 1 is estimated from the jumps of
the m-th, which is constant on each interval; the mesh is chosen so that every interval has the same
share of its (m + 1)-th root.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

from wheelset.bifurcation.cycles.collocation import Collocation, Orbit
from wheelset.bifurcation.cycles.vectors import entry, load, part, plus, store, zeros

Array = NDArray[np.float64]

#: Part of the mean density that every interval has at least: no interval grows without bound.
FLOOR = 0.1

#: Instead of the mean density of a function without any.
TINY = float(np.finfo(float).tiny)


def equidistributed(space: Collocation, orbit: Orbit, intervals: int | None = None) -> Array:
    """Interval lengths (intervals,) that give each the same share of the error."""
    count = len(space.h) if intervals is None else intervals
    highest = space.rule.highest
    return np.asarray(
        _equidistributed(orbit.nodes, space.h, highest, space.signs, space.scales, count)
    )


@njit(cache=True, error_model="numpy")
def _equidistributed(
    nodes: Array, h: Array, weights: Array, signs: Array, scales: Array, count: int
) -> Array:
    """Lengths (count,), each with the same integral of the density, which is the derivative of
    order m + 1 to the power 1/(m + 1), no less than ``FLOOR`` of its mean.

    weights (m + 1,): of the values, for the m-th derivative on an interval of length one.
    """
    density, total = _density(nodes, h, weights, signs, scales)
    out, place = np.empty(count), 0.0
    j, left = 0, density[0] * h[0]  # what is left of interval j
    for i in range(count):
        wanted, begin = total / count, place
        while wanted > left and j + 1 < h.shape[0]:
            wanted, place = wanted - left, place + left / density[j]
            j += 1
            left = density[j] * h[j]
        place += wanted / density[j]
        left -= wanted
        out[i] = place - begin
    for i in range(count):
        out[i] /= place
    return out


@njit(cache=True, error_model="numpy")
def _density(
    nodes: Array, h: Array, weights: Array, signs: Array, scales: Array
) -> tuple[Array, float]:
    """The density on each interval (N,), and its integral."""
    density, mean, total = _derivative(nodes, h, weights, signs, scales), 0.0, 0.0
    for j in range(h.shape[0]):
        density[j] **= 1.0 / nodes.shape[1]
        mean += density[j] * h[j]
    for j in range(h.shape[0]):
        density[j] += FLOOR * max(mean, TINY)
        total += density[j] * h[j]
    return density, total


@njit(cache=True, error_model="numpy")
def _derivative(nodes: Array, h: Array, weights: Array, signs: Array, scales: Array) -> Array:
    """Scaled norm of the derivative of order m + 1 on each interval, (N,): from the jumps of the
    m-th at both ends.
    """
    N, width, n = nodes.shape
    highest, density = np.zeros((N + 1, n)), np.zeros(N)
    for j in range(N):
        for r in range(n):
            for k in range(width):
                highest[j, r] += weights[k] * nodes[j, k, r]
            highest[j, r] /= h[j] ** (width - 1) * scales[r]
    for r in range(n):
        highest[N, r] = signs[r] * highest[0, r]
    for j in range(N):  # at the right end of interval j
        square, following = 0.0, (j + 1) % N
        for r in range(n):
            square += (highest[j + 1, r] - highest[j, r]) ** 2
        half = np.sqrt(square) / (h[j] + h[following])
        density[j] += half
        density[following] += half
    return density


def moved(old: Collocation, new: Collocation, v: Array) -> Array:
    """Vectors of unknowns (..., size), points or tangents, with their polynomials evaluated on
    another mesh.
    """
    rows, out = v.reshape(-1, old.size), np.empty((*v.shape[:-1], new.size))
    _resampled(rows, old.mesh, new.mesh, old.rule.nodes, old.sign_tuple, out.reshape(-1, new.size))
    return out


def carried(old: Collocation, new: Collocation, stages: Array) -> Array:
    """A function given at the stages alone (N, m, n), on another mesh; for borders, which need not
    be exact: polynomials of degree m - 1 on each interval.
    """
    N, m, n = old.shape
    nodes, out = np.empty((N, m + 1, n)), np.empty((len(new.h), m + 1, n))
    nodes[:, 1:], nodes[:, 0] = stages, old.rule.at_zero @ stages
    _resampled(
        nodes.reshape(1, -1), old.mesh, new.mesh, old.rule.nodes, old.sign_tuple,
        out.reshape(1, -1),
    )  # fmt: skip
    return out[:, 1:].copy()


@entry
def _resampled(rows: Any, mesh: Any, finer: Any, c: Any, signs: Any, out: Any) -> None:
    """Rows of nodes (N, m + 1, n) and whatever follows them, with the nodes at the left end and the
    Gauss points of every interval of another mesh, to ``out``. c (m + 1,): 0 and the Gauss points.
    """
    N, k, n, count = mesh.shape[0] - 1, c.shape[0], len(signs), finer.shape[0] - 1
    basis, j = np.empty(k), 0
    for i in range(count):
        for q in range(k):
            at = finer[i] + c[q] * (finer[i + 1] - finer[i])
            while j + 1 < N and mesh[j + 1] <= at:
                j += 1
            _fill_basis((at - mesh[j]) / (mesh[j + 1] - mesh[j]), c, basis)
            for row in range(rows.shape[0]):
                value = zeros(signs, (0,))
                for e in range(k):
                    value = plus(value, basis[e], load(value, rows, (row, (j * k + e) * n)))
                store(out, (row, (i * k + q) * n), value)
    for row in range(rows.shape[0]):
        for i in range(rows.shape[1] - N * k * n):
            out[row, count * k * n + i] = rows[row, N * k * n + i]


@part
def _fill_basis(s: float, c: Any, basis: Any) -> None:
    """Lagrange basis (m + 1,) on c at s."""
    for e in range(c.shape[0]):
        above, below = 1.0, 1.0
        for o in range(c.shape[0]):
            if o != e:
                above, below = above * (s - c[o]), below * (c[e] - c[o])
        basis[e] = above / below
