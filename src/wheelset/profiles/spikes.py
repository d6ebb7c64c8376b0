"""Single points far off the line of their neighbours."""

from __future__ import annotations

import numpy as np

from wheelset.profiles.curves import Array
from wheelset.profiles.points import Points

#: A spike stands out by so many robust standard deviations, and at least so far, m.
DEVIATIONS, LEAST_SPIKE, MOST_SPIKES = 8.0, 2e-5, 40

#: Slope beyond which no spikes are looked for: points there differ in y, not in z.
STEEPEST = 4.0


def without_spikes(points: Points) -> Points:
    """Single points far from the cubic through their neighbours, one after the other."""
    y, z, gone = points.y, points.z, []
    for _ in range(MOST_SPIKES):
        off = _off_neighbours(y, z)
        least = max(DEVIATIONS * 1.4826 * float(np.median(abs(off))), LEAST_SPIKE)
        spike = _spike(y, z, off, least)
        if spike is None:
            break
        gone.append((y[spike], off[spike]))
        y, z = np.delete(y, spike), np.delete(z, spike)
    if not gone:
        return points
    where = ", ".join(f"{at * 1e3:.2f}" for at, _ in gone[:6])
    worst = max(abs(by) for _, by in gone) * 1e3
    note = f"{len(gone)} outliers removed, up to {worst:.3f} mm off, at y = {where} mm"
    return points.noted(note, y, z)


def _off_neighbours(y: Array, z: Array) -> Array:
    """Distance of every point from the cubic through two neighbours on either side, m."""
    off = np.zeros_like(y)
    at = y[2:-2]
    around = [(y[k : len(y) - 4 + k], z[k : len(y) - 4 + k]) for k in (0, 1, 3, 4)]
    value = np.zeros_like(at)
    for k, (yk, zk) in enumerate(around):
        others = [ym for m, (ym, _) in enumerate(around) if m != k]
        weight = np.ones_like(at)
        for ym in others:
            weight = weight * (at - ym) / (yk - ym)
        value += weight * zk
    # the chord of the inner or of the outer neighbours: one of the two is free of a spike
    chords = [(b[1] - a[1]) / (b[0] - a[0]) for a, b in (around[1:3], around[::3])]
    slope = np.minimum(abs(chords[0]), abs(chords[1]))
    off[2:-2] = np.where(slope < STEEPEST, (z[2:-2] - value) / np.sqrt(1 + slope**2), 0.0)
    return off


def _spike(y: Array, z: Array, off: Array, least: float) -> int | None:
    """The worst point whose removal, alone or with one beside it, leaves the others in line.

    A spike throws the cubics of its neighbours by -2/3 of its own height; a corner by -1/3, and a
    steep end to the same side.
    """
    inner = np.arange(2, len(y) - 2)
    for k in inner[np.argsort(-abs(off[inner]))[:MOST_SPIKES]]:
        if abs(off[k]) <= least:
            return None
        beside = np.array([off[k - 1], off[k + 1]]) / off[k]
        if beside.min() > -0.5 or abs(beside).max() > 1:
            continue
        near, at = slice(max(k - 6, 0), k + 7), min(int(k), 6)
        for out in ([at], [at, at + 1], [at - 1, at]):
            left = np.delete(y[near], out), np.delete(z[near], out)
            if abs(_off_neighbours(*left)).max() < max(0.2 * abs(off[k]), 0.6 * least):
                return int(k)
    return None
