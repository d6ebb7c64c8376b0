"""All low points of the gap between a wheel and its rail, for many displacements at once."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from wheelset.profiles.curves import Array
from wheelset.profiles.gap import NOWHERE, Wheel

#: Spacing of the scan over a wheel, m, and of the scans that only bring the roll near.
SCAN, ROUGH = 2e-4, 1e-3

#: How far roll can bring a point of the wheel sideways, m; rows scanned together, to stay in cache.
ROLLED_ASIDE, BLOCK = 0.008, 64

#: A minimum less than this above the lowest one is followed: the second point of contact, m.
WINDOW = 2e-5

#: A gap at the end of a wheel that leaves room for what was not measured, m.
CLEAR = 1e-3

#: Where the position of a minimum is taken as found, m; and the most halvings spent on it.
FOUND, MOST = 1e-9, 40


@dataclass(frozen=True, eq=False)
class Minima:
    """Minima in rows of displacements: ``row`` [k] says to which y the place ``u`` [k] belongs.

    ends: rows whose lowest gap lies at the end of a profile. spacing: of the scan.
    """

    row: NDArray[np.intp]
    u: Array
    ends: NDArray[np.bool_]
    spacing: float


def scan(wheel: Wheel, y: Array, phi: Array, spacing: float = SCAN) -> Minima:
    """Every minimum within WINDOW of the lowest one, to a fraction of the spacing."""
    u = _opposite(wheel, y, spacing)
    z = wheel.curve(u)
    blocks = [slice(k, k + BLOCK) for k in range(0, len(y), BLOCK)]
    tables = (wheel.table_of_gaps(u, z, y[rows], phi[rows]) for rows in blocks)
    found = [_low_points(G) for G in tables]
    row = np.concatenate([low[0] + k * BLOCK for k, low in enumerate(found)])
    place = u[0] + np.concatenate([low[1] for low in found]) * (u[1] - u[0])
    return Minima(row, place, np.concatenate([low[2] for low in found]), u[1] - u[0])


def _low_points(G: Array) -> tuple[NDArray[np.intp], Array, NDArray[np.bool_]]:
    """Rows and places, in steps, of the low minima of a table; rows that end at its edge."""
    lowest = G.argmin(axis=1)
    rows = np.arange(len(G))
    inner = np.clip(lowest, 1, G.shape[1] - 2)
    beside = np.maximum(G[rows, inner - 1], G[rows, inner + 1])
    ends = (inner != lowest) | (beside > NOWHERE / 4) | _unseen(G, G[rows, lowest])
    row, column = _low(G, G[rows, lowest])
    place, height = _vertex(G, row, column)
    least = np.full(len(G), np.inf)
    np.minimum.at(least, row, height)
    near = height <= least[row] + WINDOW
    return row[near], column[near] + place[near], ends


def _unseen(G: Array, least: Array) -> NDArray[np.bool_]:
    """Rows in which an end of the wheel hangs low over the rail: what follows might touch."""
    ends = G[:, [0, -1]]
    return np.any((ends < NOWHERE / 4) & (ends - least[:, None] < CLEAR), axis=1)


def _opposite(wheel: Wheel, y: Array, spacing: float) -> Array:
    """Equidistant points of the wheel that can lie over the rail."""
    low, high = wheel.curve.domain
    rail = wheel.rail.domain
    reach = abs(y).max(initial=0.0) + ROLLED_ASIDE
    first = max(low, rail[0] + wheel.br - wheel.b - reach)
    last = min(high, rail[1] + wheel.br - wheel.b + reach)
    return np.linspace(first, last, max(int(np.ceil((last - first) / spacing)), 4) + 1)


def _low(G: Array, least: Array) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Interior grid minima not far above the lowest grid value; the scan may miss by some um."""
    row, column = np.nonzero(G - least[:, None] <= 4 * WINDOW)
    inside = (column > 0) & (column < G.shape[1] - 1)
    row, column = row[inside], column[inside]
    before, at, after = G[row, column - 1], G[row, column], G[row, column + 1]
    low = (at <= before) & (at < after) & (np.maximum(before, after) < NOWHERE / 4)
    return row[low], column[low]


def _vertex(G: Array, row: NDArray[np.intp], k: NDArray[np.intp]) -> tuple[Array, Array]:
    """Vertex of the parabola through three values: place in steps from the middle, height."""
    before, at, after = G[row, k - 1], G[row, k], G[row, k + 1]
    bend = np.maximum(before - 2 * at + after, 1e-18)
    return (before - after) / (2 * bend), at - (after - before) ** 2 / (8 * bend)


def refined(wheel: Wheel, minima: Minima, y: Array, phi: Array) -> Minima:
    """The minima to FOUND: Newton's steps kept inside a shrinking bracket."""
    y, phi = y[minima.row], phi[minima.row]
    low, high = minima.u - 1.5 * minima.spacing, minima.u + 1.5 * minima.spacing
    u = minima.u.copy()
    active = np.arange(len(u))
    for _ in range(MOST):
        step = _inside_step(wheel, u, y, phi, low, high, active)
        u[active] += step
        active = active[abs(step) > FOUND]
        if not len(active):
            break
    return replace(minima, u=u)


def _inside_step(
    wheel: Wheel,
    u: Array,
    y: Array,
    phi: Array,
    low: Array,
    high: Array,
    k: NDArray[np.intp],
) -> Array:
    """Newton's step of the places k, or the way to the middle of their narrowed brackets."""
    at = u[k]
    first, second = wheel.slopes(at, y[k], phi[k])
    falling = first < 0
    low[k], high[k] = np.where(falling, at, low[k]), np.where(falling, high[k], at)
    newton = at - first / np.where(second > 0, second, np.inf)
    inside = (newton >= low[k]) & (newton <= high[k]) & (second > 0)
    return np.where(inside, newton, 0.5 * (low[k] + high[k])) - at
