"""Meshes of collocation: equidistribution of the error, and moving an orbit to another mesh.

De Boor's method as in COLSYS and AUTO: the derivative of order m + 1 is estimated from the jumps of
the m-th, which is constant on each interval; the mesh is chosen so that every interval has the same
share of its (m + 1)-th root.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

from wheelset.bifurcation.cycles.collocation import Collocation, Orbit

Array = NDArray[np.float64]

#: Part of the mean density that every interval has at least: no interval grows without bound.
FLOOR = 0.1


def derivative(space: Collocation, orbit: Orbit) -> Array:
    """Scaled norm of the derivative of order m + 1 on each interval, (N,)."""
    weights = space.rule.leading * math.factorial(space.rule.m)
    return _derivative(orbit.nodes, space.h, weights, space.signs, space.scales)


@njit(cache=True, error_model="numpy")
def _derivative(nodes: Array, h: Array, weights: Array, signs: Array, scales: Array) -> Array:
    """weights (m + 1,): of the values, for the m-th derivative on an interval of length one."""
    N, width, n = nodes.shape
    highest, jumps = np.zeros((N + 1, n)), np.empty(N)
    for j in range(N):
        for r in range(n):
            for k in range(width):
                highest[j, r] += weights[k] * nodes[j, k, r]
            highest[j, r] /= h[j] ** (width - 1) * scales[r]
    highest[N] = signs * highest[0]
    for j in range(N):  # at the right end of interval j
        jump = np.sqrt(((highest[j + 1] - highest[j]) ** 2).sum())
        jumps[j] = jump / (0.5 * (h[j] + h[(j + 1) % N]))
    density = np.empty(N)
    for j in range(N):
        density[j] = 0.5 * (jumps[j] + jumps[j - 1])
    return density


def equidistributed(space: Collocation, orbit: Orbit, intervals: int | None = None) -> Array:
    """Interval lengths (intervals,) that give each the same share of the error."""
    density = derivative(space, orbit) ** (1 / (space.rule.m + 1))
    density += FLOOR * max(float((density * space.h).sum()), np.finfo(float).tiny)
    share = np.concatenate([[0.0], np.cumsum(density * space.h)])
    count = len(space.h) if intervals is None else intervals
    targets = np.linspace(0, share[-1], count + 1)
    return np.diff(np.interp(targets, share, space.mesh))


def moved(old: Collocation, new: Collocation, v: Array) -> Array:
    """A vector of unknowns (point or tangent) with its polynomials evaluated on another mesh."""
    orbit = old.split(v)
    nodes = _resampled(orbit.nodes, old.mesh, new.mesh, old.rule.nodes)
    return np.concatenate([nodes.ravel(), orbit.last, [orbit.period], orbit.free])


def carried(old: Collocation, new: Collocation, stages: Array) -> Array:
    """A function given at the stages alone (N, m, n), on another mesh; for borders, which need not
    be exact: polynomials of degree m - 1 on each interval.
    """
    c, m = old.rule.c, old.rule.m
    at_zero = np.array(
        [np.prod(np.delete(-c, i)) / np.prod(c[i] - np.delete(c, i)) for i in range(m)]
    )
    left = np.einsum("i,jin->jn", at_zero, stages)
    nodes = np.concatenate([left[:, np.newaxis], stages], axis=1)
    moved_nodes = _resampled(nodes, old.mesh, new.mesh, old.rule.nodes)
    return np.ascontiguousarray(moved_nodes[:, 1:])


@njit(cache=True, error_model="numpy")
def _resampled(nodes: Array, mesh: Array, finer: Array, c: Array) -> Array:
    """Values at the left end and the Gauss points of every interval of another mesh."""
    N, k, n = nodes.shape
    count = finer.shape[0] - 1
    out = np.zeros((count, k, n))
    j = 0
    for i in range(count):
        for q in range(k):
            at = finer[i] + c[q] * (finer[i + 1] - finer[i])
            while j + 1 < N and mesh[j + 1] <= at:
                j += 1
            s = (at - mesh[j]) / (mesh[j + 1] - mesh[j])
            for e in range(k):
                weight = 1.0
                for o in range(k):
                    if o != e:
                        weight *= (s - c[o]) / (c[e] - c[o])
                for r in range(n):
                    out[i, q, r] += weight * nodes[j, e, r]
    return out
